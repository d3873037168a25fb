#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "runfile/run_file_sections.h"

namespace quasimc {

/// The keys of a [[geometry]] table for materials.
struct MaterialKeys {
    std::optional<std::string> material;              ///< for materials that are unknown otherwise
    std::map<std::string, std::string> by_file_name;  ///< names in the run, by names in the file
};

/// Names of materials in the run, by names in the file.
using FoundMaterials = std::map<std::string, std::string>;

/// A file that a [[geometry]] table names.
struct GeometryFile {
    std::string name;
    MeshFile mesh;
    MaterialKeys keys;
};

/// Maps materials of geometry files to materials of the run. The run file overrides the definitions
/// in files; a material without one in the run file belongs to its file. If files define different
/// materials with one name, each is prefixed with the name of its file.
class FileMaterials {
  public:
    explicit FileMaterials(const RunFileContext& context) : context_(context) {}

    /// Records the materials that a file defines and uses. All files are recorded before find(), so
    /// that their order does not matter.
    void note(const GeometryFile& file);
    /// The materials of a file; adds those that it defines to the builder. Reports missing ones.
    FoundMaterials find(const GeometryFile& file, TableReader& table, SceneBuilder& builder);
    /// Warns of materials of the run file that no file uses although their names resemble one in a
    /// file.
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
    std::map<std::string, std::set<Optics>> defined_;  ///< by name in the files
    std::map<std::string, Optics> added_;              ///< materials in the builder, by name
    std::set<std::string> matched_;  ///< names of matched materials of the run file
};

}  // namespace quasimc
