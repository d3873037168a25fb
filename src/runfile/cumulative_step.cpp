#include "runfile/cumulative_step.h"

#include <utility>

#include <fmt/format.h>

#include "base/checks.h"

namespace quasimc {

void CumulativeStep::add(
    const HourParts& parts,
    const Daylight& daylight,
    double seconds,
    const std::string& begin,
    const std::string& end) {
    EXPECT(seconds > 0);
    begin_ = empty() ? begin : begin_;
    end_ = end;
    ++times_;
    with_light_ += daylight.global() > 0 ? 1 : 0;
    seconds_ += seconds;
    daylight_.direct += seconds * daylight.direct;
    daylight_.diffuse += seconds * daylight.diffuse;
    for (const HourParts::Sun& sun : parts.suns) {
        std::vector<double> facing = sun.facing;
        for (double& value : facing) {
            value *= seconds;
        }
        light_.add_sun(sun.to_sun, facing);
    }
    if (parts.sky) {
        SameSky& sky =
            skies_.try_emplace(parts.sky_text, SameSky{*parts.sky, std::vector<double>(bands_)})
                .first->second;
        for (std::size_t b = 0; b < bands_; ++b) {
            sky.horizontal[b] += seconds * parts.sky_horizontal[b];
        }
    }
}

CumulativeStep::Made CumulativeStep::make(const Sources& lamps, std::size_t day) const {
    EXPECT(!empty());
    PeriodLight light = light_;
    for (const auto& [text, sky] : skies_) {
        light.add_sky(sky.shape, sky.horizontal);
    }
    Sources daylight = light.sources("sky", 1 / seconds_);
    Made made;
    made.notes.time = begin_;
    made.notes.seconds = seconds_;
    made.notes.daylight = {daylight_.direct / seconds_, daylight_.diffuse / seconds_};
    made.notes.suns = light.suns();
    made.notes.cumulated = {end_, times_, with_light_, daylight.size() - light.suns()};
    made.time_step.name = begin_ + " to " + end_;
    made.time_step.sources = lamps;
    if (!daylight.empty()) {
        made.time_step.directional_key = "cumulative " + made.time_step.name;
        std::move(daylight.begin(), daylight.end(), std::back_inserter(made.time_step.sources));
    }
    made.time_step.seconds = seconds_;
    made.time_step.day = day;
    return made;
}

}  // namespace quasimc
