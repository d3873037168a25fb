#pragma once

// The functions of MPI that `quasimc` uses, as a table of plain functions. The only unit that uses
// MPI (ranks.cpp) is a separate library, which is loaded if there are several ranks.

#include <cstdint>

extern "C" {

/// The ranks of a job. All functions are called from one thread; barrier, broadcast, add_up and
/// finalize by all ranks in the same order.
struct QuasimcRanks {
    std::uint64_t version;  ///< version of this table
    std::uint64_t rank, ranks;
    void (*barrier)();
    void (*broadcast)(std::uint64_t* numbers, std::uint64_t count);  ///< from rank 0
    void (*add_up)(std::int64_t* numbers, std::uint64_t count);      ///< to rank 0
    /// On other ranks: sends numbers to rank 0, and waits until they are received.
    void (*send)(const std::uint64_t* numbers, std::uint64_t count);
    /// On rank 0: whether another rank has sent something; and receives it.
    int (*has_sent)(std::uint64_t rank);
    void (*receive)(std::uint64_t rank, std::uint64_t* numbers, std::uint64_t count);
    void (*stop)();       ///< on rank 0: asks all others to stop
    int (*is_stopped)();  ///< on others: whether it did, once per request
    void (*finalize)();
    void (*abort)(int status);  ///< ends all ranks
};

/// Version of the table.
constexpr std::uint64_t kQuasimcRanksVersion = 5;

/// Starts MPI. @returns null if it can't be started
const QuasimcRanks* quasimc_ranks();
}
