// Daylight coefficients: see docs/develop/decisions/daylight-coefficients.md.

#include "series/basis/daylight_coefficients.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include "base/parallel.h"
#include "light/models/source.h"
#include "run/trace_plan.h"
#include "scene/repeat_bands.h"
#include "scene/scene.h"
#include "series/basis/interpolation_errors.h"
#include "solvers/ray_bundles/bundle_budget.h"
#include "solvers/ray_bundles/patch_light.h"
#include "solvers/ray_bundles/patch_size.h"

namespace quasimc {
namespace {

/// Rings of directions: 184 of them, 10.6 degrees apart.
constexpr std::uint32_t kRings = 9;
/// Number of reference time steps, for the interpolation error.
constexpr std::size_t kReferenceSteps = 12;
/// Memory per thread for lights that are solved together, which limits their number.
constexpr double kBatchBytes = 256e6;
constexpr std::size_t kMaxInBatch = 64;

/// Irradiance of a time step on the horizontal, sum of all bands.
double light_of_time(const TimeStep& step) {
    double sum = 0;
    for (const auto& source : step.sources) {
        const auto spectrum = source->spectrum();
        sum += source->horizontal_irradiance() *
               std::accumulate(spectrum.begin(), spectrum.end(), 0.0);
    }
    return sum;
}

/// Some of the time steps, half of them spread over their light and half over all lit ones: few
/// skies have most of the light, and dim ones differ from them.
std::vector<std::size_t> spread_times(const std::vector<TimeStep>& steps, std::size_t count) {
    std::vector<double> lights;
    double all = 0, lit = 0;
    for (const TimeStep& step : steps) {
        lights.push_back(light_of_time(step));
        all += lights.back();
        lit += lights.back() > 0 ? 1 : 0;
    }
    std::vector<double> until;
    for (const double light : lights) {
        const double share = light > 0 ? light / all + 1 / lit : 0;
        until.push_back((until.empty() ? 0 : until.back()) + share);
    }
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < count && !until.empty() && until.back() > 0; ++i) {
        const double target =
            until.back() * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
        const auto after = std::upper_bound(until.begin(), until.end(), target);
        const auto index =
            std::min(static_cast<std::size_t>(after - until.begin()), until.size() - 1);
        if (chosen.empty() || chosen.back() != index) {
            chosen.push_back(index);
        }
    }
    return chosen;
}

/// [region][side][band]; 0 for sensors.
std::vector<double> albedos_of(const Scene& scene) {
    std::vector<double> albedos;
    for (const Region& region : scene.regions()) {
        const Material& material = data_of(scene).materials[region.material.value];
        for (const SurfaceSide side : kSurfaceSides) {
            for (const double albedo : material.side(side).albedo()) {
                albedos.push_back(material.is_transparent() ? 0 : albedo);
            }
        }
    }
    return albedos;
}

}  // namespace

SunBeam beam_of(const Source& sun) {
    const Illumination light = model_of(sun).illuminate({0, 0, 0}, 0.5, 0.5);
    std::vector<double> facing(sun.spectrum().begin(), sun.spectrum().end());
    for (double& x : facing) {
        x *= light.weight;
    }
    return {light.to_light, std::move(facing)};
}

Sources shining(const Sources& sources, Shining which) {
    Sources found;
    std::copy_if(
        sources.begin(), sources.end(), std::back_inserter(found), [&](const auto& source) {
            const auto spectrum = source->spectrum();
            return source->is_sun() == (which == Shining::suns) &&
                   std::any_of(spectrum.begin(), spectrum.end(), [](double x) { return x > 0; });
        });
    return found;
}

/// A time step that is solved directly, and its result: one of its skies, and the light of its suns
/// at the middle position.
struct DaylightCoefficients::ReferenceStep {
    std::shared_ptr<const Source> sky;
    std::optional<SunBeam> sun;
    LightResponse of_sky, of_sun;
};

/// Solves for lights of irradiance 1 in batches.
class DaylightCoefficients::Solving {
  public:
    Solving(
        DaylightCoefficients& basis, Simulator& simulator, const Scene& scene, const RunSpec& spec)
        : basis_(basis),
          simulator_(simulator),
          scene_(scene),
          spec_(planned_spec(spec, {.organs_alone = true})) {}

    /// A sky of irradiance 1 on the horizontal.
    void add_sky(SkyShape shape, LightResponse& to) {
        lights_.push_back({.shape = std::move(shape), .to_light = {}, .to = &to});
    }
    /// A beam of irradiance 1 on the plane that faces it.
    void add_beam(const Vec3& to_light, LightResponse& to) {
        lights_.push_back({.shape = {}, .to_light = to_light, .to = &to});
    }

    void solve(const RunControl& control) {
        basis_.lights_ = lights_.size();
        const std::size_t most = batch();
        for (std::size_t first = 0; first < lights_.size(); first += most) {
            const std::size_t count = std::min(most, lights_.size() - first);
            solve_batch(first, count, control);
        }
    }

