#pragma once

#include <mutex>
#include <optional>

namespace quasimc {

/// A value that is made on first use, by the first thread that needs it; others wait meanwhile.
template <typename T>
class Lazy {
  public:
    /// @param make  makes the value; equal for all callers
    template <typename Make>
    [[nodiscard]] const T& get(const Make& make) const {
        std::call_once(made_, [&] { value_.emplace(make()); });
        return *value_;
    }

  private:
    mutable std::once_flag made_;
    mutable std::optional<T> value_;
};

}  // namespace quasimc
