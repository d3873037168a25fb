#pragma once

// What `quasimc` asks of MPI, as a table of plain functions: the only unit of the program that
// knows MPI (ranks.cpp) is a library of its own, which is loaded when ranks are many, and not
// before.

#include <cstdint>

extern "C" {

/// The ranks of a job. All functions are called from one thread, and all but abort by all ranks in
/// the same order.
struct QuasimcRanks {
    std::uint64_t version;  ///< of this table
    std::uint64_t rank, ranks;
    std::uint64_t node, nodes;  ///< machines, or what shares memory
    void* node_memory;          ///< that the ranks of a node share, zero at first
    std::uint64_t is_first_of_node;
    void (*barrier)();
    void (*broadcast)(std::uint64_t* numbers, std::uint64_t count);  ///< from rank 0
    void (*add_up)(std::int64_t* numbers, std::uint64_t count);      ///< to rank 0
    /// Of the others: sends bytes to rank 0 under a number. Returns while they are on their way,
    /// but waits while many are.
    void (*send)(std::uint64_t number, const char* bytes, std::uint64_t count);
    int (*has_arrived)();  ///< of the others: whether all that was sent has arrived
    /// Of rank 0: how many bytes were sent under a number, if they are there; else kNoMail.
    std::uint64_t (*find)(std::uint64_t number);
    /// Of rank 0: receives what find() has found.
    void (*receive)(char* bytes, std::uint64_t count);
    void (*close)();     ///< of rank 0: lets the others know that it wants no more
    int (*is_closed)();  ///< of the others: whether it did
    void (*end_mail)();  ///< of all, after close(): nothing is on its way then
    void (*finalize)();
    void (*abort)(int status);  ///< of all ranks
};

constexpr std::uint64_t kNoMail = ~std::uint64_t{0};

/// Version of the table.
constexpr std::uint64_t kQuasimcRanksVersion = 4;

/// Starts MPI. @returns null if it can't be started
/// @param node_bytes  of memory that the ranks of a node share
const QuasimcRanks* quasimc_ranks(std::uint64_t node_bytes);
}
