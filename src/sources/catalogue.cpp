#include "sources/catalogue.h"

#include <algorithm>
#include <array>

namespace quasimc {

// To add a kind of source, tools/new.py source NAME makes name.cpp (a class derived from Source, or
// a shape of the sky for make_sky), name_test.cpp and docs/theory/name.md, and enters the kind
// here. The keys in [[source]], their checks, `type = "name"` and the line in a result's header
// follow from the row. A kind whose keys depend on each other has no `make`, but a reader of its
// own in io/runfile/run_file_sources.cpp.

// (tools/new.py declares a kind above this line)

namespace {

std::shared_ptr<const Source> uniform_sky_of(const StatedSource& stated) {
    return make_uniform_sky(stated.name, stated.spectrum);
}

constexpr std::array kDirectionalKeys{
    SourceKey{"direction", "in which the light travels"},
    SourceKey{"azimuth_deg", "of where it comes from, clockwise from north"},
    SourceKey{"elevation_deg", "of where it comes from"},
    SourceKey{"irradiance_facing", "per band, on a plane that faces the light"},
    SourceKey{"irradiance_horizontal", "instead: on the horizontal"}};

constexpr std::array kSunKeys{
    SourceKey{"time", "as ISO 8601 writes it"},
    SourceKey{"delta_t_s", "terrestrial less universal time"},
    SourceKey{"azimuth_deg", "instead of a time: where it stands, clockwise from north"},
    SourceKey{"elevation_deg", "instead of a time: where it stands"},
    SourceKey{"disk", "whether it is a disk of its true size"},
    SourceKey{"irradiance_facing", "per band, on a plane that faces it"},
    SourceKey{"irradiance_horizontal", "instead: on the horizontal"}};

constexpr std::array kSkyKeys{
    SourceKey{"model", "its name: quasimc list skies"},
    SourceKey{"irradiance_horizontal", "per band, on the horizontal"},
    SourceKey{"time", "of the sun"},
    SourceKey{"delta_t_s", "terrestrial less universal time"},
    SourceKey{"azimuth_deg", "of the sun"},
    SourceKey{"elevation_deg", "of the sun"},
    SourceKey{"cie_type", "of cie_general, 1 to 15"},
    SourceKey{"turbidity", "of preetham"},
    SourceKey{"direct_normal", "of perez, W m-2"},
    SourceKey{"diffuse_horizontal", "of perez, W m-2"},
    SourceKey{"file", "of table"},
    SourceKey{"format", "of table"},
    SourceKey{"values", "of table"}};

constexpr SourceKey kPosition{"position", "where it stands"};
constexpr SourceKey kAim{"aim", "where it shines; else down"};
constexpr SourceKey kAlong{"along", "across aim; else north"};
constexpr std::array kPointKeys{kPosition};
constexpr std::array kSpotKeys{
    kPosition, kAim, SourceKey{"cone_deg", "angle from the axis at which the light ends"},
    SourceKey{"soft_from_deg", "angle at which it begins to fall"},
    SourceKey{"exponent", "instead: intensity goes as cos^exponent"}};
constexpr std::array kRectangleKeys{
    kPosition, kAim, kAlong, SourceKey{"length", "along `along`"}, SourceKey{"width", "across"}};
constexpr std::array kDiskKeys{kPosition, kAim, SourceKey{"radius", "of the disk"}};
constexpr std::array kLineKeys{SourceKey{"from", "one end"}, SourceKey{"to", "the other end"}};
constexpr std::array kSphereKeys{kPosition, SourceKey{"radius", "of the sphere"}};
constexpr std::array kIesKeys{
    kPosition, kAim, kAlong, SourceKey{"file", "photometric file"},
    SourceKey{"opening", "file or point"}};

// (tools/new.py tells the keys of a kind above this line)

constexpr std::array kKinds{
    SourceEntry{
        .name = "directional",
        .words = "directional",
        .summary = "parallel light",
        .keys = kDirectionalKeys},
    SourceEntry{
        .name = "sun",
        .words = "sun",
        .summary = "the sun at a time or at angles, as a point or a disk",
        .keys = kSunKeys},
    SourceEntry{.name = "sky", .words = "sky", .summary = "a sky of some model", .keys = kSkyKeys},
    SourceEntry{
        .name = "uniform_sky",
        .words = "uniform sky",
        .summary = "the same radiance from everywhere above the horizon",
        .amount = SourceAmount::irradiance_horizontal,
        .make = uniform_sky_of},
    SourceEntry{
        .name = "point",
        .words = "point lamp",
        .summary = "lamp: the same light in all directions",
        .amount = SourceAmount::flux,
        .keys = kPointKeys},
    SourceEntry{
        .name = "spot",
        .words = "spot lamp",
        .summary = "lamp: a cone of light",
        .amount = SourceAmount::flux,
        .keys = kSpotKeys},
    SourceEntry{
        .name = "rectangle",
        .words = "rectangular lamp",
        .summary = "lamp: a panel",
        .amount = SourceAmount::flux,
        .keys = kRectangleKeys},
    SourceEntry{
        .name = "disk",
        .words = "disk lamp",
        .summary = "lamp: a round panel",
        .amount = SourceAmount::flux,
        .keys = kDiskKeys},
    SourceEntry{
        .name = "line",
        .words = "line lamp",
        .summary = "lamp: a thin tube",
        .amount = SourceAmount::flux,
        .keys = kLineKeys},
    SourceEntry{
        .name = "sphere",
        .words = "sphere lamp",
        .summary = "lamp: a ball",
        .amount = SourceAmount::flux,
        .keys = kSphereKeys},
    SourceEntry{
        .name = "ies",
        .words = "lamp of a photometric file",
        .summary = "lamp: as a photometric file says",
        .amount = SourceAmount::flux,
        .keys = kIesKeys},
    // (tools/new.py enters a kind above this line)
};

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
