// Directives for shapes of organs, the ground, and the periodic cell.

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "coupling/vlab/directive_table.h"
#include "coupling/vlab/surface_file.h"

namespace quasimc {
namespace {

void read_surface(Values& values, DirectiveContext& context) {
    // The name may hold blanks; the number of subdivisions is last.
    std::string words = values.rest();
    const std::size_t blank = words.find_last_of(" ,;\t");
    const std::string_view last =
        std::string_view(words).substr(blank == std::string::npos ? 0 : blank + 1);
    std::int64_t subdivisions = 2;
    if (blank != std::string::npos && last.find_first_not_of("+-0123456789") == last.npos) {
        Values number(values.where(), "surface", last, values.faults(), context.notices);
        const auto count = number.integer("the number of subdivisions", {0, 6});
        if (!count) {
            return;
        }
        subdivisions = *count;
        words.resize(words.find_last_not_of(" ,;\t", blank) + 1);
    }
    const auto text = file_text(words, values, context);
    if (!text) {
        return;
    }
    try {
        context.spec.surfaces.push_back(
            {read_surface_text(*text, words, static_cast<int>(subdivisions))});
    } catch (const InputError& error) {
        values.faults().add(error);
    }
}

void read_sides(Values& values, DirectiveContext& context) {
    if (const auto sides = values.integer("the number of sides", {3, 128})) {
        context.spec.cylinder_sides = static_cast<int>(*sides);
    }
}

void read_cylinder_width(Values& values, DirectiveContext& context) {
    constexpr std::array<std::string_view, 2> kNames{"radius", "diameter"};
    if (const auto chosen = values.choice(kNames)) {
        context.spec.cylinder_takes_diameter = *chosen == 1;
        context.spec.cylinder_width_is_given = true;
    }
}

void read_cell(Values& values, DirectiveContext& context) {
    const auto size_x = values.number("the period along x", {1e-30, 1e30});
    const auto size_z = values.number("the period along z", {1e-30, 1e30});
    const auto low_x = values.number_or(0, "the low border along x", kAnyNumber);
    const auto low_z = values.number_or(0, "the low border along z", kAnyNumber);
    if (size_x && size_z && low_x && low_z) {
        context.spec.cell = CellDirective{*size_x, *size_z, *low_x, *low_z};
    }
}

void read_ground(Values& values, DirectiveContext& context) {
    const auto height = values.number("the height");
    const auto first = static_cast<std::int64_t>(context.spec.first_material());
    const auto material =
        values.at_end()
            ? std::optional<std::int64_t>(first)
            : values.integer("the number of its material", {static_cast<double>(first), 1e6});
    if (height && material) {
        context.ground_where = values.where();
        context.spec.ground = GroundDirective{*height, static_cast<std::size_t>(*material - first)};
    }
}

CellDirective& domain_of(DirectiveContext& context) {
    if (!context.domain) {
        context.domain.emplace();
    }
    return *context.domain;
}

void read_domain(Values& values, DirectiveContext& context) {
    const auto x = values.number("the size along x", {1e-30, 1e30});
    static_cast<void>(values.number("the size along y", {1e-30, 1e30}));
    const auto z = values.number("the size along z", {1e-30, 1e30});
    if (x && z) {
        domain_of(context).size_x = *x;
        domain_of(context).size_z = *z;
    }
}

void read_position(Values& values, DirectiveContext& context) {
    const auto x = values.number("the low border along x");
    static_cast<void>(values.number("the low border along y"));
    const auto z = values.number("the low border along z");
    if (x && z) {
        domain_of(context).low_x = *x;
        domain_of(context).low_z = *z;
    }
}

void read_periodic(Values& values, DirectiveContext& context) {
    context.is_periodic = values.yes_no().value_or(false);
}

void read_obstacles(Values& values, DirectiveContext& /*context*/) {
    static_cast<void>(values.rest());
    values.notice("obstacles can't be read from files: send them as organs with E < 0");
}

constexpr std::array kSceneDirectives{
    DirectiveEntry{"surface", Dialect::both, read_surface},
    DirectiveEntry{"cylinder sides", Dialect::both, read_sides},
    DirectiveEntry{"cylinder width", Dialect::both, read_cylinder_width},
    DirectiveEntry{"canopy period", Dialect::quasimc, read_cell},
    DirectiveEntry{"ground", Dialect::both, read_ground},
    DirectiveEntry{"domain size", Dialect::montecarlo, read_domain},
    DirectiveEntry{"position", Dialect::montecarlo, read_position},
    DirectiveEntry{"periodic canopy", Dialect::montecarlo, read_periodic},
    DirectiveEntry{"obstacles", Dialect::montecarlo, read_obstacles},
};

}  // namespace

std::span<const DirectiveEntry> scene_directives() {
    return kSceneDirectives;
}

}  // namespace quasimc
