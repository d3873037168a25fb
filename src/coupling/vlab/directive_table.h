#pragma once

#include <span>
#include <string_view>

#include "coupling/vlab/directive.h"
#include "coupling/vlab/specification.h"

namespace quasimc {

/// Input of a directive beside its values.
struct DirectiveContext {
    Specification& spec;
    InputFiles& files;
    Notices& notices;
    const DirectiveLine* line = nullptr;
    std::string file;  ///< name of the specification, for messages
    /// Area of MonteCarlo's domain seen from above, and its low corner.
    std::optional<CellDirective> domain = {};
    bool is_periodic = false;
    std::string ground_where = {};
    bool has_leaf_upper = false;
};

/// Programs that know a directive.
enum class Dialect { both, quasimc, montecarlo };

/// One row of the table of directives.
struct DirectiveEntry {
    std::string_view name;  ///< lower case
    Dialect dialect;
    void (*read)(Values& values, DirectiveContext& context);
};

// To add a directive: a function in the file of its kind, a row there, a row in
// docs/reference/specification.md.
[[nodiscard]] std::span<const DirectiveEntry> light_directives();
[[nodiscard]] std::span<const DirectiveEntry> material_directives();
[[nodiscard]] std::span<const DirectiveEntry> run_directives();
[[nodiscard]] std::span<const DirectiveEntry> scene_directives();
[[nodiscard]] std::span<const DirectiveEntry> montecarlo_directives();

/// The text of a file that a directive names; a fault if it can't be read.
[[nodiscard]] std::optional<std::string> file_text(
    const std::string& name, Values& values, DirectiveContext& context);

}  // namespace quasimc
