#pragma once

#include <cstdint>
#include <optional>
#include <string>

/// The path of a step, if the file's name has a pattern: "step_012.glb" for "step_%03d.glb".
[[nodiscard]] std::optional<std::string> numbered_path(const std::string& path, std::int64_t step);
