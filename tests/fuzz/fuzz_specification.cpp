// Specification files of both kinds; every file that they name is the specification itself.

#include "coupling/lighting.h"
#include "coupling/vlab/surface_file.h"
#include "readers.h"

namespace quasimc::fuzz {
namespace {

void read_specification(const std::string& text, SpecificationKind kind) {
    Notices silent([](const std::string&) {});
    InputFiles files("/fuzz", [&](const std::filesystem::path&) { return text; });
    try {
        static_cast<void>(read_specification_text(text, "light.qmc", kind, files, silent));
    } catch (const InputError&) {
        return;
    }
}

}  // namespace

void fuzz_specification(const std::string& bytes) {
    read_specification(bytes, SpecificationKind::automatic);
    read_specification(bytes, SpecificationKind::montecarlo);
    try {
        static_cast<void>(read_surface_text(bytes, "leaf.s", 1));
    } catch (const InputError&) {
        return;
    }
}

}  // namespace quasimc::fuzz
