#include <stop_token>

#include "capi/guard.h"
#include "capi/handles.h"
#include "options/options.h"
#include "quasimc/error.h"
#include "resultio/json_parts.h"

namespace quasimc::capi {
namespace {

std::string warning_text(const Warning& warning) {
    return warning.where.empty() ? warning.text : warning.where + ": " + warning.text;
}

LightOfRun read_light(const SceneDescription& description, const Scene& scene) {
    InputFiles files = description.files();
    LightOfRun light =
        read_light_document(description.document(), description.name(), files, scene);
    if (light.series) {
        throw InputError(
            {{description.name() + ": [time]", "the scene has several time steps",
              "a run computes one time step", "give the light by sources alone"}});
    }
    return light;
}

/// Reports progress to a C function, which may end the run.
class ProgressCall final : public RunListener {
  public:
    ProgressCall(quasimc_progress call, void* user) : call_(call), user_(user) {}

    void on_progress(const Progress& progress) override {
        if (call_ != nullptr &&
            call_(progress.fraction, progress.seconds, progress.expected_seconds, user_) != 0) {
            stop_.request_stop();
        }
    }
    [[nodiscard]] std::stop_token token() const { return stop_.get_token(); }

  private:
    quasimc_progress call_;
    void* user_;
    std::stop_source stop_;
};

}  // namespace

std::unique_ptr<quasimc_result> run_light(
    const SceneDescription& description,
    std::shared_ptr<const Scene> scene,
    const std::vector<Warning>& warnings,
    quasimc_progress progress,
    void* user,
    const Run& run) {
    const LightOfRun light = read_light(description, *scene);
    ProgressCall calls(progress, user);
    auto result = std::make_unique<quasimc_result>();
    result->result = run(light, {.stop = calls.token(), .listeners = {&calls}});
    result->scene = std::move(scene);
    result->ratios = light.spec.ratios;
    for (const auto* from : {&warnings, &light.warnings}) {
        for (const Warning& warning : *from) {
            result->warnings.push_back(warning_text(warning));
        }
    }
    result->method = method_name(result->result.chosen.method);
    result->stop = stop_name(result->result.stop);
    return result;
}

namespace {

void build_scene(quasimc_scene& scene) {
    if (scene.built) {
        return;
    }
    const SceneDescription& description = scene.description;
    InputFiles files = description.files();
    SceneOfRun read = read_scene_document(
        description.document(), description.name(), files,
        [&](SceneBuilder& builder) { description.give_organs_to(builder); });
    scene.built = std::make_shared<const Scene>(std::move(read.scene));
    scene.warnings = std::move(read.warnings);
}

}  // namespace
}  // namespace quasimc::capi

using namespace quasimc::capi;  // NOLINT(google-build-using-namespace): this file defines its own

int quasimc_scene_run(
    quasimc_scene* scene, quasimc_progress progress, void* user, quasimc_result** result) {
    return guarded([&] {
        quasimc_result*& out = deref(result, "result");
        out = nullptr;
        quasimc_scene& all = deref(scene, "scene");
        const InUse use(all.in_use);
        build_scene(all);
        out = run_light(
                  all.description, all.built, all.warnings, progress, user,
                  [&](const quasimc::LightOfRun& light, const quasimc::RunControl& control) {
                      return all.simulator.run(*all.built, light.sources, light.spec, control);
                  })
                  .release();
    });
}
