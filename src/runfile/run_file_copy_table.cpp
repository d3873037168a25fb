// Reads a table of copies: { file, where, columns }.

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "results/where_expression.h"
#include "runfile/copies.h"
#include "runfile/csv_table.h"
#include "text/numbers.h"

namespace quasimc {
namespace {

/// Reads the rows of a table of copies.
class CopyTable {
  public:
    CopyTable(TableReader& keys, RunFileContext& context) : keys_(keys), context_(context) {}

    std::vector<CopyRow> read() {
        const std::optional<std::string> file = keys_.text("file");
        const std::map<std::string, std::string> columns = read_columns();
        const std::optional<WhereExpression> where = read_where(keys_, "where");
        const auto table = file ? read_csv_table(keys_, *file, *context_.files) : std::nullopt;
        if (!table || keys_.failed()) {
            return {};
        }
        Reporter reporter{table->file, {}, {}};
        const std::vector<std::string> names = names_of_columns(*table, columns, reporter);
        const bool has_names = reporter.faults.empty();
        if (where && has_names) {
            check_where(*where, names);
        }
        for (std::size_t i = 0; has_names && i < table->rows.size() && !reporter.is_full(); ++i) {
            read_file_row(table->rows[i], names, where, reporter);
        }
        if (rows_.empty() && reporter.faults.empty() && !keys_.failed()) {
            keys_.fault_at("where", "where fits no row of " + table->file);
        }
        keys_.reporter().add(reporter);
        return std::move(rows_);
    }

  private:
    void check_where(const WhereExpression& where, const std::vector<std::string>& names) {
        try {
            where.check_names(std::vector<std::string_view>(names.begin(), names.end()), "column");
        } catch (const InputError& error) {
            for (const Fault& fault : error.faults()) {
                keys_.fault_at("where", "where: " + fault.problem, fault.why, fault.suggestion);
            }
        }
    }

    /// `columns`: the names in the file by ours.
    std::map<std::string, std::string> read_columns() {
        std::map<std::string, std::string> columns;
        const Node* node = keys_.any("columns");
        const auto* members = node != nullptr ? node->as<Node::Table>() : nullptr;
        if (node != nullptr && members == nullptr) {
            keys_.fault_at(
                *node, fmt::format("columns is {}", node->type_name()),
                "it must be a table: columns = { x = \"name of the column\" }");
        }
        for (std::size_t i = 0; members != nullptr && i < members->size(); ++i) {
            const Member& member = (*members)[i];
            if (const auto* text = member.node.as<std::string>()) {
                columns[*text] = member.key;
            } else {
                keys_.fault_at(
                    member.node,
                    fmt::format("columns.{} is {}", member.key, member.node.type_name()),
                    "it must be the name of a column");
            }
        }
        return columns;
    }

    /// Our names of the columns of a file.
    [[nodiscard]] std::vector<std::string> names_of_columns(
        const CsvTable& table,
        const std::map<std::string, std::string>& columns,
        Reporter& reporter) const {
        const std::vector<std::string_view> in_file(table.names.begin(), table.names.end());
        for (const auto& [name, ours] : columns) {
            if (!table.column(name)) {
                reporter.fault(
                    table.header_line, fmt::format("there is no column '{}'", name),
                    fmt::format("columns are {}", joined(in_file, ", ")),
                    near_word_text(name, in_file));
            }
        }
        std::vector<std::string> names = table.names;
        for (std::string& name : names) {
            if (const auto renamed = columns.find(name); renamed != columns.end()) {
                name = renamed->second;
            }
        }
        for (const std::string_view axis : horizontal_keys(context_.orientation.up())) {
            const bool is_there = std::find(names.begin(), names.end(), axis) != names.end();
            const bool is_named = std::any_of(
                columns.begin(), columns.end(), [&](const auto& c) { return c.second == axis; });
            if (!is_there && !is_named) {
                reporter.fault(
                    table.header_line, fmt::format("there is no column '{}'", axis),
                    fmt::format("columns are {}", joined(in_file, ", ")), suggested_columns(table));
            }
        }
        return names;
    }

    /// "say which: columns = { x = "X", y = "Y" }".
    [[nodiscard]] std::string suggested_columns(const CsvTable& table) const {
        std::string text;
        for (const std::string_view axis : horizontal_keys(context_.orientation.up())) {
            const auto same = std::find_if(
                table.names.begin(), table.names.end(),
                [&](const std::string& name) { return lower_case(name) == axis; });
            text += fmt::format(
                "{}{} = \"{}\"", text.empty() ? "" : ", ", axis,
                same == table.names.end() ? "..." : *same);
        }
        return fmt::format("say which: columns = {{ {} }}", text);
    }

    void read_file_row(
        const CsvTable::Row& fields,
        const std::vector<std::string>& names,
        const std::optional<WhereExpression>& where,
        Reporter& reporter) {
        const auto value_of = [&](std::string_view name) -> std::optional<WhereValue> {
            const auto found = std::find(names.begin(), names.end(), name);
            const auto column = static_cast<std::size_t>(found - names.begin());
            return column == names.size() || fields.fields[column].empty()
                       ? std::nullopt
                       : std::optional(WhereValue::of_text(fields.fields[column]));
        };
        if (where && !where->holds(value_of)) {
            return;
        }
        CopyRow row{.line = fields.line};
        for (std::size_t c = 0; c < names.size(); ++c) {
            const std::string& field = fields.fields[c];
            double* number = number_of_row(row, names[c]);
            if (number == nullptr) {
                row.others.push_back({names[c], 0, Node{field, 0}});
                continue;
            }
            const std::optional<double> value = parse_real(field);
            if (!value || !std::isfinite(*value)) {
                reporter.fault(
                    fields.line, fmt::format("{} is '{}'", names[c], field),
                    "it must be a finite number");
                return;
            }
            *number = *value;
        }
        if (!(row.scale > 0)) {
            reporter.fault(
                fields.line, fmt::format("scale is {}", shortest(row.scale)), "it must be above 0",
                "a copy without a size can be left out by where");
            return;
        }
        rows_.push_back(std::move(row));
    }

    TableReader& keys_;
    RunFileContext& context_;
    std::vector<CopyRow> rows_;
};

}  // namespace

std::vector<CopyRow> read_copy_table(TableReader& keys, RunFileContext& context) {
    return CopyTable(keys, context).read();
}

}  // namespace quasimc
