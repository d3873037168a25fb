#include "invariance/plot.h"

#include <array>
#include <bit>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

double radians(double degrees) {
    return degrees * std::numbers::pi / 180;
}

Vec3 turned(const Vec3& p, double degrees) {
    const double c = std::cos(radians(degrees));
    const double s = std::sin(radians(degrees));
    return degrees == 0 ? p : Vec3{c * p.x - s * p.y, s * p.x + c * p.y, p.z};
}

std::vector<double> picked(const std::array<double, kPlotBands>& all, const PlotSpec& spec) {
    std::vector<double> values;
    for (const std::size_t b : spec.bands) {
        values.push_back(all[b]);
    }
    return values;
}

bool same_bits(const Estimate& a, const Estimate& b) {
    const auto same = [](double x, double y) {
        return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y) ||
               (std::isnan(x) && std::isnan(y));
    };
    return same(a.mean, b.mean) && same(a.standard_error, b.standard_error) &&
           same(a.ci95_low, b.ci95_low) && same(a.ci95_high, b.ci95_high);
}

::testing::AssertionResult same_bits(
    const char* words, const std::vector<Estimate>& a, const std::vector<Estimate>& b) {
    if (a.size() != b.size()) {
        return ::testing::AssertionFailure() << words << ": " << a.size() << " and " << b.size();
    }
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (!same_bits(a[i], b[i])) {
            return ::testing::AssertionFailure()
                   << words << " " << i << ": " << a[i].mean << " and " << b[i].mean;
        }
    }
    return ::testing::AssertionSuccess();
}

std::vector<Estimate> budget_of(const Result& result) {
    std::vector<Estimate> all;
    for (const BandBudget& b : result.budget) {
        all.push_back(b.emitted);
        all.push_back({b.closure_error, 0, 0, 0});
        all.insert(
            all.end(),
            {b.absorbed_by_organs, b.absorbed_by_ground, b.escaped, b.cut_off, b.imbalance});
    }
    return all;
}

}  // namespace

std::vector<Triangle> plot_leaves() {
    return random_leaves(kPlotLeaves, .4, 1, 5);
}

std::vector<MaterialSpec> plot_materials(const std::vector<std::size_t>& bands) {
    MaterialSpec leaf{"leaf", {}, {}};
    MaterialSpec dull{"matt", {}, {}};
    MaterialSpec soil{"soil", {}, {}};
    for (const std::size_t b : bands) {
        const auto x = static_cast<double>(b);
        leaf.upper.push_back(
            {.reflectance = .1 + .2 * x,
             .transmittance = .3 - .1 * x,
             .reflection_model = b == 2 ? "mirror" : "blinn_phong",
             .reflection_parameters = {{"exponent", 2 + 6 * x}}});
        leaf.lower.push_back({.reflectance = .3, .transmittance = .1 + .2 * x});
        dull.upper.push_back({.reflectance = .4 - .1 * x, .transmittance = .1 + .2 * x});
        dull.lower.push_back({.reflectance = .2 + .1 * x, .transmittance = .3});
        soil.upper.push_back({.reflectance = .1 + .1 * x});
        soil.lower.push_back({});
    }
    return {leaf, dull, soil};
}

Scene make_plot(const PlotSpec& spec) {
    std::vector<Band> bands;
    for (std::size_t i = 0; i < spec.bands.size(); ++i) {
        bands.push_back({fmt::format("b{}", i)});
    }
    const Orientation orientation =
        spec.up == UpAxis::y ? Orientation(UpAxis::y, {1, 0, 0}) : Orientation();
    const auto placed = [&](const Triangle& t) {
        Triangle out;
        for (std::size_t i = 0; i < 3; ++i) {
            out[i] = orientation.outward(
                spec.scale * turned(t[i] - Vec3{.5, .5, 0}, spec.turn_deg) + spec.shift);
        }
        return out;
    };
    SceneBuilder builder(bands, orientation);
    for (const MaterialSpec& material : plot_materials(spec.bands)) {
        builder.add_material(material);
    }
    builder.add_material(sensor("sensor", spec.bands.size()));
    const std::vector<Triangle> leaves = plot_leaves();
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        const char* material = i < 2 ? "sensor" : (i % 2 == 0 ? "leaf" : "matt");
        builder.add_organ(organ("", material, {placed(leaves[i])}));
    }
    GroundSpec soil = ground("soil");
    for (const Triangle& t : floor_of(-.5, 1.5, -.5, 1.5, -.3)) {
        soil.triangles.push_back(placed(t));
    }
    builder.set_ground(soil);
    builder.set_cell(
        {.along_x = spec.periodic,
         .along_y = spec.periodic,
         .low_x = spec.shift.x - spec.scale,
         .low_y = spec.shift.y - spec.scale,
         .size_x = 2 * spec.scale,
         .size_y = 2 * spec.scale});
    return std::move(builder).build();
}

Sources plot_sources(const PlotSpec& spec) {
    return {
        make_directional_source(
            "sun", turned({.3, -.2, -.8}, spec.turn_deg), picked({1, .8, .5}, spec)),
        make_directional_source(
            "second sun", turned({-.7, .1, -.5}, spec.turn_deg), picked({.2, .4, .6}, spec)),
        sky(picked({.3, .5, .7}, spec))};
}

::testing::AssertionResult have_the_same_bits(const Result& a, const Result& b) {
    if (a.paths != b.paths || a.rays != b.rays || a.stop != b.stop) {
        return ::testing::AssertionFailure() << "paths " << a.paths << " and " << b.paths
                                             << ", rays " << a.rays << " and " << b.rays;
    }
    for (const auto& result :
         {same_bits("value", a.values, b.values),
          same_bits("sunlit fraction", a.sunlit_fraction, b.sunlit_fraction),
          same_bits("ratio", a.ratio_values, b.ratio_values),
          same_bits("budget", budget_of(a), budget_of(b))}) {
        if (!result) {
            return result;
        }
    }
    return ::testing::AssertionSuccess();
}

::testing::AssertionResult are_nearly_identical(
    const Result& a, const Result& b, double relative, const std::vector<Quantity>& compared) {
    double differences = 0;
    double amounts = 0;
    for (std::size_t organ = 0; organ < a.organs(); ++organ) {
        for (const Quantity q : compared) {
            for (std::size_t band = 0; band < a.bands; ++band) {
                differences += std::abs(a.at(organ, q, band).mean - b.at(organ, q, band).mean);
                amounts += a.at(organ, q, band).mean;
            }
        }
    }
    return (differences <= relative * amounts ? ::testing::AssertionSuccess()
                                              : ::testing::AssertionFailure())
           << "differences sum up to " << differences / amounts << " of the amounts";
}

Result with_bands(const Result& result, const std::vector<std::size_t>& bands) {
    Result out = result;
    out.bands = bands.size();
    out.values.clear();
    out.budget.clear();
    for (std::size_t i = 0; i < result.organs() * kQuantities; ++i) {
        for (const std::size_t b : bands) {
            out.values.push_back(result.values[i * result.bands + b]);
        }
    }
    for (const std::size_t b : bands) {
        out.budget.push_back(result.budget[b]);
    }
    return out;
}

}  // namespace quasimc::test
