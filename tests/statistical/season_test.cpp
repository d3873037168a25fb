// Hours of a day with daylight coefficients, against independent hours.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "light/daylight/hour_light.h"
#include "quasimc/series.h"
#include "statistical/scenes.h"
#include "support/listening.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

constexpr std::uint32_t kLeaves = 16;
constexpr std::size_t kBands = 2;

/// Leaves over a ground, dark in one band and bright in the other.
Scene leaves_in_two_bands() {
    SceneBuilder builder = make_builder(kBands);
    SideOptics dark{.reflectance = .1, .transmittance = .1};
    SideOptics bright{.reflectance = .45, .transmittance = .4};
    builder.add_material({"leaf", {dark, bright}, {dark, bright}});
    builder.add_material(diffuse("soil", .2, 0, kBands));
    add_leaves(builder, random_leaves(kLeaves, .3, 1, 5));
    GroundSpec floor = ground("soil");
    floor.height = -.4;
    builder.set_ground(floor);
    return std::move(builder).build();
}

/// Hours of a clear day and of an overcast one, 52 degrees north.
std::vector<TimeStep> hours_of_two_days() {
    const Site site{.latitude_deg = 51.97, .longitude_deg = 5.67};
    DaylightSources how;
    how.bands = {{400, 700}, {700, 1100}};
    std::vector<TimeStep> hours;
    for (const int hour : {6, 9, 12, 16}) {
        const SunPath path = sun_path(site, {2024, 6, 21, hour, 0, 0, 1}, 3600, 1200);
        HourSources sources = make_hour_sources(make_hour_parts(path, clear_light(path, {}), how));
        hours.push_back({"hour", std::move(sources.sources), sources.directional_key, 3600, 0});
    }
    for (const int hour : {8, 13}) {
        const SunPath path = sun_path(site, {2024, 9, 30, hour, 0, 0, 1}, 3600, 1200);
        const HourLight light = measured_light(
            path, {.global = 150 + 10 * hour, .diffuse = 150}, LightUnit::full_spectrum,
            DiffuseModel::erbs, how.spectra);
        HourSources sources = make_hour_sources(make_hour_parts(path, light, how));
        hours.push_back({"hour", std::move(sources.sources), sources.directional_key, 3600, 1});
    }
    return hours;
}

struct TwoDays {
    std::vector<Result> hours;
    std::vector<SeriesSum> days;
};

TwoDays compute_days(const Scene& scene, const RunSpec& spec) {
    TwoDays found;
    Listening events;
    events.time_step = [&](std::size_t, const Result& result, std::size_t) {
        found.hours.push_back(result);
    };
    events.day = [&](std::size_t, const SeriesSum& sum) { found.days.push_back(sum); };
    run_series(scene, hours_of_two_days(), spec, {.listeners = {&events}});
    return found;
}

RunSpec spec_together(std::uint64_t paths) {
    RunSpec spec = spec_of(Method::ray_bundles, paths);
    spec.time_method = TimeMethod::daylight_coefficients;
    return spec;
}

/// The compared light on sides: of an organ, or of the ground. Resolved where it is bright.
constexpr std::array kCompared{
    Quantity::absorbed_flux, Quantity::incident_upper, Quantity::incident_lower,
    Quantity::incident_direct, Quantity::incident_scattered};

/// Compares numbers of two independent computations, all at the level of one test.
class Agreement {
  public:
    explicit Agreement(std::size_t numbers)
        : level_(sidak_level(kLevel, static_cast<unsigned>(numbers))) {}

    /// Compares the light on all organs.
    template <typename Light>
    void compare(const Scene& scene, const Light& own, const Light& reference) {
        const auto organs = static_cast<double>(scene.organs().size());
        for (const Quantity q : kCompared) {
            for (std::size_t b = 0; b < kBands; ++b) {
                double mean = 0;
                for (std::size_t o = 0; o < scene.organs().size(); ++o) {
                    mean += reference.at(o, q, b).mean / organs;
                }
                for (std::size_t o = 0; o < scene.organs().size(); ++o) {
                    SCOPED_TRACE(o);
                    compare(own.at(o, q, b), reference.at(o, q, b), mean);
                }
            }
        }
    }

    /// Nine in ten comparisons can detect a deviation of one half; nearly all 95 % intervals
    /// contain the truth; and light that is half as much more is detected.
    void expect_sharp() const {
        EXPECT_GT(sharp_, .9 * compared_);
        EXPECT_GT(held_, .93 * compared_);
        EXPECT_GT(found_out_, .5 * compared_) << "a control";
    }

  private:
    void compare(const Estimate& own, const Estimate& reference, double mean) {
        constexpr double kAny = std::numeric_limits<double>::infinity();
        if (std::isnan(own.standard_error) || std::isnan(reference.standard_error)) {
            EXPECT_EQ(own.mean, 0) << "the ground's lower side";
            EXPECT_EQ(reference.mean, 0);
            return;
        }
        const Measured a = measured(own, kReplicates);
        const Measured r = measured(reference, kReplicates);
        const double most = .5 * std::max(mean, r.mean);
        EXPECT_TRUE(agrees(a, r, kAny, level_));
        sharp_ += agrees(a, {a.mean, r.standard_error, kReplicates}, most, level_) ? 1 : 0;
        held_ += own.ci95_low <= reference.ci95_high && own.ci95_high >= reference.ci95_low ? 1 : 0;
        found_out_ +=
            agrees({1.5 * a.mean, a.standard_error, kReplicates}, r, kAny, level_) ? 0 : 1;
        ++compared_;
    }

    double level_;
    double compared_ = 0, sharp_ = 0, held_ = 0, found_out_ = 0;
};

TEST(SeasonAgainstHours, AgreesInEveryHourAndDay) {
    const Scene scene = leaves_in_two_bands();
    const TwoDays together = compute_days(scene, spec_together(1 << 11));
    const TwoDays alone = compute_days(scene, spec_of(Method::first_hits, 1 << 14));
    ASSERT_EQ(together.hours.size(), alone.hours.size());
    ASSERT_EQ(together.days.size(), alone.days.size());
    Agreement agreement(
        (together.hours.size() + together.days.size()) * kCompared.size() * kBands *
        scene.organs().size());
    for (std::size_t i = 0; i < together.hours.size(); ++i) {
        SCOPED_TRACE(i);
        agreement.compare(scene, together.hours[i], alone.hours[i]);
    }
    for (std::size_t i = 0; i < together.days.size(); ++i) {
        SCOPED_TRACE(i);
        agreement.compare(scene, together.days[i], alone.days[i]);
    }
    agreement.expect_sharp();
}

}  // namespace
}  // namespace quasimc::test
