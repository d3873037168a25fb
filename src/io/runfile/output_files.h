#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "quasimc/file.h"

namespace quasimc {

/// The keys of [output] that name files.
struct OutputFileKey {
    std::string_view key;
    std::optional<std::string> OutputSpec::*file;
};
inline constexpr std::array<OutputFileKey, 10> kOutputFiles{
    {{"csv", &OutputSpec::csv},
     {"json", &OutputSpec::json},
     {"days", &OutputSpec::days},
     {"groups_csv", &OutputSpec::groups_csv},
     {"groups_days", &OutputSpec::groups_days},
     {"picture", &OutputSpec::picture},
     {"vtp", &OutputSpec::vtp},
     {"ply", &OutputSpec::ply},
     {"glb", &OutputSpec::glb},
     {"nc", &OutputSpec::nc}}};

}  // namespace quasimc
