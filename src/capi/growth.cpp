#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "capi/guard.h"
#include "capi/handles.h"
#include "capi/meshes.h"

namespace quasimc::capi {
namespace {

/// The scene of a description, without its light.
FrameOfRun frame_of(const SceneDescription& description) {
    InputFiles files = description.files();
    return read_frame_document(
        description.document(), description.name(), files,
        [&](SceneBuilder& builder) { description.give_organs_to(builder); });
}

/// The warnings of the scene of this step, of its description and of lint().
std::vector<Warning> warnings_of(quasimc_growth& growth) {
    std::vector<Warning> all = growth.frame_warnings;
    const std::vector<Warning>& of_scene = growth.session.warnings();
    all.insert(all.end(), of_scene.begin(), of_scene.end());
    return all;
}

/// Passes the organs of arrays to a session, all or none.
template <typename Take>
int give_organs(quasimc_growth* growth, const RawMesh& mesh, const Take& take) {
    return guarded([&] {
        quasimc_growth& all = deref(growth, "growth");
        const InUse use(all.in_use);
        static_cast<void>(deref(mesh.organ_of_face, "organ_of_face"));
        take(all.session, organs_of(mesh));
    });
}

}  // namespace
}  // namespace quasimc::capi

using namespace quasimc::capi;  // NOLINT(google-build-using-namespace): this file defines its own

int quasimc_growth_new(quasimc_scene* scene, quasimc_growth** growth) {
    return guarded([&] {
        quasimc_growth*& out = deref(growth, "growth");
        out = nullptr;
        quasimc_scene& all = deref(scene, "scene");
        const InUse use(all.in_use);
        quasimc::FrameOfRun frame = frame_of(all.description);
        auto made = std::make_unique<quasimc_growth>(quasimc_growth{
            &all, quasimc::GrowthSession(std::move(frame.builder)), std::move(frame.warnings)});
        out = made.release();
    });
}

void quasimc_growth_free(quasimc_growth* growth) {
    delete growth;  // NOLINT: a handle
}

// NOLINTNEXTLINE(readability-function-size): the arrays of the C interface
int quasimc_growth_add_mesh(
    quasimc_growth* growth,
    const double* vertices,
    int64_t vertex_count,
    const int32_t* faces,
    int64_t face_count,
    const int64_t* organ_of_face,
    const char* materials,
    const int32_t* material_of_face) {
    return give_organs(
        growth,
        {vertices, vertex_count, faces, face_count, organ_of_face, materials, material_of_face,
         "add"},
        [](quasimc::GrowthSession& session, std::vector<quasimc::OrganSpec> organs) {
            session.add(std::move(organs));
        });
}

// NOLINTNEXTLINE(readability-function-size): the arrays of the C interface
int quasimc_growth_change_mesh(
    quasimc_growth* growth,
    const double* vertices,
    int64_t vertex_count,
    const int32_t* faces,
    int64_t face_count,
    const int64_t* organ_of_face,
    const char* materials,
    const int32_t* material_of_face) {
    return give_organs(
        growth,
        {vertices, vertex_count, faces, face_count, organ_of_face, materials, material_of_face,
         "change"},
        [](quasimc::GrowthSession& session, std::vector<quasimc::OrganSpec> organs) {
            session.change(std::move(organs));
        });
}

int quasimc_growth_remove(quasimc_growth* growth, int64_t organ) {
    return guarded([&] {
        quasimc_growth& all = deref(growth, "growth");
        const InUse use(all.in_use);
        all.session.remove(organ);
    });
}

int quasimc_growth_update_scene(quasimc_growth* growth) {
    return guarded([&] {
        quasimc_growth& all = deref(growth, "growth");
        const InUse use(all.in_use);
        const InUse scene_in_use(all.scene->in_use);
        quasimc::FrameOfRun frame = frame_of(all.scene->description);
        all.session.set_frame(std::move(frame.builder));
        all.frame_warnings = std::move(frame.warnings);
    });
}

int quasimc_growth_run(
    quasimc_growth* growth, quasimc_progress progress, void* user, quasimc_result** result) {
    return guarded([&] {
        quasimc_result*& out = deref(result, "result");
        out = nullptr;
        quasimc_growth& all = deref(growth, "growth");
        const InUse use(all.in_use);
        const InUse scene_in_use(all.scene->in_use);
        out = run_light(
                  all.scene->description, all.session.scene(), warnings_of(all), progress, user,
                  [&](const quasimc::LightOfRun& light, const quasimc::RunControl& control) {
                      return all.session.run(light.sources, light.spec, control);
                  })
                  .release();
    });
}
