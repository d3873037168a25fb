#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/runfile/document.h"
#include "quasimc/scene.h"

namespace quasimc::python {

/// A scene, shared by all that were computed with it.
struct SceneHandle {
    std::shared_ptr<const Scene> scene;
    std::vector<Warning> warnings;
};

/// A document that keeps the lines of its file.
struct Document {
    Node node;
    std::string name;    ///< for messages
    std::string folder;  ///< that its paths are relative to
};

}  // namespace quasimc::python
