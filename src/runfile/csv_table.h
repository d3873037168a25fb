#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "files/input_files.h"
#include "text/table_reader.h"

namespace quasimc {

/// A table of texts in a file.
struct CsvTable {
    struct Row {
        std::uint32_t line = 0;
        std::vector<std::string> fields;  ///< one for each name
    };
    std::string file;
    std::uint32_t header_line = 0;
    std::vector<std::string> names = {};  ///< unique names of the columns
    std::vector<Row> rows = {};

    /// The index of a column; empty if there is none.
    [[nodiscard]] std::optional<std::size_t> column(std::string_view name) const;
};

/// Reads a table with a header line, separated by commas, semicolons or tabs; comments begin with
/// '#'. Faults go to the file's lines. Empty after a fault.
/// @param table  which names the file by its key `file`
[[nodiscard]] std::optional<CsvTable> read_csv_table(
    TableReader& table, const std::string& file, InputFiles& files);

}  // namespace quasimc
