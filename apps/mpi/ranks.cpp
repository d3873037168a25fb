#include "ranks.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <new>
#include <thread>

#include <mpi.h>

// Ranks that wait sleep: they may share a core with one that works.

namespace {

void wait_for(MPI_Request& request) {
    constexpr std::chrono::microseconds kFirst{20}, kLongest{500};
    std::chrono::microseconds pause = kFirst;
    int is_done = 0;
    while (MPI_Test(&request, &is_done, MPI_STATUS_IGNORE) == MPI_SUCCESS && is_done == 0) {
        std::this_thread::sleep_for(pause);
        pause = std::min(2 * pause, kLongest);
    }
}

void barrier() {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibarrier(MPI_COMM_WORLD, &request);
    wait_for(request);
}

void broadcast(std::uint64_t* numbers, std::uint64_t count) {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibcast(numbers, static_cast<int>(count), MPI_UINT64_T, 0, MPI_COMM_WORLD, &request);
    wait_for(request);
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
    wait_for(request);
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

/// A number in memory that the ranks of a node share; it lives until the end of the job.
std::uint64_t* shared_number(MPI_Comm node) {
    int place = 0;
    MPI_Comm_rank(node, &place);
    MPI_Win window = MPI_WIN_NULL;
    void* own = nullptr;
    const MPI_Aint bytes = place == 0 ? 64 : 0;
    MPI_Win_allocate_shared(bytes, 1, MPI_INFO_NULL, node, &own, &window);
    MPI_Aint size = 0;
    int unit = 0;
    void* number = nullptr;
    MPI_Win_shared_query(window, 0, &size, &unit, &number);
    if (place == 0) {
        new (number) std::uint64_t(0);
    }
    return static_cast<std::uint64_t*>(number);
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

const QuasimcRanks* quasimc_ranks() {
    static QuasimcRanks ranks{};
    int level = 0;
    if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &level) != MPI_SUCCESS ||
        level < MPI_THREAD_FUNNELED) {
        return nullptr;
    }
    int count = 1;
    MPI_Comm_size(MPI_COMM_WORLD, &count);
    ranks.version = kQuasimcRanksVersion;
    ranks.rank = static_cast<std::uint64_t>(own_rank());
    ranks.ranks = static_cast<std::uint64_t>(count);
    MPI_Comm node = node_of_rank(own_rank());
    find_nodes(node, ranks);
    ranks.node_counter = shared_number(node);
    ranks.barrier = barrier;
    ranks.broadcast = broadcast;
    ranks.add_up = add_up;
    ranks.finalize = finalize;
    ranks.abort = abort_all;
    return &ranks;
}
