#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/common_memory.h"

namespace quasimc {

/// Numbers that change no more. Copies share them.
template <typename T>
class FrozenArray {
    static_assert(std::is_trivially_copyable_v<T>);

  public:
    using value_type = T;
    using const_iterator = const T*;

    /// From this many bytes on they are worth a place in common memory.
    static constexpr std::size_t kFewestCommonBytes = std::size_t{1} << 18U;

    FrozenArray() = default;
    FrozenArray(std::vector<T> values) {  // NOLINT(google-explicit-constructor)
        const auto own = std::make_shared<const std::vector<T>>(std::move(values));
        *this = FrozenArray(own, *own);
    }
    /// Numbers that `owner` keeps.
    FrozenArray(std::shared_ptr<const void> owner, std::span<const T> values)
        : owner_(std::move(owner)), values_(values) {}

    /// The same numbers, in common memory if they are many and can be there.
    /// @param common  or null: there is none
    [[nodiscard]] FrozenArray in(CommonMemory* common) const {
        const std::span<const std::byte> bytes = std::as_bytes(values_);
        const auto kept =
            common != nullptr && bytes.size() >= kFewestCommonBytes ? common->keep(bytes) : nullptr;
        return kept ? FrozenArray(kept, {reinterpret_cast<const T*>(kept.get()), size()}) : *this;
    }

    [[nodiscard]] std::size_t size() const { return values_.size(); }
    [[nodiscard]] bool empty() const { return values_.empty(); }
    [[nodiscard]] const T* data() const { return values_.data(); }
    [[nodiscard]] const T& operator[](std::size_t i) const { return values_[i]; }
    [[nodiscard]] const_iterator begin() const { return values_.data(); }
    [[nodiscard]] const_iterator end() const { return values_.data() + values_.size(); }
    operator std::span<const T>() const { return values_; }  // NOLINT(google-explicit-constructor)

    friend bool operator==(const FrozenArray& a, const FrozenArray& b) {
        return std::equal(a.begin(), a.end(), b.begin(), b.end());
    }

  private:
    std::shared_ptr<const void> owner_;
    std::span<const T> values_;
};

}  // namespace quasimc
