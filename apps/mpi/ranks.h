#pragma once

// What `quasimc` asks of MPI, as a table of plain functions: the only unit of the program that
// knows MPI (ranks.cpp) is a library of its own, which is loaded when ranks are many, and not
// before.

#include <cstdint>

extern "C" {

/// The ranks of a job. All functions are called from one thread; barrier, broadcast, add_up and
/// finalize by all ranks in the same order.
struct QuasimcRanks {
    std::uint64_t version;  ///< of this table
    std::uint64_t rank, ranks;
    void (*barrier)();
    void (*broadcast)(std::uint64_t* numbers, std::uint64_t count);  ///< from rank 0
    void (*add_up)(std::int64_t* numbers, std::uint64_t count);      ///< to rank 0
    /// Of the others: sends numbers to rank 0, and waits until they are received.
    void (*send)(const std::uint64_t* numbers, std::uint64_t count);
    /// Of rank 0: whether another rank has sent something; and receives it.
    int (*has_sent)(std::uint64_t rank);
    void (*receive)(std::uint64_t rank, std::uint64_t* numbers, std::uint64_t count);
    void (*stop)();       ///< of rank 0: asks all others to give up
    int (*is_stopped)();  ///< of the others: whether it did, once for each time
    void (*finalize)();
    void (*abort)(int status);  ///< of all ranks
};

/// Version of the table.
constexpr std::uint64_t kQuasimcRanksVersion = 5;

/// Starts MPI. @returns null if it can't be started
const QuasimcRanks* quasimc_ranks();
}