  private:
    struct Light {
        SkyShape shape;  // for skies
        std::optional<Vec3> to_light;
        LightResponse* to;
    };

    [[nodiscard]] std::size_t batch() const {
        const double patches = patch_size(scene_, patches_for(spec_.paths)).count;
        const double each = bytes_of_patch_light(patches, scene_.bands().size());
        const auto fit = static_cast<std::size_t>(kBatchBytes / each);
        return std::clamp<std::size_t>(fit, 1, kMaxInBatch);
    }

    /// @param batch_index  index in a batch of `count`
    [[nodiscard]] std::shared_ptr<const Source> source(
        const Light& light, std::size_t batch_index, std::size_t count) const {
        const std::size_t bands = scene_.bands().size();
        std::vector<double> spectrum(bands * count);
        for (std::size_t b = 0; b < bands; ++b) {
            spectrum[repeated_band(b, batch_index, count)] = 1;
        }
        return light.to_light
                   ? make_directional_source("beam", -1 * *light.to_light, std::move(spectrum))
                   : make_sky("sky", light.shape, std::move(spectrum));
    }

    void solve_batch(std::size_t first, std::size_t count, const RunControl& control) {
        Sources sources;
        for (std::size_t i = 0; i < count; ++i) {
            sources.push_back(source(lights_[first + i], i, count));
        }
        const auto all = static_cast<double>(lights_.size());
        const RunControl own{
            .stop = control.stop,
            .work = control.work.part(
                static_cast<double>(first) / all, static_cast<double>(count) / all)};
        const Scene repeated = with_repeated_bands(scene_, count);
        const Sums sums = simulator_.sums(repeated, sources, spec_, 0, {}, own);
        basis_.rays_ += sums.rays();
        for (std::size_t i = 0; i < count; ++i) {
            *lights_[first + i].to = read_response(sums, i, basis_.layout_);
        }
    }

    DaylightCoefficients& basis_;
    Simulator& simulator_;
    const Scene& scene_;
    const RunSpec spec_;
    std::vector<Light> lights_;
};

std::uint32_t season_directions() {
    return SkyBasis(kRings).nodes();
}

DaylightCoefficients::DaylightCoefficients(
    Simulator& simulator,
    const Scene& scene,
    const std::vector<TimeStep>& time_steps,
    const RunSpec& spec,
    const RunControl& control)
    : mesh_(kRings),
      layout_(scene.regions().size(), scene.bands().size()),
      replicates_(spec.replicates),
      threads_(thread_count(spec.threads)),
      albedos_(albedos_of(scene)),
      responses_(mesh_.nodes()),
      errors_(layout_.bins()),
      reference_steps_(spread_times(time_steps, kReferenceSteps)) {
    Solving solving(*this, simulator, scene, spec);
    const std::vector<bool> is_needed = needed_nodes(time_steps);
    for (std::uint32_t node = 0; node < mesh_.nodes(); ++node) {
        if (is_needed[node]) {
            solving.add_sky(mesh_.basis_function(node), responses_[node]);
        }
    }
    std::vector<ReferenceStep> reference_steps;
    for (const std::size_t i : reference_steps_) {
        reference_steps.push_back(prepare_reference(time_steps[i]));
    }
    for (ReferenceStep& left : reference_steps) {
        if (left.sky) {
            solving.add_sky(
                {[sky = left.sky](const Vec3& d) { return model_of(*sky).radiance(d); }, {}, {}},
                left.of_sky);
        }
        if (left.sun) {
            solving.add_beam(left.sun->to_light, left.of_sun);
        }
    }
    solving.solve(control);
    for (const LightResponse& response : responses_) {
        scattered_first_.push_back(scattered_first(response));
    }
    set_errors(reference_steps);
}

std::vector<bool> DaylightCoefficients::needed_nodes(
    const std::vector<TimeStep>& time_steps) const {
    std::vector<bool> is_needed(mesh_.nodes());
    for (const TimeStep& step : time_steps) {
        if (!shining(step.sources, Shining::skies).empty()) {
            is_needed.assign(mesh_.nodes(), true);
        }
        for (const auto& sun : shining(step.sources, Shining::suns)) {
            for (const SkyBasis::Share& share : mesh_.shares(beam_of(*sun).to_light)) {
                is_needed[share.node] = is_needed[share.node] || share.weight > 0;
            }
        }
    }
    return is_needed;
}

DaylightCoefficients::ReferenceStep DaylightCoefficients::prepare_reference(
    const TimeStep& step) const {
    ReferenceStep left;
    const Sources skies = shining(step.sources, Shining::skies);
    const Sources suns = shining(step.sources, Shining::suns);
    left.sky = skies.empty() ? nullptr : skies.front();
    if (!suns.empty()) {
        left.sun = {beam_of(*suns[suns.size() / 2]).to_light, std::vector<double>(layout_.bands)};
        for (const auto& sun : suns) {
            const SunBeam beam = beam_of(*sun);
            std::transform(
                beam.facing.begin(), beam.facing.end(), left.sun->facing.begin(),
                left.sun->facing.begin(), std::plus<>());
        }
    }
    return left;
}

