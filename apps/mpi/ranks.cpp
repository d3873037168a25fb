#include "ranks.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include <mpi.h>

// Waiting ranks sleep: they may share a core with a working one.

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

/// Waits for many bytes while all their senders and receivers take part. MPI moves them in small
/// pieces, one per call: sleeping in between would take a hundred times as long as the transfer.
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

/// Messages of many numbers are announced by a short one, so their sender is ready.
void wait_for_numbers(MPI_Request& request, std::uint64_t count) {
    constexpr std::uint64_t kFew = 64;
    count > kFew ? wait_for_bytes(request) : wait_for(request);
}

void broadcast(std::uint64_t* numbers, std::uint64_t count) {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibcast(numbers, static_cast<int>(count), MPI_UINT64_T, 0, MPI_COMM_WORLD, &request);
    wait_for_numbers(request, count);
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

constexpr int kNumbers = 1, kStop = 2;  // tags

void send(const std::uint64_t* numbers, std::uint64_t count) {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Issend(
        numbers, static_cast<int>(count), MPI_UINT64_T, 0, kNumbers, MPI_COMM_WORLD, &request);
    wait_for_numbers(request, count);
}

bool has_message(int rank, int tag) {
    int is_there = 0;
    MPI_Iprobe(rank, tag, MPI_COMM_WORLD, &is_there, MPI_STATUS_IGNORE);
    return is_there != 0;
}

int has_sent(std::uint64_t rank) {
    return has_message(static_cast<int>(rank), kNumbers) ? 1 : 0;
}

void receive(std::uint64_t rank, std::uint64_t* numbers, std::uint64_t count) {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Irecv(
        numbers, static_cast<int>(count), MPI_UINT64_T, static_cast<int>(rank), kNumbers,
        MPI_COMM_WORLD, &request);
    wait_for_bytes(request);
}

int number_of_ranks() {
    int count = 1;
    MPI_Comm_size(MPI_COMM_WORLD, &count);
    return count;
}

void stop() {
    for (int rank = 1; rank < number_of_ranks(); ++rank) {
        MPI_Send(nullptr, 0, MPI_CHAR, rank, kStop, MPI_COMM_WORLD);
    }
}

int is_stopped() {
    if (!has_message(0, kStop)) {
        return 0;
    }
    MPI_Recv(nullptr, 0, MPI_CHAR, 0, kStop, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    return 1;
}

void finalize() {
    MPI_Finalize();
}

void abort_all(int status) {
    MPI_Abort(MPI_COMM_WORLD, status);
}

}  // namespace

const QuasimcRanks* quasimc_ranks() {
    static QuasimcRanks ranks{};
    int level = 0;
    if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &level) != MPI_SUCCESS ||
        level < MPI_THREAD_FUNNELED) {
        return nullptr;
    }
    ranks.version = kQuasimcRanksVersion;
    ranks.rank = static_cast<std::uint64_t>(own_rank());
    ranks.ranks = static_cast<std::uint64_t>(number_of_ranks());
    ranks.barrier = barrier;
    ranks.broadcast = broadcast;
    ranks.add_up = add_up;
    ranks.send = send;
    ranks.has_sent = has_sent;
    ranks.receive = receive;
    ranks.stop = stop;
    ranks.is_stopped = is_stopped;
    ranks.finalize = finalize;
    ranks.abort = abort_all;
    return &ranks;
}
