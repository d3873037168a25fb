#include "stress/grammar.h"

#include <utility>

#include <fmt/format.h>

namespace quasimc::stress {
namespace {

void add_cell(Draft& draft) {
    Random& random = draft.random;
    if (!random.chance(.2)) {
        return;
    }
    draft.is_periodic = true;
    const bool is_row = random.chance(.2);
    Node cell = empty_table();
    for (const char* axis : {"x", "y"}) {
        const double low = random.between(-.3, .3);
        const double size = random.power_of_ten(-.4, .6);
        const Vec3 from = draft.placed({low, low, 0});
        const Vec3 to = draft.placed({low + size, low + size, 0});
        const bool is_x = axis[0] == 'x';
        set(cell, axis, node_of(std::vector<double>{is_x ? from.x : from.y, is_x ? to.x : to.y}));
        if (is_row) {
            break;
        }
    }
    set(draft.document, "cell", std::move(cell));
}

void add_ground(Draft& draft) {
    Random& random = draft.random;
    if (!random.chance(draft.is_periodic ? .7 : .3)) {
        return;
    }
    Node ground = empty_table();
    set(ground, "material", node_of(random.pick(draft.materials)));
    const double height = random.chance(.2) ? 0 : random.between(-1, .3);
    set(ground, "height", node_of(draft.placed({0, 0, height}).z));
    if (!draft.is_periodic && tables_at(draft.document, "organ").size() <= 3) {
        // A ground as wide as the organs might have zero width.
        const bool is_y_up = find(draft.document, "up") != nullptr;
        const Vec3 low = draft.placed({-.5, -.5, -.5});
        const Vec3 high = draft.placed({1.5, 1.5, 1.5});
        set(ground, "x", node_of(std::vector<double>{low.x, high.x}));
        set(ground, is_y_up ? "z" : "y",
            node_of(
                is_y_up ? std::vector<double>{low.z, high.z} : std::vector<double>{low.y, high.y}));
    }
    set(draft.document, "ground", std::move(ground));
    draft.anchors.push_back({{.5, .5, height}, {0, 0, 1}});
}

void add_options(Draft& draft) {
    Random& random = draft.random;
    Node run = empty_table();
    const std::vector<std::string> samplers{"sobol",  "sobol", "sobol", "korobov",
                                            "halton", "faure", "sobol", "monte_carlo"};
    set(run, "sampler", node_of(random.pick(samplers)));
    if (random.chance(.1)) {
        set(run, "roulette_threshold", node_of(random.power_of_ten(-2, 0)));
    }
    if (random.chance(.1)) {
        set(run, "start_area", node_of(std::string("bounding_sphere")));
    }
    if (random.chance(.1)) {
        set(run, "direct_light", node_of(std::string("excluded")));
    }
    if (random.chance(.1)) {
        Node depth;
        depth.value = static_cast<std::int64_t>(1 + random.below(5));
        set(run, "max_depth", std::move(depth));
    }
    set(draft.document, "run", std::move(run));
}

}  // namespace

std::vector<double> Draft::spectrum(double low, double high) {
    std::vector<double> values(bands);
    for (double& value : values) {
        value = random.between(low, high);
    }
    return values;
}

Node random_run(std::uint64_t number) {
    Draft draft{.random = Random(number)};
    Random& random = draft.random;
    draft.bands = random.chance(.1) ? 1 + random.below(8) : 1 + random.below(3);
    if (number >= kFirstOfGaps) {
        draft.bands = 1;
    }
    draft.scale = random.chance(.5) ? 1 : random.power_of_ten(-6, 6);
    if (random.chance(.15)) {
        draft.origin = draft.scale * random.power_of_ten(0, 5) * random.direction();
    }
    set(draft.document, "title", node_of(fmt::format("stress {}", number)));
    std::vector<std::string> names;
    for (std::size_t b = 0; b < draft.bands; ++b) {
        names.push_back(fmt::format("b{}", b));
    }
    set(draft.document, "bands", node_of(names));
    if (number >= kFirstOfGaps) {
        return random_gap_run(std::move(draft));
    }
    add_options(draft);
    add_cell(draft);
    if (!draft.is_periodic && random.chance(.05)) {
        set(draft.document, "up", node_of(std::string("y")));
    }
    add_materials(draft);
    add_organs(draft);
    add_ground(draft);
    add_sources(draft);
    return std::move(draft.document);
}

}  // namespace quasimc::stress
