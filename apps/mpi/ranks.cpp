#include "ranks.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <thread>
#include <utility>
#include <vector>

#include <mpi.h>

// Ranks that wait for others sleep: they may share a core with one that works.

namespace {

bool is_done(MPI_Request& request) {
    int done = 0;
    return MPI_Test(&request, &done, MPI_STATUS_IGNORE) != MPI_SUCCESS || done != 0;
}

void wait_for(MPI_Request& request) {
    constexpr std::chrono::microseconds kFirst{20}, kLongest{500};
    std::chrono::microseconds pause = kFirst;
    while (!is_done(request)) {
        std::this_thread::sleep_for(pause);
        pause = std::min(2 * pause, kLongest);
    }
}

/// Of bytes of which all who send or take them are there. They go in many small pieces, each of
/// which takes a call: to sleep in between takes a hundred times as long as they do.
void wait_for_bytes(MPI_Request& request) {
    while (!is_done(request)) {
        std::this_thread::yield();
    }
}

void barrier() {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibarrier(MPI_COMM_WORLD, &request);
    wait_for(request);
}

/// Many numbers follow few, which tell of them.
void broadcast(std::uint64_t* numbers, std::uint64_t count) {
    constexpr std::uint64_t kFew = 64;
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibcast(numbers, static_cast<int>(count), MPI_UINT64_T, 0, MPI_COMM_WORLD, &request);
    count > kFew ? wait_for_bytes(request) : wait_for(request);
}

int own_rank() {
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    return rank;
}

void add_up(std::int64_t* numbers, std::uint64_t count) {
    const bool is_first = own_rank() == 0;
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ireduce(
        is_first ? MPI_IN_PLACE : numbers, is_first ? numbers : nullptr, static_cast<int>(count),
        MPI_INT64_T, MPI_SUM, 0, MPI_COMM_WORLD, &request);
    wait_for_bytes(request);
}

// Mail goes to rank 0 as messages of at most kMostOfMessage bytes after one that tells how many
// there are, all with the tag of its number. Numbers may share a tag: few of them are on their way.

constexpr int kEndTag = 1, kCloseTag = 2, kFirstTag = 3, kTags = 30000;
constexpr std::uint64_t kMostOfMessage = std::uint64_t{1} << 30U;
/// Pieces of mail of a rank that may be on their way.
constexpr std::size_t kMostOnTheirWay = 2;

struct Mail {
    std::uint64_t count = 0;
    std::vector<char> bytes;
    std::vector<MPI_Request> requests;
};

/// Of this rank: it is one for the process, as MPI is.
struct MailBox {
    std::deque<Mail> sent;  // that may be on their way; their places in memory stay
    bool is_closed = false;
    int found_source = 0, found_tag = 0;  // of what find() has found
};

MailBox& mail_box() {
    static MailBox box;
    return box;
}

int tag_of(std::uint64_t number) {
    return kFirstTag + static_cast<int>(number % kTags);
}

/// Sends and receives are begun for each message of `count` bytes.
template <typename Begin>
void for_each_message(std::uint64_t count, const Begin& begin) {
    for (std::uint64_t at = 0; at < count; at += kMostOfMessage) {
        begin(at, static_cast<int>(std::min(kMostOfMessage, count - at)));
    }
}

void wait_for_mail(std::size_t most_on_their_way) {
    auto& sent = mail_box().sent;
    while (sent.size() > most_on_their_way) {
        for (MPI_Request& request : sent.front().requests) {
            wait_for(request);
        }
        sent.pop_front();
    }
}

void send_mail(std::uint64_t number, const char* bytes, std::uint64_t count) {
    Mail& mail = mail_box().sent.emplace_back();
    mail.count = count;
    mail.bytes.assign(bytes, bytes + count);
    const int tag = tag_of(number);
    MPI_Isend(&mail.count, 1, MPI_UINT64_T, 0, tag, MPI_COMM_WORLD, &mail.requests.emplace_back());
    for_each_message(count, [&](std::uint64_t at, int size) {
        MPI_Isend(
            mail.bytes.data() + at, size, MPI_CHAR, 0, tag, MPI_COMM_WORLD,
            &mail.requests.emplace_back());
    });
    wait_for_mail(kMostOnTheirWay);
}

int has_mail_arrived() {
    auto& sent = mail_box().sent;
    while (!sent.empty()) {
        for (MPI_Request& request : sent.front().requests) {
            if (!is_done(request)) {
                return 0;
            }
        }
        sent.pop_front();
    }
    return 1;
}

/// Of mail whose tag is known: its source and how many bytes it has.
std::uint64_t begin_mail(const MPI_Status& status) {
    MailBox& box = mail_box();
    box.found_source = status.MPI_SOURCE;
    box.found_tag = status.MPI_TAG;
    std::uint64_t count = 0;
    MPI_Recv(
        &count, 1, MPI_UINT64_T, box.found_source, box.found_tag, MPI_COMM_WORLD,
        MPI_STATUS_IGNORE);
    return count;
}

std::uint64_t find_mail(std::uint64_t number) {
    int is_there = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, tag_of(number), MPI_COMM_WORLD, &is_there, &status);
    return is_there != 0 ? begin_mail(status) : kNoMail;
}

void receive_mail(char* bytes, std::uint64_t count) {
    const MailBox& box = mail_box();
    for_each_message(count, [&](std::uint64_t at, int size) {
        MPI_Request request = MPI_REQUEST_NULL;
        MPI_Irecv(
            bytes + at, size, MPI_CHAR, box.found_source, box.found_tag, MPI_COMM_WORLD, &request);
        wait_for_bytes(request);
    });
}

