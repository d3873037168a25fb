#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "quasimc/scene.h"

namespace quasimc {

/// A pattern of names, "tree{tree}_layer{layer}", that takes labels out of them. `{key}` is one or
/// more characters, `*` any number; both end at the next '/'.
class NamePattern {
  public:
    /// @throws InputError  if two keys follow each other, a key repeats or has no name, or there
    /// are none; its location is "labels_from"
    explicit NamePattern(std::string_view text);

    /// The labels of a name; empty if it does not fit. A pattern with fewer parts between '/' is
    /// compared with the first parts of the name. Keys are as short as possible.
    [[nodiscard]] std::optional<Labels> match(std::string_view name) const;
    /// The keys of its labels.
    [[nodiscard]] std::vector<std::string> keys() const;
    [[nodiscard]] const std::string& text() const { return text_; }

  private:
    /// A literal text, a key or a star.
    struct Token {
        enum class Kind { literal, key, star } kind = Kind::literal;
        std::string text;  ///< the literal, or the key
    };
    using Part = std::vector<Token>;

    static std::vector<Token> tokens_of(std::string_view part);
    static bool match_part(
        const Part& part, std::size_t first, std::string_view name, Labels& labels);
    void check() const;

    std::string text_;
    std::vector<Part> parts_;
};

}  // namespace quasimc
