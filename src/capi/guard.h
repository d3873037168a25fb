#pragma once

#include <cstddef>
#include <exception>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>

#include "quasimc/capi.h"

namespace quasimc::capi {

/// Thrown for an invalid call: QUASIMC_MISUSE.
class Misuse : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Does work and catches all exceptions. @returns a quasimc_status
int guarded(const std::function<void()>& work) noexcept;

/// The result of the work, or `otherwise` if it failed.
template <typename T, typename Work>
T guarded_or(T otherwise, const Work& work) noexcept {
    T value = otherwise;
    return guarded([&] { value = work(); }) == QUASIMC_DONE ? value : otherwise;
}

/// The last error message of this thread.
[[nodiscard]] const char* last_error() noexcept;

/// The object of a pointer. @throws Misuse  if it is NULL
template <typename T>
T& deref(T* pointer, const char* name) {
    if (pointer == nullptr) {
        throw Misuse(std::string(name) + " is NULL");
    }
    return *pointer;
}
/// The numbers of an array, one per band. @throws Misuse  if it is NULL, or there are no bands
[[nodiscard]] std::span<const double> of_bands(
    const double* numbers, std::size_t bands, const char* name);
/// A copy of a text. @throws Misuse  if it is NULL @throws InputError  if it is not UTF-8
[[nodiscard]] std::string text_of(const char* text, const char* name);
/// A copy of a text, or "" for NULL.
[[nodiscard]] std::string optional_text(const char* text);

/// Marks a handle as in use; a concurrent call is refused.
class InUse {
  public:
    /// @param flag  flag of the handle. @throws Misuse  if it is in use
    explicit InUse(bool& flag);
    ~InUse() { flag_ = false; }
    InUse(const InUse&) = delete;
    InUse& operator=(const InUse&) = delete;

  private:
    bool& flag_;
};

}  // namespace quasimc::capi