int number_of_ranks() {
    int count = 1;
    MPI_Comm_size(MPI_COMM_WORLD, &count);
    return count;
}

void close_mail() {
    if (std::exchange(mail_box().is_closed, true)) {
        return;
    }
    for (int rank = 1; rank < number_of_ranks(); ++rank) {
        MPI_Send(nullptr, 0, MPI_CHAR, rank, kCloseTag, MPI_COMM_WORLD);
    }
}

int is_mail_closed() {
    MailBox& box = mail_box();
    int is_there = 0;
    if (!box.is_closed) {
        MPI_Iprobe(0, kCloseTag, MPI_COMM_WORLD, &is_there, MPI_STATUS_IGNORE);
    }
    if (is_there != 0) {
        MPI_Recv(nullptr, 0, MPI_CHAR, 0, kCloseTag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
        box.is_closed = true;
    }
    return box.is_closed ? 1 : 0;
}

/// Of rank 0: drops mail until all others have sent their last.
void drop_mail() {
    std::vector<char> dropped;
    for (int open = number_of_ranks() - 1; open > 0;) {
        int is_there = 0;
        MPI_Status status;
        MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &is_there, &status);
        if (is_there == 0) {
            std::this_thread::sleep_for(std::chrono::microseconds(200));
            continue;
        }
        dropped.resize(begin_mail(status));
        receive_mail(dropped.data(), dropped.size());
        open -= status.MPI_TAG == kEndTag ? 1 : 0;
    }
}

void end_mail() {
    if (own_rank() == 0) {
        drop_mail();
    } else {
        wait_for_mail(0);
        const std::uint64_t none = 0;
        MPI_Send(&none, 1, MPI_UINT64_T, 0, kEndTag, MPI_COMM_WORLD);
        while (is_mail_closed() == 0) {
            std::this_thread::sleep_for(std::chrono::microseconds(200));
        }
    }
    mail_box().is_closed = false;
}

void finalize() {
    MPI_Finalize();
}

void abort_all(int status) {
    MPI_Abort(MPI_COMM_WORLD, status);
}

/// The ranks that share memory. For tests, fewer of them are a node.
MPI_Comm node_of_rank(int rank) {
    MPI_Comm shared = MPI_COMM_NULL;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, rank, MPI_INFO_NULL, &shared);
    const char* stated = std::getenv("QUASIMC_RANKS_OF_NODE");  // NOLINT(concurrency-mt-unsafe)
    const int most = stated != nullptr ? std::atoi(stated) : 0;
    if (most < 1) {
        return shared;
    }
    int place = 0;
    MPI_Comm_rank(shared, &place);
    MPI_Comm node = MPI_COMM_NULL;
    MPI_Comm_split(shared, place / most, place, &node);
    return node;
}

/// Memory that the ranks of a node share, zero at first; it lives until the end of the job.
void* shared_memory(MPI_Comm node, std::uint64_t bytes) {
    int place = 0;
    MPI_Comm_rank(node, &place);
    MPI_Win window = MPI_WIN_NULL;
    void* own = nullptr;
    const MPI_Aint own_bytes = place == 0 ? static_cast<MPI_Aint>(bytes) : 0;
    MPI_Win_allocate_shared(own_bytes, 1, MPI_INFO_NULL, node, &own, &window);
    MPI_Aint size = 0;
    int unit = 0;
    void* memory = nullptr;
    MPI_Win_shared_query(window, 0, &size, &unit, &memory);
    if (place == 0) {
        std::memset(memory, 0, bytes);
    }
    MPI_Barrier(node);
    return memory;
}

void find_nodes(MPI_Comm node, QuasimcRanks& ranks) {
    int place = 0;
    MPI_Comm_rank(node, &place);
    ranks.is_first_of_node = place == 0 ? 1 : 0;
    // Nodes are counted by their first ranks.
    std::uint64_t number = 0;
    MPI_Exscan(&ranks.is_first_of_node, &number, 1, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
    number = ranks.rank == 0 ? 0 : number;
    MPI_Bcast(&number, 1, MPI_UINT64_T, 0, node);
    ranks.node = number;
    MPI_Allreduce(&ranks.is_first_of_node, &ranks.nodes, 1, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
}

}  // namespace

const QuasimcRanks* quasimc_ranks(std::uint64_t node_bytes) {
    static QuasimcRanks ranks{};
    int level = 0;
    if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &level) != MPI_SUCCESS ||
        level < MPI_THREAD_FUNNELED) {
        return nullptr;
    }
    ranks.version = kQuasimcRanksVersion;
    ranks.rank = static_cast<std::uint64_t>(own_rank());
    ranks.ranks = static_cast<std::uint64_t>(number_of_ranks());
    MPI_Comm node = node_of_rank(own_rank());
    find_nodes(node, ranks);
    ranks.node_memory = shared_memory(node, node_bytes);
    ranks.barrier = barrier;
    ranks.broadcast = broadcast;
    ranks.add_up = add_up;
    ranks.send = send_mail;
    ranks.has_arrived = has_mail_arrived;
    ranks.find = find_mail;
    ranks.receive = receive_mail;
    ranks.close = close_mail;
    ranks.is_closed = is_mail_closed;
    ranks.end_mail = end_mail;
    ranks.finalize = finalize;
    ranks.abort = abort_all;
    return &ranks;
}
