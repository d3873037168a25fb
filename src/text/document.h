#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace quasimc {

struct Member;

/// A value of a document in TOML or JSON.
struct Node {
    using List = std::vector<Node>;
    using Table = std::vector<Member>;  ///< in the order of the file

    /// A date or time as its text (TableReader::time_text), or null, which run files do not use.
    struct Other {
        std::string type;
        std::string text = {};
    };

    std::variant<bool, std::int64_t, double, std::string, List, Table, Other> value;
    std::uint32_t line = 0;  ///< from 1; 0: unknown

    template <typename T>
    [[nodiscard]] const T* as() const {
        return std::get_if<T>(&value);
    }
    [[nodiscard]] const Node* find(std::string_view key) const;  ///< null if absent or no table
    [[nodiscard]] std::string_view type_name() const;            ///< "a table", "a text", ...
};

/// A key of a table with its value.
struct Member {
    std::string key;
    std::uint32_t line = 0;
    Node node;
};

/// Largest depth of nested values.
inline constexpr int kDeepestNesting = 64;

/// Reads a TOML document.
/// @param file  its name, for messages
/// @throws InputError  if the text is not TOML
[[nodiscard]] Node read_toml(std::string_view text, const std::string& file);

/// Reads a JSON document, without line numbers.
/// @param file  its name, for messages
/// @throws InputError  if the text is not JSON
[[nodiscard]] Node read_json(std::string_view text, const std::string& file);

}  // namespace quasimc
