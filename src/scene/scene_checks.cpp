#include "scene/scene_checks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "base/text.h"

namespace quasimc {
namespace {

constexpr std::size_t kMostOrganFaults = 1000;
constexpr std::int64_t kLastId = std::numeric_limits<std::int64_t>::max();

std::string text_of(const Vec3& p) {
    return fmt::format("({}, {}, {})", shortest(p.x), shortest(p.y), shortest(p.z));
}

bool is_usable(const Vec3& p) {
    const auto small = [](double x) { return std::abs(x) <= kLargestCoordinate; };
    return small(p.x) && small(p.y) && small(p.z);
}

/// A fault about the first corner that is not usable.
Fault corner_fault(const OrganSpec& organ, std::size_t bad_triangles) {
    std::size_t number = 0;
    for (const OrganPart& part : organ.parts) {
        for (const Triangle& t : part.triangles) {
            ++number;
            const auto corner = std::find_if_not(t.begin(), t.end(), is_usable);
            if (corner == t.end()) {
                continue;
            }
            std::string problem = fmt::format(
                "corner {} of triangle {} is {}", corner - t.begin() + 1, number, text_of(*corner));
            if (bad_triangles > 1) {
                problem += fmt::format(", and {} more triangles are like it", bad_triangles - 1);
            }
            return {
                "", problem,
                fmt::format("coordinates are finite numbers up to {}", kLargestCoordinate), ""};
        }
    }
    return {};
}

void check_axis_of_cell(char axis, double low, double size, double extent, Faults& faults) {
    const std::string place = fmt::format("cell along {}", axis);
    if (!std::isfinite(low) || std::abs(low) > kLargestCoordinate) {
        faults.add(
            {place, fmt::format("the low border is {}", shortest(low)),
             "borders are finite numbers", ""});
    }
    if (!(size > 0) || !(size <= kLargestCoordinate)) {
        faults.add(
            {place, fmt::format("the size is {}", shortest(size)), "periods are positive numbers",
             "leave the axis open if nothing is repeated along it"});
        return;
    }
    constexpr double kSmallestPart = 1e-6;
    if (size < kSmallestPart * extent) {
        faults.add(
            {place,
             fmt::format(
                 "the size {} is less than a millionth of the scene, {}", shortest(size),
                 shortest(extent)),
             "", "state cell and organs in the same unit of length"});
    }
}

/// About how many cells the triangles lie in, each counted by itself.
double images_in(const Cell& cell, std::span<const OrganSpec> organs) {
    double images = 0;
    for (const OrganSpec& organ : organs) {
        for (const OrganPart& part : organ.parts) {
            for (const Triangle& t : part.triangles) {
                const auto [low_x, high_x] = std::minmax({t[0].x, t[1].x, t[2].x});
                const auto [low_y, high_y] = std::minmax({t[0].y, t[1].y, t[2].y});
                images += (cell.along_x ? 1 + (high_x - low_x) / cell.size_x : 1) *
                          (cell.along_y ? 1 + (high_y - low_y) / cell.size_y : 1);
            }
        }
    }
    return images;
}

void add_repeated_ids(const std::vector<OrganSpec>& organs, OrganFaults& faults) {
    std::vector<std::uint32_t> order(organs.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return *organs[a].id < *organs[b].id;
    });
    std::uint32_t first = order.front();
    for (const std::uint32_t i : order) {
        if (i == first || *organs[i].id != *organs[first].id) {
            first = i;
            continue;
        }
        faults.add(
            organs[i], {"", fmt::format("id {} is taken", *organs[i].id),
                        "by " + place_of(organs[first]), "ids are unique in a scene"});
    }
}

}  // namespace

std::string place_of(const OrganSpec& organ) {
    if (!organ.place.empty()) {
        return fmt::format("{}: organ '{}'", organ.place, organ.name);
    }
    return organ.id ? fmt::format("organ '{}' (id {})", organ.name, *organ.id)
                    : fmt::format("organ '{}'", organ.name);
}

std::string place_of(const MaterialSpec& material, const std::string& place) {
    const std::string which = fmt::format("material '{}'", material.name);
    return place.empty() ? which : place + ": " + which;
}

void OrganFaults::add(const OrganSpec& organ, Fault fault) {
    if (++count_ <= kMostOrganFaults) {
        fault.place = place_of(organ);
        faults_.add(std::move(fault));
    }
}

