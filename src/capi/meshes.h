#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "quasimc/scene.h"

namespace quasimc::capi {

/// The arrays of quasimc_scene_add_mesh.
struct RawMesh {
    const double* vertices;
    std::int64_t vertex_count;
    const std::int32_t* faces;
    std::int64_t face_count;
    const std::int64_t* organ_of_face;
    const char* materials;
    const std::int32_t* material_of_face;
    std::string where;  ///< for messages
};

/// The organs of arrays, in ascending order of ids. @throws InputError, Misuse
[[nodiscard]] std::vector<OrganSpec> organs_of(const RawMesh& mesh);

}  // namespace quasimc::capi
