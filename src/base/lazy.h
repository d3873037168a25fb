#pragma once

#include <mutex>
#include <optional>

namespace quasimc {

/// A value that is made when it is first asked for, by whichever thread asks first; others that ask
/// meanwhile wait for it.
template <typename T>
class Lazy {
  public:
    /// @param make  gives the value; the same one whoever asks
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