void OrganFaults::finish() {
    if (count_ > kMostOrganFaults) {
        faults_.add({"organs", fmt::format("{} more faults", count_ - kMostOrganFaults), "", ""});
    }
}

void check_bands(const std::vector<Band>& bands, Faults& faults) {
    if (bands.empty()) {
        faults.add({"bands", "there is none", "light is computed per waveband", "name one"});
    }
    for (std::size_t i = 0; i < bands.size(); ++i) {
        const std::string& name = bands[i].name;
        if (name.empty()) {
            faults.add({"bands", fmt::format("band {} has no name", i + 1), "", ""});
            continue;
        }
        const auto same = [&](const Band& band) { return band.name == name; };
        if (std::any_of(bands.begin(), bands.begin() + static_cast<std::ptrdiff_t>(i), same)) {
            faults.add(
                {"bands", fmt::format("band '{}' is named twice", name), "names are unique", ""});
        }
    }
}

void check_north(const Orientation& orientation, Faults& faults) {
    const Vec3 north = orientation.inward(orientation.north());
    const double size = length(north);
    if (!is_finite(north) || !(size > 0) || !std::isfinite(size)) {
        faults.add(
            {"north", fmt::format("{} is no direction", text_of(orientation.north())), "", ""});
    } else if (north.z != 0) {
        faults.add(
            {"north", fmt::format("{} is not horizontal", text_of(orientation.north())),
             fmt::format("{} is up", orientation.up() == UpAxis::z ? "z" : "y"), ""});
    }
}

void check_cell(const Cell& cell, const Bounds& organs, Faults& faults) {
    const Vec3 extent = organs.empty() ? Vec3{} : organs.size();
    if (cell.along_x) {
        check_axis_of_cell('x', cell.low_x, cell.size_x, extent.x, faults);
    }
    if (cell.along_y) {
        check_axis_of_cell('y', cell.low_y, cell.size_y, extent.y, faults);
    }
}

void check_images(const Cell& cell, std::span<const OrganSpec> organs, Faults& faults) {
    constexpr double kMostImages = 1e8;
    const double images = cell.periodic() ? images_in(cell, organs) : 0;
    if (images > kMostImages) {
        faults.add(
            {"cell", fmt::format("the triangles reach over {:.0f} cells in all", images),
             "their images in each are traced",
             "state cell and organs in the same unit of length"});
    }
}

std::int64_t number_organs(std::vector<OrganSpec>& organs, OrganFaults& faults) {
    std::int64_t largest = 0;
    std::optional<std::int64_t> previous;
    bool ascending = true;
    for (OrganSpec& organ : organs) {
        organ.id = organ.id.value_or(largest + 1);
        if (organ.name.empty()) {
            organ.name = fmt::format("organ {}", *organ.id);
        }
        if (*organ.id >= kLastId) {
            faults.add(
                organ, {"", fmt::format("id {} is too large", *organ.id),
                        fmt::format("ids end at {}", kLastId - 1), ""});
        }
        largest = std::clamp(*organ.id, largest, kLastId - 1);
        ascending = ascending && (!previous || *organ.id > *previous);
        previous = organ.id;
    }
    if (!ascending) {
        add_repeated_ids(organs, faults);
    }
    return largest + 1;
}

Bounds take_inward(OrganSpec& organ, const Orientation& orientation, OrganFaults& faults) {
    Bounds bounds;
    std::size_t triangles = 0;
    std::size_t bad = 0;
    for (const OrganPart& part : organ.parts) {
        triangles += part.triangles.size();
        bad += static_cast<std::size_t>(std::count_if(
            part.triangles.begin(), part.triangles.end(),
            [](const Triangle& t) { return !std::all_of(t.begin(), t.end(), is_usable); }));
    }
    if (triangles == 0) {
        faults.add(organ, {"", "it has no triangles", "light falls on triangles", ""});
    }
    if (bad > 0) {
        faults.add(organ, corner_fault(organ, bad));
        return bounds;
    }
    for (OrganPart& part : organ.parts) {
        for (Triangle& t : part.triangles) {
            for (Vec3& corner : t) {
                corner = orientation.inward(corner);
                bounds.add(corner);
            }
        }
    }
    return bounds;
}

}  // namespace quasimc
