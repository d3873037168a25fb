#pragma once

#include <filesystem>
#include <string>

namespace quasimc {

/// The reason why a file can't be written, found without opening it; empty if there is none. Pipes,
/// devices and "-" are not examined.
[[nodiscard]] std::string why_unwritable(const std::filesystem::path& path);

}  // namespace quasimc
