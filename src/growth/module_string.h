#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace quasimc {

/// Allocates memory without setting it to zero.
template <typename T>
struct UninitializedAllocator : std::allocator<T> {
    template <typename U>
    struct rebind {  // NOLINT(readability-identifier-naming): of the standard library
        using other = UninitializedAllocator<U>;
    };
    template <typename U>
    void construct(U* p) {
        ::new (static_cast<void*>(p)) U;
    }
};

/// A string of modules: symbols with parameters, in flat memory. A module is a header of 32 bits
/// (symbol, number of parameters, sizes of this and the previous module), for a bracket the
/// position of its partner, and the parameters in single precision. A takes 4 bytes, A(x) 8.
class ModuleString {
  public:
    /// Where a module is: an offset in words of 32 bits.
    using Position = std::uint32_t;
    static constexpr Position kNone = std::numeric_limits<Position>::max();
    /// Largest number of parameters of a module.
    static constexpr std::size_t kMaxParameters = 20;

    [[nodiscard]] bool empty() const { return end_ == 0; }
    [[nodiscard]] static Position begin() { return 0; }
    [[nodiscard]] Position end() const { return end_; }
    /// The next module, or end().
    [[nodiscard]] Position next(Position p) const { return p + size_of(words_[p]); }
    /// The previous module, or kNone at the first.
    [[nodiscard]] Position previous(Position p) const {
        const std::uint32_t size = p < end() ? words_[p] >> 24U : last_size_;
        return size == 0 ? kNone : p - size;
    }

    [[nodiscard]] char symbol(Position p) const { return static_cast<char>(words_[p] & 0xFFU); }
    /// The number of parameters.
    [[nodiscard]] std::size_t count(Position p) const { return words_[p] >> 8U & 0xFFU; }
    [[nodiscard]] float parameter(Position p, std::size_t i) const {
        return std::bit_cast<float>(words_[next(p) - count(p) + i]);
    }
    void set_parameter(Position p, std::size_t i, float value) {
        words_[next(p) - count(p) + i] = std::bit_cast<std::uint32_t>(value);
    }
    /// The ']' that matches a '[', or the reverse; kNone if there is none.
    [[nodiscard]] Position partner(Position p) const { return words_[p + 1]; }
    /// The number of the sub-L-system of a module ?(id, scale); kNone if it is new.
    [[nodiscard]] std::uint32_t subsystem(Position p) const { return words_[p + 1]; }
    void set_subsystem(Position p, std::uint32_t number) { words_[p + 1] = number; }

    /// Appends a module; its parameters are rounded to single precision.
    void append(char symbol, std::span<const double> parameters = {});
    /// Appends a module of another string.
    void append_from(const ModuleString& other, Position p);
    void append_all(const ModuleString& other);
    void clear();
    /// Makes room for a string of as many words.
    void reserve(std::size_t words) {
        if (words > words_.size()) {
            enlarge(words);
        }
    }
    /// Number of modules.
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] std::size_t bytes() const { return words_.size() * sizeof(std::uint32_t); }

    /// Text of the string without line breaks; numbers as by "%g".
    [[nodiscard]] std::string text() const;
    /// The text in lines of about 70 characters, as the option -str of cpfg writes it.
    [[nodiscard]] std::string lines() const;

  private:
    static constexpr std::size_t kNoBreaks = std::numeric_limits<std::size_t>::max();

    static std::uint32_t size_of(std::uint32_t header) { return header >> 16U & 0xFFU; }
    /// Whether the header is followed by the position of a partner, or the number of a
    /// sub-L-system.
    static bool has_link_word(char symbol, std::size_t count) {
        return symbol == '[' || symbol == ']' || (symbol == '?' && count > 0);
    }
    void enlarge(std::size_t words);
    /// Connects a bracket with its partner.
    void link(Position p);
    [[nodiscard]] std::string written(std::size_t length) const;

    std::vector<std::uint32_t, UninitializedAllocator<std::uint32_t>>
        words_;  // up to `end_`; the others are room for more
    Position end_ = 0;
    std::vector<Position> open_;  // brackets without a partner so far
    std::size_t size_ = 0;
    std::uint32_t last_size_ = 0;  // words of the last module
};

}  // namespace quasimc
