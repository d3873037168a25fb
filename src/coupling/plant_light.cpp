#include "coupling/plant_light.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "coupling/bounded_run.h"
#include "coupling/step_files.h"
#include "run/trace_plan.h"
#include "scene/lint.h"
#include "solvers/run_limits.h"

namespace quasimc {
namespace {

/// Steps take consecutive seeds; bands that are traced separately are this far apart.
constexpr std::uint64_t kBetweenBands = std::uint64_t{1} << 40U;
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Whether a module is a setting instead of an organ.
bool is_setting(const Query& query) {
    return query.organ == "Q" || query.organ == "J";
}

/// Calls a check repeatedly during a run; an exception of it ends the run.
class Checking final : public RunListener {
  public:
    explicit Checking(const std::function<void()>& check) : check_(check) {}
    void on_progress(const Progress& /*progress*/) override { check_(); }

  private:
    const std::function<void()>& check_;
};

}  // namespace

PlantLight::PlantLight(Specification spec, Notices& notices)
    : spec_(std::move(spec)),
      notices_(notices),
      shapes_(spec_, notices),
      sky_(spec_.sky),
      lighting_(make_lighting(spec_, sky_)) {}

bool PlantLight::is_dark() const {
    const auto is_zero = [](double x) { return !(x > 0); };
    return lighting_.shares.empty() ||
           std::all_of(spec_.irradiance.begin(), spec_.irradiance.end(), is_zero);
}

void PlantLight::answer(const Pass& pass, const std::function<void()>& check, Answers& answers) {
    apply_settings(pass);
    const std::vector<PlacedShape> shapes = position_shapes(pass);
    if (is_dark()) {
        notices_.once("dark", "no light: the sun is below the horizon, or every irradiance is 0");
    } else if (anything_is_measured(pass, shapes)) {
        unshaded_ = trace_unshaded(pass, shapes, check);
        light_ = std::make_shared<StepLight>(trace(pass, shapes, simulator_, check));
        report_warnings();
    }
    for (std::uint32_t i = 0; i < pass.queries.size(); ++i) {
        const Query& query = pass.queries[i];
        if (spec_.is_answered(query.asks) && !is_setting(query)) {
            const auto first = static_cast<std::uint32_t>(answers.values.size());
            fill(query, i, answers.values);
            const auto end = static_cast<std::uint32_t>(answers.values.size());
            answers.list.push_back({i, {first, end - first}});
        }
    }
    write_files(pass);
}

void PlantLight::report_warnings() {
    if (!light_->scene) {
        return;
    }
    for (const LintFinding& finding : lint_by_check(*light_->scene)) {
        const std::string check = fmt::format("lint {}", finding.check);
        // A specification has no unit of length, and defines each of its materials.
        const bool is_expected = finding.check == "unit" || finding.check == "materials";
        if (is_expected || notices_.was_sent(check)) {
            continue;
        }
        for (std::size_t i = 0; i < finding.warnings.size(); ++i) {
            const Warning& warning = finding.warnings[i];
            notices_.once(
                i == 0 ? check : fmt::format("{} {}", check, i),
                fmt::format("{}: {}", warning.where, warning.text));
        }
    }
}

void PlantLight::report_if_unlit() {
    for (const Result& result : light_->results) {
        if (result.stop == StopReason::no_light) {
            notices_.once(
                "unlit",
                "no light reaches the plant: all surfaces are parallel to the light or have no "
                "area; its organs receive 0");
        }
    }
}

bool PlantLight::anything_is_measured(const Pass& pass, std::span<const PlacedShape> shapes) const {
    return std::any_of(shapes.begin(), shapes.end(), [&](const PlacedShape& shape) {
        const bool is_answered = spec_.is_answered(pass.queries[shape.query].asks);
        return spec_.sensor_half_angle_deg ? shape.is_sensor
                                           : is_answered || spec_.picture_file.has_value();
    });
}

void PlantLight::apply_settings(const Pass& pass) {
    for (const Query& query : pass.queries) {
        if (query.organ == "J") {
            set_day(pass.parameters_of(query));
        } else if (query.organ == "Q") {
            set_rays(pass.parameters_of(query));
        }
    }
}

void PlantLight::set_day(std::span<const double> parameters) {
    constexpr double kLastDay = 366;
    const bool has_weather = parameters.size() >= 3;
    const bool is_good =
        !parameters.empty() && parameters[0] >= 1 && parameters[0] <= kLastDay &&
        (!has_weather || (parameters[2] >= kTurbidities.low && parameters[2] <= kTurbidities.high));
    if (!sky_ || !is_good) {
        notices_.once(
            sky_ ? "J range" : "J without a sky",
            sky_ ? fmt::format(
                       "J(day, clear, turbidity) is ignored: the day must be 1 to {}, the "
                       "turbidity {} to {}",
                       kLastDay, kTurbidities.low, kTurbidities.high)
                 : "J(day) has no effect: the specification file has no sky for a site and day");
        return;
    }
    SkyOfDay sky = *sky_;
    sky.day = parameters[0];
    if (has_weather) {
        sky.weather = parameters[1] > 0 ? Weather::clear : Weather::overcast;
        sky.turbidity = std::max(parameters[2], kClearestSky);
    }
    if (sky != *sky_) {
        sky_ = sky;
        lighting_ = make_lighting(spec_, sky_);
    }
}

void PlantLight::set_rays(std::span<const double> parameters) {
    const double rays = parameters.empty() ? 0 : parameters[0];
    if (!(rays >= 1 && rays <= static_cast<double>(kMaxPaths))) {
        notices_.once("Q range", "Q(rays) is ignored: it needs a number of rays from 1 to 2^30");
        return;
    }
    const auto count = static_cast<std::uint64_t>(rays);
    spec_.run.paths = spec_.run.sampler == "korobov" ? nearest_power_of_two(count) : count;
}

std::vector<PlacedShape> PlantLight::position_shapes(const Pass& pass) {
    std::vector<PlacedShape> placed;
    placed.reserve(pass.queries.size());
    for (std::uint32_t i = 0; i < pass.queries.size(); ++i) {
        const Query& query = pass.queries[i];
        if (is_setting(query)) {
            continue;
        }
        OrganShape shape =
            is_sensor(query) ? shapes_.make_sensor(pass, query) : shapes_.make(pass, query);
        const bool has_area = std::any_of(
            shape.triangles.begin(), shape.triangles.end(),
            [](const auto& triangle) { return length(area_vector(triangle)) > 0; });
        if (has_area) {
            placed.push_back({i, is_sensor(query), std::move(shape)});
        }
    }
    StepLight dark;
    dark.organs.assign(pass.queries.size(), kNoOrgan);
    unshaded_ = dark;
    light_ = std::make_shared<StepLight>(std::move(dark));
    return placed;
}

StepLight PlantLight::trace(
    const Pass& pass,
    std::span<const PlacedShape> shapes,
    Simulator& simulator,
    const std::function<void()>& check) {
    StepLight light;
    light.organs.assign(pass.queries.size(), kNoOrgan);
    for (std::uint32_t i = 0; i < shapes.size(); ++i) {
        light.organs[shapes[i].query] = i;
    }
    TracePlan plan{.seed = spec_.run.seed + steps_};
    if (spec_.sensor_half_angle_deg) {
        plan.method = Method::from_organs;
        const auto sensors = std::count_if(
            shapes.begin(), shapes.end(), [](const PlacedShape& s) { return s.is_sensor; });
        const std::uint64_t rays = spec_.run.paths * static_cast<std::uint64_t>(sensors);
        // Each sensor has its own points; lattices need a power of two.
        plan.paths =
            std::min(spec_.run.sampler == "korobov" ? std::bit_ceil(rays) : rays, kMaxPaths);
    }
    Checking checking(check);
    std::vector<std::size_t> bands(spec_.band_count());
    std::iota(bands.begin(), bands.end(), std::size_t{0});
    const auto trace_some = [&](std::span<const std::size_t> some) {
        const Sources& sources = lighting_.sources[light.results.size()];
        light.scene.emplace(build_plant_scene(spec_, some, pass, shapes));
        light.results.push_back(run_bounded(
            simulator, *light.scene, sources, planned_spec(spec_.run, plan),
            {.listeners = {&checking}}));
    };
    if (spec_.one_ray_per_spectrum) {
        trace_some(bands);
        return light;
    }
    for (const std::size_t& band : bands) {
        *plan.seed += kBetweenBands;
        if (spec_.irradiance[band] > 0) {
            trace_some({&band, 1});
        } else {
            light.results.emplace_back();
        }
    }
    return light;
}

StepLight PlantLight::trace_unshaded(
    const Pass& pass, const std::vector<PlacedShape>& shapes, const std::function<void()>& check) {
    const bool is_asked = std::find(spec_.returns.begin(), spec_.returns.end(), ReturnType::hits) !=
                          spec_.returns.end();
    std::vector<PlacedShape> sensors;
    std::copy_if(
        shapes.begin(), shapes.end(), std::back_inserter(sensors),
        [](const PlacedShape& shape) { return shape.is_sensor; });
    return is_asked && !sensors.empty() ? trace(pass, sensors, unshaded_simulator_, check)
                                        : unshaded_;
}

void PlantLight::fill(const Query& query, std::uint32_t index, std::vector<double>& values) const {
    const std::size_t before = values.size();
    if (spec_.quantities.empty()) {
        for (std::size_t b = 0; b < spec_.band_count(); ++b) {
            values.push_back(returned(query, index, b).mean);
        }
    }
    for (const ReturnQuantity& wanted : spec_.quantities) {
        const auto put = [&](const Estimate& estimate) {
            values.push_back(wanted.is_error ? estimate.standard_error : estimate.mean);
        };
        if (!wanted.quantity) {
            const Estimate unknown{kUnknown, kUnknown, kUnknown, kUnknown};
            put(light_->sunlit(light_->organs[index]).value_or(unknown));
            continue;
        }
        for (std::size_t b = 0; b < spec_.band_count(); ++b) {
            put(light_->at(light_->organs[index], *wanted.quantity, b));
        }
    }
    const std::size_t count = values.size() - before;
    if (count > query.slots) {
        notices_.once(
            "slots",
            fmt::format(
                "a query has {} parameters for {} values; the remaining values are not sent",
                query.slots, count));
    }
}

Estimate PlantLight::returned(const Query& query, std::uint32_t index, std::size_t band) const {
    const ReturnType type = spec_.returns[band];
    return is_sensor(query) ? of_sensor(index, type, band) : of_organ(index, type, band);
}

Estimate PlantLight::of_sensor(std::uint32_t index, ReturnType type, std::size_t band) const {
    const Quantity side =
        type == ReturnType::lower ? Quantity::incident_lower : Quantity::incident_upper;
    const Estimate seen = light_->at(light_->organs[index], side, band);
    if (type != ReturnType::hits) {
        return seen;
    }
    const Estimate available = unshaded_.at(unshaded_.organs[index], side, band);
    return {available.mean > 0 ? seen.mean / available.mean : 0, kUnknown, kUnknown, kUnknown};
}

Estimate PlantLight::of_organ(std::uint32_t index, ReturnType type, std::size_t band) const {
    const std::uint32_t organ = light_->organs[index];
    switch (type) {
        case ReturnType::flux:
            return light_->at(organ, Quantity::absorbed_flux, band);
        case ReturnType::density:
            return light_->at(organ, Quantity::absorbed_flux_density, band);
        case ReturnType::upper:
            return light_->at(organ, Quantity::incident_upper, band);
        case ReturnType::lower:
            return light_->at(organ, Quantity::incident_lower, band);
        case ReturnType::hits:
            break;
    }
    const double incident = light_->at(organ, Quantity::incident_upper, band).mean +
                            light_->at(organ, Quantity::incident_lower, band).mean;
    const double sent = spec_.irradiance[band];
    return {sent > 0 ? incident / sent : 0, kUnknown, kUnknown, kUnknown};
}

void PlantLight::write_files(const Pass& pass) const {
    const auto returned_by = [&](std::uint32_t index, std::size_t band) {
        return returned(pass.queries[index], index, band);
    };
    const StepView view{spec_, pass, lighting_, *light_, steps_, returned_by};
    if (spec_.variance_file) {
        write_variance_file(view);
    }
    if (spec_.picture_file) {
        write_picture_file(view);
    }
}

}  // namespace quasimc
