#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "quasimc/run_file.h"

namespace quasimc {

/// A file that a run may write.
struct OutputFile {
    std::string_view key;  ///< of [output]; its flag is called so too, with hyphens
    std::optional<std::string> OutputSpec::*path;
};

/// The files in the order in which they get their names: the result that has everything is the
/// last.
inline constexpr std::array<OutputFile, 10> kOutputFiles{
    {{"csv", &OutputSpec::csv},
     {"days", &OutputSpec::days},
     {"groups_csv", &OutputSpec::groups_csv},
     {"groups_days", &OutputSpec::groups_days},
     {"picture", &OutputSpec::picture},
     {"vtp", &OutputSpec::vtp},
     {"ply", &OutputSpec::ply},
     {"glb", &OutputSpec::glb},
     {"nc", &OutputSpec::nc},
     {"json", &OutputSpec::json}}};

}  // namespace quasimc
