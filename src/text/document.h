#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace quasimc {

struct Member;

/// A value of a run file, whatever language it was written in (TOML, JSON).
struct Node {
    using List = std::vector<Node>;
    using Table = std::vector<Member>;  ///< in the order of the file

    /// A date or time, kept as its text (TableReader::time_text); or what no run file uses: null.
    struct Other {
        std::string type;
        std::string text = {};
    };

    std::variant<bool, std::int64_t, double, std::string, List, Table, Other> value;
    std::uint32_t line = 0;  ///< from 1; 0: not known

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

/// Values are nested no deeper than this.
inline constexpr int kDeepestNesting = 64;

/// Reads a TOML document.
/// @param file  its name, for messages
/// @throws InputError  where the text is not TOML
[[nodiscard]] Node read_toml(std::string_view text, const std::string& file);

/// Reads a JSON document; lines are not known.
/// @param file  its name, for messages
/// @throws InputError  where the text is not JSON
[[nodiscard]] Node read_json(std::string_view text, const std::string& file);

}  // namespace quasimc
