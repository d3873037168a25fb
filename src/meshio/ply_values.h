#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

#include "base/number_text.h"
#include "meshio/ply_header.h"
#include "text/line_scanner.h"
#include "text/numbers.h"

namespace quasimc {

/// Reads the values of a PLY file in sequence, in any encoding.
class PlyValues {
  public:
    PlyValues(std::string_view bytes, PlyEncoding encoding) : rest_(bytes), encoding_(encoding) {}

    /// The next value; empty at the end of the file, or if it is no number.
    std::optional<double> next(PlyType type) {
        return encoding_ == PlyEncoding::ascii ? next_word() : next_binary(type);
    }
    [[nodiscard]] std::size_t bytes_left() const { return rest_.size(); }

    /// Describes the data after the last value: "2 words". "" for blanks, comments and the zeros
    /// that fill a block.
    [[nodiscard]] std::string rest() const {
        constexpr std::string_view kFilling("\0 \t\r\n\v\f", 7);
        if (encoding_ != PlyEncoding::ascii) {
            const bool is_empty = rest_.find_first_not_of(kFilling) == std::string_view::npos;
            return is_empty ? "" : counted(rest_.size(), "byte");
        }
        std::size_t words = 0;
        LineScanner lines(rest_);
        while (lines.next()) {
            std::string_view line = lines.line();
            std::string_view word = take_word(line);
            const bool is_comment = word == "comment" || word == "obj_info";
            for (; !word.empty() && !is_comment; word = take_word(line)) {
                ++words;
            }
        }
        return words == 0 ? "" : counted(words, "word");
    }

  private:
    std::optional<double> next_word() {
        static constexpr Separators kWithLines = " \t\r\n\v\f";
        return parse_real(take_word(rest_, kWithLines));
    }

    template <typename T>
    std::optional<double> take() {
        if (rest_.size() < sizeof(T)) {
            rest_ = {};
            return std::nullopt;
        }
        std::array<char, sizeof(T)> bytes{};
        std::memcpy(bytes.data(), rest_.data(), sizeof(T));
        rest_.remove_prefix(sizeof(T));
        const bool is_little = encoding_ == PlyEncoding::little_endian;
        if (is_little != (std::endian::native == std::endian::little)) {
            std::reverse(bytes.begin(), bytes.end());
        }
        return static_cast<double>(std::bit_cast<T>(bytes));
    }

    std::optional<double> next_binary(PlyType type) {
        switch (type) {
            case PlyType::int8:
                return take<std::int8_t>();
            case PlyType::uint8:
                return take<std::uint8_t>();
            case PlyType::int16:
                return take<std::int16_t>();
            case PlyType::uint16:
                return take<std::uint16_t>();
            case PlyType::int32:
                return take<std::int32_t>();
            case PlyType::uint32:
                return take<std::uint32_t>();
            case PlyType::float32:
                return take<float>();
            default:
                return take<double>();
        }
    }

    std::string_view rest_;
    PlyEncoding encoding_;
};

}  // namespace quasimc
