#pragma once

#include <memory>
#include <string>
#include <vector>

#include <pybind11/pybind11.h>

#include "quasimc/scene.h"
#include "runfile/run_file.h"
#include "scene/mesh_arrays.h"
#include "text/document.h"

namespace quasimc::python {

/// A scene, shared by all results computed with it.
struct SceneHandle {
    std::shared_ptr<const Scene> scene;
    std::vector<Warning> warnings;
};

/// A document that keeps the lines of its file.
struct Document {
    Node node;
    std::string name;                    ///< for messages
    std::string folder;                  ///< base of its relative paths
    Vocabulary vocabulary = {};          ///< names tables in messages
    std::vector<InputFile> inputs = {};  ///< the run file, if results of it are written again
};

/// A view of the arrays in a dict from quasimc._meshes, which must outlive it.
[[nodiscard]] MeshArrays arrays_of(const pybind11::dict& mesh);

/// A scene before it is built: that of a document, and meshes after it.
/// @param meshes  dicts from quasimc._meshes
[[nodiscard]] FrameOfRun frame_of(
    const Document& document, const std::vector<pybind11::dict>& meshes);

/// One text for each warning, which begins with its location if it has one.
[[nodiscard]] pybind11::list warning_texts(const std::vector<Warning>& warnings);

}  // namespace quasimc::python
