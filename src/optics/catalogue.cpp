#include "optics/catalogue.h"

#include <array>

#include "optics/blinn_phong.h"
#include "optics/lambertian.h"
#include "optics/mirror.h"
#include "optics/phong.h"

namespace quasimc {
namespace {

// To add a model (tools/new.py bsdf NAME starts it):
// 1. name.h with its manual page on top, name.cpp with a class derived from Bsdf. Mind the
// contract:
//    integral 1 for every wi, no light on the wrong side.
// 2. A row here; the file in CMakeLists.txt.
// 3. docs/theory/name.md, and name_test.cpp for what is special to it. The grid of
//    tests/unit/optics/models_test.cpp tries every row by itself.
constexpr std::array kModels = {
    BsdfEntry{"lambertian", "matt: Lambert's cosine law", false, make_lambertian},
    BsdfEntry{"phong", "glossy: cos^n of the angle to the specular direction", true, make_phong},
    BsdfEntry{
        "blinn_phong", "glossy: cos^n of half the angle to the specular direction", true,
        make_blinn_phong},
    BsdfEntry{
        "mirror", "one direction: mirrored if reflected, straight on if transmitted", false,
        make_mirror},
};

}  // namespace

std::span<const BsdfEntry> bsdf_catalogue() {
    return kModels;
}

const BsdfEntry* find_bsdf(std::string_view name) {
    for (const BsdfEntry& entry : kModels) {
        if (entry.name == name) {
            return &entry;
        }
    }
    return nullptr;
}

}  // namespace quasimc
