#include "light/models/catalogue.h"

#include <algorithm>
#include <array>

namespace quasimc {
namespace {

// To add a kind of source: a class derived from Source in a file of its own, or a shape of the sky
// for make_sky; a row here; a reader of its keys, named in runfile/run_file_sources.cpp.
constexpr std::array kKinds{
    SourceEntry{"directional", "directional", "parallel light"},
    SourceEntry{"sun", "sun", "the sun at a time or at angles, as a point or a disk"},
    SourceEntry{"sky", "sky", "a sky of some model"},
    SourceEntry{
        "uniform_sky", "uniform sky", "the same radiance from everywhere above the horizon"},
    SourceEntry{"point", "point lamp", "lamp: the same light in all directions"},
    SourceEntry{"spot", "spot lamp", "lamp: a cone of light"},
    SourceEntry{"rectangle", "rectangular lamp", "lamp: a panel"},
    SourceEntry{"disk", "disk lamp", "lamp: a round panel"},
    SourceEntry{"line", "line lamp", "lamp: a thin tube"},
    SourceEntry{"sphere", "sphere lamp", "lamp: a ball"},
    SourceEntry{"ies", "lamp of a photometric file", "lamp: as a photometric file says"}};

}  // namespace

std::span<const SourceEntry> source_catalogue() {
    return kKinds;
}

const SourceEntry* find_source(std::string_view name) {
    const auto* found = std::find_if(
        kKinds.begin(), kKinds.end(), [&](const SourceEntry& entry) { return entry.name == name; });
    return found == kKinds.end() ? nullptr : found;
}

}  // namespace quasimc
