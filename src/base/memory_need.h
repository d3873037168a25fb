#pragma once

#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace quasimc {

/// Thrown where memory is not enough: its text contains the purpose and the size.
class OutOfMemory : public std::bad_alloc {
  public:
    /// @param what_for  "the sums of 8 replicates"
    /// @param bytes  approximate size
    OutOfMemory(const std::string& what_for, double bytes)
        : OutOfMemory(fmt::format("not enough memory for {}: {}", what_for, need_of(bytes))) {}
    /// Error when a thread can't be started.
    [[nodiscard]] static OutOfMemory for_threads() {
        return OutOfMemory(fmt::format(
            "not enough memory to start a thread, or too many of them are running; {}",
            kFewerThreads));
    }
    [[nodiscard]] const char* what() const noexcept override { return text_->c_str(); }

  private:
    static constexpr const char* kFewerThreads =
        "use fewer threads (threads = 1), or raise the limits of the process (ulimit -v, ulimit "
        "-u)";

    explicit OutOfMemory(const std::string& text)
        : text_(std::make_shared<const std::string>(text)) {}

    /// Less than the stack of a thread can't have exhausted the memory.
    static std::string need_of(double bytes) {
        constexpr double kBytesOfMegabyte = 1e6, kBytesOfStack = 8e6;
        return bytes < kBytesOfStack
                   ? fmt::format(
                         "less than {:.0f} MB, but little memory is left beside the threads; {}",
                         kBytesOfStack / kBytesOfMegabyte, kFewerThreads)
                   : fmt::format("about {:.0f} MB", bytes / kBytesOfMegabyte);
    }

    std::shared_ptr<const std::string> text_;  // copying it never throws
};

/// Calls `make`, which allocates much memory.
/// @throws OutOfMemory  with this purpose; an inner OutOfMemory is passed on
template <typename Make>
auto make_big(const std::string& what_for, double bytes, Make&& make) {
    try {
        return std::forward<Make>(make)();
    } catch (const OutOfMemory&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw OutOfMemory(what_for, bytes);
    } catch (const std::length_error&) {  // more than any vector can hold
        throw OutOfMemory(what_for, bytes);
    }
}

}  // namespace quasimc
