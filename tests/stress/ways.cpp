#include "stress/ways.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "planner/lint_bundles.h"
#include "runfile/run_file.h"
#include "solvers/ray_bundles/ray_bundles.h"
#include "sums/statistics.h"
#include "transport/prepared_scene.h"

namespace quasimc::stress {
namespace {

Number number_of(const Estimate& e) {
    return {e.mean, e.standard_error, e.ci95_low, e.ci95_high, !std::isnan(e.mean)};
}

std::vector<Number> numbers_of(const Result& result) {
    std::vector<Number> numbers;
    for (std::size_t organ = 0; organ < result.organs(); ++organ) {
        for (const Quantity q : kComparedQuantities) {
            for (std::size_t b = 0; b < result.bands; ++b) {
                numbers.push_back(number_of(result.at(organ, q, b)));
            }
        }
        numbers.push_back(
            result.sunlit_fraction.empty() ? Number{} : number_of(result.sunlit_fraction[organ]));
    }
    for (const BandBudget& budget : result.budget) {
        numbers.push_back(number_of(budget.absorbed_by_organs));
        numbers.push_back(number_of(budget.absorbed_by_ground));
    }
    return numbers;
}

/// Whether a sun grazes a surface of the organ, less than half a degree from its plane. Its flux is
/// then small, and the sunlit fraction depends on a few contributions with large weights. A sun
/// exactly in the plane, without a disk, illuminates nothing in every way.
bool is_grazed(const Case& it, const Organ& organ) {
    constexpr double kGrazing = .01;
    for (const Node* source : tables_at(*it.run.document, "source")) {
        if (source->find("irradiance_facing") == nullptr) {
            continue;
        }
        const Vec3 to_sun = it.run.scene.orientation().towards(
            number_at(*source, "azimuth_deg", 0), number_at(*source, "elevation_deg", 0));
        const double least = source->find("disk") != nullptr ? -1 : .5 * kEdgeOn;
        for (const Triangle& t : it.run.scene.triangles_of(organ)) {
            const Vec3 n = area_vector(t);
            const double along = std::abs(dot(n, to_sun));
            if (along > least * length(n) && along <= kGrazing * length(n)) {
                return true;
            }
        }
    }
    return false;
}

/// Removes the sunlit fraction of such organs.
void forget_grazed(const Case& it, std::vector<Number>& numbers) {
    const std::size_t each = kComparedQuantities.size() * it.run.scene.bands().size() + 1;
    for (std::size_t i = 0; i < it.run.scene.organs().size(); ++i) {
        if (is_grazed(it, it.run.scene.organs()[i])) {
            numbers[(i + 1) * each - 1].is_known = false;
        }
    }
}

/// The numbers of one replicate of the reference; NaN where it has none.
std::vector<double> plain_numbers(const PlainSums& sums, const Scene& scene, bool ignores_direct) {
    const std::size_t bands = scene.bands().size();
    std::vector<double> numbers;
    // Light that is not counted on organs is part of the totals.
    std::vector<double> totals(2 * bands, ignores_direct ? std::nan("") : 0);
    for (std::size_t organ = 0; organ < scene.organs().size(); ++organ) {
        const double area = scene.organs()[organ].area;
        const auto side = [&](const std::vector<double>& of, std::size_t s, std::size_t b) {
            return of[(organ * 2 + s) * bands + b];
        };
        for (std::size_t b = 0; b < bands; ++b) {
            const double absorbed = sums.absorbed[organ * bands + b];
            numbers.push_back(absorbed);
            totals[2 * b + (scene.organs()[organ].is_ground ? 1 : 0)] += absorbed;
        }
        for (std::size_t s = 0; s < 2; ++s) {
            for (std::size_t b = 0; b < bands; ++b) {
                numbers.push_back((side(sums.direct, s, b) + side(sums.scattered, s, b)) / area);
            }
        }
        for (const auto* of : {&sums.direct, &sums.scattered}) {
            for (std::size_t b = 0; b < bands; ++b) {
                numbers.push_back((side(*of, 0, b) + side(*of, 1, b)) / area);
            }
        }
        numbers.push_back(std::nan(""));
    }
    numbers.insert(numbers.end(), totals.begin(), totals.end());
    return numbers;
}

/// The contribution of the brightest path to each of the numbers.
std::vector<double> numbers_of_path(const std::vector<double>& path, const Scene& scene) {
    std::vector<double> numbers;
    for (const Organ& organ : scene.organs()) {
        for (std::size_t q = 0; q < kComparedQuantities.size(); ++q) {
            for (const double flux : path) {
                numbers.push_back(q == 0 ? flux : flux / organ.area);
            }
        }
        numbers.push_back(std::nan(""));
    }
    for (const double flux : path) {
        numbers.insert(numbers.end(), 2, flux);
    }
    return numbers;
}

Answer reference_answer(const Case& it, const Effort& effort) {
    // Number of brightest paths below whose flux a number is unknown: it may include the light of a
    // near lamp and none of the sun's.
    constexpr double kFewPaths = 10;
    std::vector<std::vector<double>> replicates;
    std::vector<double> of_path;
    for (std::uint32_t r = 0; r < effort.replicates; ++r) {
        const std::uint64_t seed = mix64(effort.seed * 0x9e3779b97f4a7c15U + r);
        const PlainSums sums = trace_plainly(*it.plain, effort.paths, seed);
        replicates.push_back(plain_numbers(sums, it.run.scene, it.plain->ignores_direct));
        of_path = numbers_of_path(sums.brightest_path, it.run.scene);
    }
    Answer answer{Way::reference, effort.replicates - 1.0, {}, std::nullopt};
    for (std::size_t i = 0; i < replicates[0].size(); ++i) {
        std::vector<double> values;
        for (const auto& replicate : replicates) {
            values.push_back(replicate[i]);
        }
        Number number = number_of(estimate_mean(values));
        // Low counts give no bound here; the program's ways are compared with each other.
        number.is_known =
            number.is_known && number.mean > 0 &&
            !(number.mean < kFewPaths * of_path[i] / static_cast<double>(effort.replicates));
        answer.numbers.push_back(number);
    }
    return answer;
}

Method method_of(Way way) {
    switch (way) {
        case Way::first_hits:
            return Method::first_hits;
        case Way::from_organs:
            return Method::from_organs;
        case Way::ray_bundles:
            return Method::ray_bundles;
        case Way::automatic:
            return Method::automatic;
        default:
            return Method::light_tracing;
    }
}

bool has_lamps(const Node& document) {
    for (const Node* source : tables_at(document, "source")) {
        if (source->find("power") != nullptr) {
            return true;
        }
    }
    return false;
}

/// Whether light can be exchanged along bundles, which refuse surfaces that are not diffuse.
bool is_diffuse(const Scene& scene) {
    Faults faults;
    check_diffuse(scene, faults);
    return faults.empty();
}

/// Whether a run with bundles is warned that its standard errors do not include all errors.
bool is_warned_of(const RunFile& run) {
    RunSpec spec = run.spec;
    spec.method = Method::ray_bundles;
    spec.paths = kClosePaths;
    return !lint_bundles(run.scene, run.sources, spec).empty();
}

}  // namespace

Case make_case(const Node& document) {
    InputFiles files(".");
    RunFile run = read_run_document(document, "run.toml", files);
    std::optional<PlainScene> plain = plain_scene(document, run.scene);
    std::vector<double> slips = slips_of(document, run.scene);
    std::vector<double> roundings = roundings_of(run.scene);
    return {std::move(run), std::move(plain), std::move(slips), std::move(roundings)};
}

std::string name_of(Way way) {
    constexpr std::array names{"light_tracing", "first_hits",  "from_organs", "ray_bundles",
                               "auto",          "plain_paths", "reference"};
    return names[static_cast<std::size_t>(way)];
}

std::vector<std::string> number_names(const Scene& scene) {
    std::vector<std::string> names;
    for (std::size_t organ = 0; organ < scene.organs().size(); ++organ) {
        for (const Quantity q : kComparedQuantities) {
            for (const Band& band : scene.bands()) {
                names.push_back(fmt::format(
                    "organ {} {} {}", organ, quantity_table()[static_cast<std::size_t>(q)].name,
                    band.name));
            }
        }
        names.push_back(fmt::format("organ {} sunlit_fraction", organ));
    }
    for (const Band& band : scene.bands()) {
        names.push_back("absorbed_by_organs " + band.name);
        names.push_back("absorbed_by_ground " + band.name);
    }
    return names;
}

bool is_offered(const Case& it, Way way) {
    switch (way) {
        case Way::from_organs:
            return !(it.run.scene.cell().periodic() && has_lamps(*it.run.document));
        case Way::ray_bundles:
            return is_diffuse(it.run.scene) && !is_warned_of(it.run);
        case Way::reference:
            return it.plain.has_value();
        default:
            return true;
    }
}

Answer compute(const Case& it, Way way, const Effort& effort) {
    if (way == Way::reference) {
        return reference_answer(it, effort);
    }
    RunSpec spec = it.run.spec;
    spec.method = method_of(way);
    spec.paths = effort.paths;
    spec.replicates = effort.replicates;
    spec.seed = effort.seed;
    spec.threads = effort.threads;
    spec.target_error = 0;
    if (way == Way::plain_paths) {
        spec.sampler = "monte_carlo";
        spec.accelerator = Accelerator::brute_force;
        spec.start_area = StartArea::bounding_sphere;
    }
    Result result = run(it.run.scene, it.run.sources, spec);
    std::vector<Number> numbers = numbers_of(result);
    forget_grazed(it, numbers);
    return {way, effort.replicates - 1.0, std::move(numbers), std::move(result)};
}

std::vector<Way> ways_of(const Case& it) {
    std::vector<Way> ways;
    for (const Way way :
         {Way::light_tracing, Way::first_hits, Way::from_organs, Way::ray_bundles}) {
        if (is_offered(it, way)) {
            ways.push_back(way);
        }
    }
    ways.push_back(it.plain ? Way::reference : Way::plain_paths);
    return ways;
}

}  // namespace quasimc::stress
