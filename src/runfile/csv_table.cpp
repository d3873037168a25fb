#include "runfile/csv_table.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "base/number_text.h"
#include "base/text.h"
#include "text/line_scanner.h"
#include "weather/weather.h"

namespace quasimc {
namespace {

/// Goes to the next line that is neither blank nor a comment.
bool next_row(LineScanner& scanner) {
    while (scanner.next()) {
        const std::string_view line = trimmed(scanner.line());
        if (!line.empty() && line.front() != '#') {
            return true;
        }
    }
    return false;
}

/// The first of tab, semicolon and comma in the header.
char separator_of(std::string_view header) {
    constexpr std::string_view kSeparators = "\t;,";
    const auto found = std::find_if(kSeparators.begin(), kSeparators.end(), [&](char c) {
        return header.find(c) != std::string_view::npos;
    });
    return found == kSeparators.end() ? ',' : *found;
}

std::vector<std::string> trimmed_fields(std::string_view line, char separator) {
    std::vector<std::string> fields = split_fields(line, separator);
    for (std::string& field : fields) {
        field = std::string(trimmed(field));
    }
    return fields;
}

void check_names_of_columns(const CsvTable& table, Reporter& reporter) {
    std::set<std::string_view> seen;
    for (const std::string& name : table.names) {
        if (name.empty() || !seen.insert(name).second) {
            reporter.fault(
                table.header_line,
                name.empty() ? "a column has no name"
                             : fmt::format("there are two columns '{}'", name),
                "names of columns must be unique");
        }
    }
}

CsvTable parse_csv_table(std::string_view text, const std::string& file, Reporter& reporter) {
    CsvTable table{.file = file};
    LineScanner scanner(text);
    if (!is_utf8(text)) {
        reporter.fault(0, "it is not UTF-8", "", "save the file as UTF-8");
        return table;
    }
    if (!next_row(scanner)) {
        reporter.fault(0, "it is empty", "its first line must name the columns");
        return table;
    }
    const char separator = separator_of(scanner.line());
    table.header_line = scanner.number();
    table.names = trimmed_fields(scanner.line(), separator);
    check_names_of_columns(table, reporter);
    while (next_row(scanner) && !reporter.is_full()) {
        CsvTable::Row row{scanner.number(), trimmed_fields(scanner.line(), separator)};
        if (row.fields.size() != table.names.size()) {
            reporter.fault(
                row.line, counted(row.fields.size(), "field"),
                fmt::format("the header has {}", table.names.size()));
            continue;
        }
        table.rows.push_back(std::move(row));
    }
    if (table.rows.empty() && reporter.faults.empty()) {
        reporter.fault(table.header_line, "there are no rows below the header", "");
    }
    return table;
}

}  // namespace

std::optional<std::size_t> CsvTable::column(std::string_view name) const {
    const auto found = std::find(names.begin(), names.end(), name);
    return found == names.end() ? std::nullopt
                                : std::optional(static_cast<std::size_t>(found - names.begin()));
}

std::optional<CsvTable> read_csv_table(
    TableReader& table, const std::string& file, InputFiles& files) {
    Reporter reporter{file, {}, {}};
    try {
        CsvTable read = parse_csv_table(files.read(file), file, reporter);
        table.reporter().add(reporter);
        return reporter.faults.empty() ? std::optional(std::move(read)) : std::nullopt;
    } catch (const InputError& error) {
        table.fault_at(
            "file", fmt::format("file '{}' can't be read", file), error.faults().front().why);
        return std::nullopt;
    }
}

}  // namespace quasimc