DaylightCoefficients::Amounts DaylightCoefficients::no_light() const {
    return Amounts(std::size_t{2} * layout_.bands * mesh_.nodes());
}

std::vector<double> DaylightCoefficients::scattered_first(const LightResponse& direct) const {
    const BinIndex bin_index(layout_);
    const std::size_t bands = layout_.bands;
    std::vector<double> sums(bands);
    for (std::size_t i = 0; i < albedos_.size(); ++i) {
        const std::size_t region = i / (2 * bands);
        const SurfaceSide side = kSurfaceSides[i / bands % 2];
        const std::size_t at = bin_index.of(layout_.light.direct(region, side, i % bands));
        for (const std::vector<float>& bins : direct.bins) {
            sums[i % bands] += albedos_[i] * static_cast<double>(bins[at]) /
                               static_cast<double>(direct.bins.size());
        }
    }
    return sums;
}

void DaylightCoefficients::add_suns(
    const std::vector<SunBeam>& suns, std::span<const double> first, Amounts& amounts) const {
    const std::size_t bands = layout_.bands;
    Amounts own = no_light();
    std::vector<double> together(bands);
    for (const SunBeam& sun : suns) {
        for (const SkyBasis::Share& share : mesh_.light_of_beam(sun.to_light)) {
            for (std::size_t b = 0; b < bands; ++b) {
                const double amount = share.weight * sun.facing[b];
                own[(2 * share.node + 1) * bands + b] += amount;
                together[b] += amount > 0 ? amount * scattered_first_[share.node][b] : 0;
            }
        }
    }
    for (std::size_t i = 0; i < own.size(); ++i) {
        const std::size_t b = i % bands;
        const bool is_known = !first.empty() && together[b] > 0;
        amounts[i] += own[i] * (is_known ? first[b] / together[b] : 1);
    }
}

void DaylightCoefficients::add_sky(const Source& sky, Amounts& amounts) const {
    const std::vector<double> light = mesh_.light_of_sky(sky);
    for (std::size_t node = 0; node < light.size(); ++node) {
        for (std::size_t b = 0; b < layout_.bands; ++b) {
            const double amount = light[node] * sky.spectrum()[b];
            amounts[2 * node * layout_.bands + b] += amount;
            amounts[(2 * node + 1) * layout_.bands + b] += amount;
        }
    }
}

DaylightCoefficients::Amounts DaylightCoefficients::amounts_of(
    const Sources& sources, const LightResponse* suns) const {
    Amounts amounts = no_light();
    std::vector<SunBeam> beams;
    for (const auto& sun : shining(sources, Shining::suns)) {
        beams.push_back(beam_of(*sun));
    }
    add_suns(beams, suns != nullptr ? scattered_first(*suns) : std::vector<double>(), amounts);
    for (const auto& sky : shining(sources, Shining::skies)) {
        add_sky(*sky, amounts);
    }
    return amounts;
}

LightSum DaylightCoefficients::light_of(const Amounts& amounts) const {
    std::vector<LightSum> light;
    find_light(std::span(&amounts, 1), light);
    return std::move(light.front());
}

void DaylightCoefficients::find_light(
    std::span<const Amounts> amounts, std::vector<LightSum>& light) const {
    if (light.size() < amounts.size()) {
        light.resize(amounts.size(), LightSum(layout_, replicates_));
    }
    LightSum::combine(responses_, amounts, std::span(light).first(amounts.size()), threads_);
}

void DaylightCoefficients::set_errors(const std::vector<ReferenceStep>& reference_steps) {
    InterpolationErrors errors(layout_);
    for (const ReferenceStep& left : reference_steps) {
        Amounts amounts = no_light();
        LightSum as_it_is(layout_, replicates_);
        std::vector<double> own(2 * layout_.bands);
        if (left.sky) {
            add_sky(*left.sky, amounts);
            for (std::size_t i = 0; i < own.size(); ++i) {
                own[i] =
                    left.sky->horizontal_irradiance() * left.sky->spectrum()[i % layout_.bands];
            }
            as_it_is.add(left.of_sky, own);
        }
        if (left.sun) {
            std::vector<double> first = scattered_first(left.of_sun);
            for (std::size_t b = 0; b < first.size(); ++b) {
                first[b] *= left.sun->facing[b];
            }
            add_suns({*left.sun}, first, amounts);
            const auto scattered = own.begin() + static_cast<std::ptrdiff_t>(layout_.bands);
            std::fill(own.begin(), scattered, 0);
            std::copy(left.sun->facing.begin(), left.sun->facing.end(), scattered);
            as_it_is.add(left.of_sun, own);
        }
        errors.add(light_of(amounts), as_it_is);
    }
    errors_ = errors.relative();
}

}  // namespace quasimc
