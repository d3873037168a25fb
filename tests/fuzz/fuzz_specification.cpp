// Specification files of both kinds; every file that they name is the specification itself.

#include <cstddef>
#include <cstdint>

#include "coupling/lighting.h"
#include "coupling/surface_file.h"

namespace {

using namespace quasimc;

void read(const std::string& text, SpecificationKind kind) {
    Notices silent([](const std::string&) {});
    InputFiles files("/fuzz", [&](const std::filesystem::path&) { return text; });
    try {
        static_cast<void>(read_specification_text(text, "light.qmc", kind, files, silent));
    } catch (const InputError&) {
        return;
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(data, data + size);
    read(text, SpecificationKind::automatic);
    read(text, SpecificationKind::montecarlo);
    try {
        static_cast<void>(quasimc::read_surface_text(text, "leaf.s", 1));
    } catch (const quasimc::InputError&) {
        return 0;
    }
    return 0;
}
