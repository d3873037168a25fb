#pragma once

#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace quasimc {

/// Thrown where memory was not enough: says for what, and how much that takes.
class OutOfMemory : public std::bad_alloc {
  public:
    /// @param what_for  "the sums of 8 replicates"
    /// @param bytes  that it takes, about
    OutOfMemory(const std::string& what_for, double bytes)
        : OutOfMemory(fmt::format("not enough memory for {}: {}", what_for, need_of(bytes))) {}
    /// Where a thread can't be started.
    [[nodiscard]] static OutOfMemory for_threads() {
        return OutOfMemory(fmt::format(
            "not enough memory to start a thread, or too many of them are running; {}",
            kFewerThreads));
    }
    [[nodiscard]] const char* what() const noexcept override { return words_->c_str(); }

  private:
    static constexpr const char* kFewerThreads =
        "use fewer threads (threads = 1), or raise the limits of the process (ulimit -v, ulimit "
        "-u)";

    explicit OutOfMemory(const std::string& words)
        : words_(std::make_shared<const std::string>(words)) {}

    /// What takes less than the stack of a thread is not what took the memory.
    static std::string need_of(double bytes) {
        constexpr double kBytesOfMegabyte = 1e6, kBytesOfStack = 8e6;
        return bytes < kBytesOfStack
                   ? fmt::format(
                         "less than {:.0f} MB, but little memory is left beside the threads; {}",
                         kBytesOfStack / kBytesOfMegabyte, kFewerThreads)
                   : fmt::format("about {:.0f} MB", bytes / kBytesOfMegabyte);
    }

    std::shared_ptr<const std::string> words_;  // copying it never throws
};

/// Makes something big.
/// @throws OutOfMemory  with these words, if memory is not enough for it; one that says for what
///         goes on as it is
template <typename Make>
auto make_big(const std::string& what_for, double bytes, Make&& make) {
    try {
        return std::forward<Make>(make)();
    } catch (const OutOfMemory&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw OutOfMemory(what_for, bytes);
    } catch (const std::length_error&) {  // more than any vector could hold
        throw OutOfMemory(what_for, bytes);
    }
}

}  // namespace quasimc
