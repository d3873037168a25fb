#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "capi/scene_description.h"
#include "quasimc/capi.h"
#include "quasimc/result.h"
#include "quasimc/run.h"
#include "quasimc/scene.h"
#include "runfile/run_file.h"

// What the handles of quasimc/capi.h are.

struct quasimc_scene {
    quasimc::capi::SceneDescription description;
    std::shared_ptr<const quasimc::Scene> built = {};  ///< none: something was stated since
    std::vector<quasimc::Warning> warnings = {};       ///< of building it
    quasimc::Simulator simulator = {};
    std::size_t meshes = 0;  ///< that were added, for messages
    bool in_use = false;
};

struct quasimc_growth {
    quasimc_scene* scene;
    quasimc::GrowthSession session;
    std::vector<quasimc::Warning> frame_warnings;  ///< of reading what the scene says
    bool in_use = false;
};

struct quasimc_result {
    quasimc::Result result;
    std::shared_ptr<const quasimc::Scene> scene;
    std::vector<std::string> ratios;
    std::vector<std::string> warnings;
    std::string method, stop;
};

namespace quasimc::capi {

/// A run: given how it is told of and stopped.
using Run = std::function<Result(const LightOfRun& light, const RunControl& control)>;

/// Runs the light that a statement says on a scene. @param warnings  of building the scene
[[nodiscard]] std::unique_ptr<quasimc_result> run_light(
    const SceneDescription& description,
    std::shared_ptr<const Scene> scene,
    const std::vector<Warning>& warnings,
    quasimc_progress progress,
    void* user,
    const Run& run);

}  // namespace quasimc::capi
