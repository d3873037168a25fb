#pragma once

// Copies: the rows of `at`, by which an organ, a file or a lamp is repeated.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "quasimc/mesh.h"
#include "quasimc/scene.h"
#include "results/where_expression.h"
#include "runfile/run_file_sections.h"

namespace quasimc {

/// A row of `at`: where a copy is, how it is turned, and its other keys.
struct CopyRow {
    Vec3 position = {};  ///< file's axes, length unit
    double heading_deg = 0, tilt_deg = 0, roll_deg = 0;
    double scale = 1;
    /// Keys other than those above, in their order; texts, if they are from a file.
    Node::Table others = {};
    std::uint32_t line = 0;  ///< in the run file or the file of copies
};

/// A copy: its row, its numbers and its transform.
struct Copy {
    CopyRow row;
    std::int64_t number = 1;                     ///< within its table, from 1: {copy}
    std::optional<std::int64_t> i = {}, j = {};  ///< within an array, from 1
    Affine transform = {};                       ///< file's axes
};

/// Reads `at`. Empty if it is absent, or after a fault.
/// @param name  name of the table, from which random deviations follow
[[nodiscard]] std::optional<std::vector<Copy>> read_copies(
    TableReader& table, std::string_view name, RunFileContext& context);

/// run_file_copy_table.cpp: reads `at` as a table in a file; empty after a fault.
[[nodiscard]] std::vector<CopyRow> read_copy_table(TableReader& keys, RunFileContext& context);

/// The rows of a regular array.
struct CopyArray {
    std::vector<CopyRow> rows;  ///< along `along` first
    std::int64_t along = 1;     ///< number of rows along `along`
};
/// run_file_array.cpp: reads `at` as a regular array; empty after a fault.
[[nodiscard]] std::optional<CopyArray> read_array(TableReader& array, std::string_view name);

/// The keys of the horizontal axes, which a row must have.
[[nodiscard]] std::array<std::string_view, 2> horizontal_keys(UpAxis up);
/// run_file_copies.cpp: the number of a row that a key sets; null for other keys.
[[nodiscard]] double* number_of_row(CopyRow& row, std::string_view key);

/// Reads a condition, run_file_copies.cpp; empty if it is absent, or after a fault.
[[nodiscard]] std::optional<WhereExpression> read_where(TableReader& table, std::string_view key);

// copy_texts.cpp: texts with placeholders `{key}`, the keys of a copy.

/// The text of a value; empty if it is neither a text nor a number.
[[nodiscard]] std::optional<std::string> text_of_value(const Node& node);

/// The keys of the placeholders of a text, in their order.
[[nodiscard]] std::vector<std::string> placeholders_of(std::string_view text);

/// Replaces the placeholders of texts in a table by the values of copies.
class CopyTexts {
  public:
    /// @param table  whose texts they are, for faults
    CopyTexts(TableReader& table, const std::vector<Copy>& copies)
        : table_(table), copies_(copies) {}

    /// The texts of all copies; empty after a fault.
    /// @param key  of the text, for messages
    [[nodiscard]] std::vector<std::string> fill(std::string_view key, const std::string& text);
    /// The names of all copies: those of their rows, or of the table with placeholders, or else
    /// "name 1", "name 2", ...; without a name, `fallback` instead of it, or none if it is empty.
    [[nodiscard]] std::vector<std::string> names(
        const std::string& name, std::string_view fallback);
    /// The labels of all copies: `labels`, filled, and the other keys of their rows that no
    /// text has used so far.
    [[nodiscard]] std::vector<Labels> labels(const Labels& labels);

  private:
    [[nodiscard]] bool is_used(std::string_view key) const;

    TableReader& table_;
    const std::vector<Copy>& copies_;
    std::vector<std::string> used_{"name"};
};

}  // namespace quasimc
