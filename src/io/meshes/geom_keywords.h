#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace quasimc {

/// Takes the words of a .geom file one after the other: names, numbers, texts and marks. Comments,
/// (# ... #) and from # to the end of a line, are passed over.
class GeomWords {
  public:
    explicit GeomWords(std::string_view text);

    void next();

    [[nodiscard]] std::string_view word() const { return word_; }  ///< of texts without quotes
    [[nodiscard]] std::uint32_t line() const { return line_; }
    [[nodiscard]] bool is_end() const { return kind_ == Kind::end; }
    [[nodiscard]] bool is_name() const { return kind_ == Kind::name; }
    [[nodiscard]] bool is_text() const { return kind_ == Kind::text; }
    [[nodiscard]] bool is(char mark) const { return kind_ == Kind::mark && word_.front() == mark; }

  private:
    enum class Kind { name, number, text, mark, end };

    void pass_blanks();
    void take(std::size_t count, Kind kind);

    std::string_view rest_, word_;
    std::uint32_t line_ = 1;  // of the word
    Kind kind_ = Kind::end;
};

/// Whether a word is what PlantGL calls a kind of object.
[[nodiscard]] bool is_geom_type(std::string_view word);

/// The fields of a kind of object that is read; none of another one.
[[nodiscard]] std::span<const std::string_view> geom_fields(std::string_view type);

}  // namespace quasimc
