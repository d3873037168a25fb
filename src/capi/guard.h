#pragma once

#include <cstddef>
#include <exception>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>

#include "quasimc/capi.h"

namespace quasimc::capi {

/// A call that makes no sense: QUASIMC_MISUSE.
class Misuse : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Does work from which nothing may be thrown. @returns a quasimc_status
int guarded(const std::function<void()>& work) noexcept;

/// What the work returns, or `otherwise` if it failed.
template <typename T, typename Work>
T guarded_or(T otherwise, const Work& work) noexcept {
    T value = otherwise;
    return guarded([&] { value = work(); }) == QUASIMC_DONE ? value : otherwise;
}

/// What was wrong last in this thread.
[[nodiscard]] const char* last_error() noexcept;

/// What a pointer points at. @throws Misuse  if it is NULL
template <typename T>
T& deref(T* pointer, const char* name) {
    if (pointer == nullptr) {
        throw Misuse(std::string(name) + " is NULL");
    }
    return *pointer;
}
/// The numbers of an array, one for each band. @throws Misuse  if it is NULL, or there are no bands
[[nodiscard]] std::span<const double> of_bands(
    const double* numbers, std::size_t bands, const char* name);
/// A copy of a text. @throws Misuse  if it is NULL @throws InputError  if it is not UTF-8
[[nodiscard]] std::string text_of(const char* text, const char* name);
/// The same of a text that may be NULL: "".
[[nodiscard]] std::string optional_text(const char* text);

/// A handle in use by one call; another call that comes meanwhile is refused.
class InUse {
  public:
    /// @param flag  of the handle. @throws Misuse  if it is in use
    explicit InUse(bool& flag);
    ~InUse() { flag_ = false; }
    InUse(const InUse&) = delete;
    InUse& operator=(const InUse&) = delete;

  private:
    bool& flag_;
};

}  // namespace quasimc::capi
