#pragma once

#include <vector>

#include <pybind11/pybind11.h>

#include "runfile/run_file.h"
#include "scene.h"

namespace quasimc::python {

/// A scene before it is built: that of a document, and meshes after it.
/// @param meshes  dicts from quasimc._meshes
[[nodiscard]] FrameOfRun frame_of(
    const Document& document, const std::vector<pybind11::dict>& meshes);

}  // namespace quasimc::python
