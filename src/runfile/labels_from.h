#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "runfile/geometry_organs.h"
#include "runfile/name_pattern.h"
#include "runfile/run_file_sections.h"

namespace quasimc {

/// `labels_from`: patterns of names, of which the first that fits counts, or a table of names.
struct LabelsFrom {
    std::vector<NamePattern> patterns;
    std::string file;  ///< that has the names; "": patterns
    std::map<std::string, Labels> names;
    std::vector<std::string> keys_of_names;

    /// The keys of all its labels.
    [[nodiscard]] std::vector<std::string> keys() const;
};

/// Empty if it is absent, or after a fault.
[[nodiscard]] std::optional<LabelsFrom> read_labels_from(TableReader& table, InputFiles& files);
/// Reports keys that copies have as labels too.
void check_keys(const LabelsFrom& from, const std::vector<FileCopy>& copies, TableReader& table);
/// Sets the labels of the groups of all files of a table. Reports names that fit nothing: a
/// warning, or a fault if no name fits.
void set_labels_from(const LabelsFrom& from, std::vector<NamedMesh>& files, TableReader& table);

}  // namespace quasimc
