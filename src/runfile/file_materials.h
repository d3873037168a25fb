#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "runfile/run_file_sections.h"

namespace quasimc {

/// What a [[geometry]] table says of materials.
struct MaterialKeys {
    std::optional<std::string> material;              ///< for what is not known otherwise
    std::map<std::string, std::string> by_file_name;  ///< of the run, by the file's
};

/// The run's names of a file's materials, by the file's.
using FoundMaterials = std::map<std::string, std::string>;

/// A file that a [[geometry]] table names.
struct GeometryFile {
    std::string name;
    MeshFile mesh;
    MaterialKeys keys;
};

/// Finds the materials of a run for those of its files. The run file overrides what files say of
/// theirs; what it does not give belongs to the file that defines it. Where files define different
/// materials of one name, the name of its file stands before each.
class FileMaterials {
  public:
    explicit FileMaterials(const RunFileContext& context) : context_(context) {}

    /// Notes what a file defines and uses. All files are noted before materials are found, so that
    /// their order does not matter.
    void note(const GeometryFile& file);
    /// The materials of a file; adds to the builder those that the file defines. Faults where there
    /// is none.
    FoundMaterials find(const GeometryFile& file, TableReader& table, SceneBuilder& builder);
    /// Warns of materials of the run file that seem to be meant for one of a file, and are for
    /// none.
    void warn_of_unmatched(Reporter& reporter) const;

  private:
    /// Reflectance and transmittance.
    using Optics = std::pair<double, double>;
    struct Search;

    [[nodiscard]] std::optional<std::string> from_run_file(
        const GeometryFile& file, const std::string& name);
    [[nodiscard]] std::string name_of(const std::string& file, const MeshMaterial& material) const;
    std::string find_one(Search& search, const std::string& name);
    std::string missing(Search& search, const std::string& name) const;

    const RunFileContext& context_;
    std::map<std::string, std::set<Optics>> defined_;  ///< by the names in the files
    std::map<std::string, Optics> added_;              ///< to the builder, by name
    std::set<std::string> matched_;                    ///< materials of the run file
};

}  // namespace quasimc
