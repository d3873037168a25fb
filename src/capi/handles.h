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

// Definitions of the handles of quasimc/capi.h.

struct quasimc_scene {
    quasimc::capi::SceneDescription description;
    /// Null if the description has changed since.
    std::shared_ptr<const quasimc::Scene> built = {};
    std::vector<quasimc::Warning> warnings = {};  ///< from building it
    quasimc::Simulator simulator = {};
    std::size_t meshes = 0;  ///< number of added meshes, for messages
    bool in_use = false;
};

struct quasimc_growth {
    quasimc_scene* scene;
    quasimc::GrowthSession session;
    std::vector<quasimc::Warning> frame_warnings;  ///< from reading the description
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

/// Changes the geometry, the materials or the sensors of a scene, which is then built again.
/// @returns a quasimc_status
int change_scene(quasimc_scene* scene, const std::function<void(SceneDescription&)>& change);

/// A function that computes light.
using Run = std::function<Result(const LightOfRun& light, const RunControl& control)>;

/// Computes the light of a description on a scene. @param warnings  from building the scene
[[nodiscard]] std::unique_ptr<quasimc_result> run_light(
    const SceneDescription& description,
    std::shared_ptr<const Scene> scene,
    const std::vector<Warning>& warnings,
    quasimc_progress progress,
    void* user,
    const Run& run);

}  // namespace quasimc::capi
