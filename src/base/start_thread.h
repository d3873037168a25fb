#pragma once

#include <system_error>
#include <thread>
#include <utility>

#include "base/memory_need.h"

namespace quasimc {

/// Starts a thread.
/// @throws OutOfMemory  if the system has no memory for its stack, or allows no more threads
template <typename Thread = std::jthread, typename Work>
[[nodiscard]] Thread start_thread(Work&& work) {
    try {
        return Thread(std::forward<Work>(work));
    } catch (const std::system_error&) {
        throw OutOfMemory::for_threads();
    }
}

}  // namespace quasimc
