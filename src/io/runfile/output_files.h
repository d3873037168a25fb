#pragma once

#include <array>
#include <string_view>

namespace quasimc {

/// The keys of [output] that name files.
inline constexpr std::array<std::string_view, 10> kOutputFiles{
    "csv", "json", "days", "groups_csv", "groups_days", "picture", "vtp", "ply", "glb", "nc"};

}  // namespace quasimc
