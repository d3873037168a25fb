#include <algorithm>
#include <utility>

#include "light/daylight/hour_light.h"

namespace quasimc {
namespace {

/// Direct and diffuse light on the horizontal in the unit of a reading.
struct Parts {
    double direct = 0, diffuse = 0;
};

/// Irradiance of the beam on the horizontal, if it was measured.
std::optional<double> beam_on_horizontal(const Reading& reading, double sine) {
    return reading.beam_normal ? std::optional(*reading.beam_normal * sine) : std::nullopt;
}

/// Direct light on the horizontal, if the reading defines it.
std::optional<double> direct_of(const Reading& reading, double sine) {
    return reading.direct_horizontal ? reading.direct_horizontal
                                     : beam_on_horizontal(reading, sine);
}

/// The parts, if the reading defines them.
std::optional<Parts> parts_of(const Reading& reading, double sine) {
    const std::optional<double> direct = direct_of(reading, sine);
    if (direct && reading.diffuse) {
        return Parts{*direct, *reading.diffuse};
    }
    if (reading.global && direct) {
        return Parts{*direct, *reading.global - *direct};
    }
    if (reading.global && reading.diffuse) {
        return Parts{*reading.global - *reading.diffuse, *reading.diffuse};
    }
    return std::nullopt;
}

/// Whether redundant readings differ by more than a tenth and the error of instruments.
bool disagree(const Reading& reading, double sine, LightUnit unit, const DaylightSpectra& spectra) {
    constexpr double kPart = 0.1;
    constexpr double kInstruments = 20;  // W m-2
    const auto differ = [&](double a, double b) {
        const double off = std::abs(a - b);
        return off > kPart * std::max(a, b) && spectra.from_global(off, unit) > kInstruments;
    };
    const std::optional<double> beam = beam_on_horizontal(reading, sine);
    const std::optional<double> direct = direct_of(reading, sine);
    return (beam && differ(*direct, *beam)) ||
           (reading.global && direct && reading.diffuse &&
            differ(*reading.global, *direct + *reading.diffuse));
}

/// Daylight that is all from the sky.
Daylight all_diffuse(double global, LightUnit unit, const DaylightSpectra& spectra) {
    return spectra.from_parts(0, global, unit);
}

/// A constant beam while the sun is up, with the given mean on the horizontal.
std::vector<double> even_beam(const SunPath& path, double direct) {
    std::vector<double> facing;
    const double sine = path.mean_sine();
    for (const SunPosition& sun : path.steps) {
        facing.push_back(direct > 0 && SunPath::is_up(sun) ? direct / sine : 0);
    }
    return facing;
}

/// Largest offset of thermopiles where there is hardly any light, W m-2: they read -1 to -5 in
/// clear nights, some -10 and less.
constexpr double kOffset = 20;
/// Largest offset of the difference of two thermopiles.
constexpr double kDifference = 5;

/// From this elevation on all light from above is positive.
constexpr double kDayDeg = 5;

/// A reading whose slightly negative values are set to 0.
struct Settled {
    Reading reading;
    bool is_far_below = false;     ///< a value was below the offset of instruments
    bool is_below_by_day = false;  ///< light from above was negative with the sun up
};

Settled settle_offsets(
    const Reading& given, const SunPath& path, LightUnit unit, const DaylightSpectra& spectra) {
    Settled settled{given};
    const bool is_day = path.highest_deg() > kDayDeg;
    const auto settle = [&](std::optional<double>& part, double offset_by_day) {
        if (!part || *part >= 0) {
            return;
        }
        const double below = spectra.from_global(-*part, unit);
        settled.is_far_below = settled.is_far_below || below > kOffset;
        settled.is_below_by_day = settled.is_below_by_day || (is_day && below > offset_by_day);
        part = 0;
    };
    // A beam may be 0 by day.
    settle(settled.reading.global, 0);
    settle(settled.reading.diffuse, 0);
    settle(settled.reading.direct_horizontal, kDifference);
    settle(settled.reading.beam_normal, kDifference);
    return settled;
}

/// Turns a reading into light, position by position.
class ReadingLight {
  public:
    ReadingLight(
        const SunPath& path, LightUnit unit, const DaylightSpectra& spectra, const ClearAir& air)
        : path_(path), sine_(path.mean_sine()), unit_(unit), spectra_(spectra), air_(air) {}

    HourLight make(const Reading& given, DiffuseModel model) {
        const Settled settled = settle_offsets(given, path_, unit_, spectra_);
        const Reading& reading = settled.reading;
        const std::optional<Parts> parts = parts_of(reading, sine_);
        if (settled.is_far_below || (!parts && !reading.global)) {
            light_.fault = settled.is_far_below ? ReadingFault::negative : ReadingFault::incomplete;
            return std::move(light_);
        }
        light_.note = settled.is_below_by_day ? ReadingNote::negative_by_day : ReadingNote::none;
        const double global = parts ? parts->direct + parts->diffuse : *reading.global;
        if (global <= 0 && parts) {
            static_cast<void>(settle_parts(*parts));
        } else if (global > 0 && !is_dark(global)) {
            if (parts) {
                take_parts(settle_parts(*parts));
            } else {
                split(global, model);
            }
            if (light_.note == ReadingNote::none && disagree(reading, sine_, unit_, spectra_)) {
                light_.note = ReadingNote::parts_disagree;
            }
            bound_beam(global, parts.has_value());
        }
        light_.facing = even_beam(path_, light_.daylight.direct);
        return std::move(light_);
    }

  private:
    [[nodiscard]] double watts(double amount) const { return spectra_.from_global(amount, unit_); }

    /// Whether it is night. Sensors may read a little then; more is an error.
    bool is_dark(double global) {
        constexpr double kNightLight = 50;
        constexpr double kDuskDeg = -2, kNightDeg = -6;
        if (path_.highest_deg() < kDuskDeg && watts(global) > kNightLight) {
            light_.fault = ReadingFault::light_at_night;
            return false;
        }
        const bool is_night = path_.highest_deg() < kNightDeg;
        light_.note = is_night ? ReadingNote::light_at_night : light_.note;
        return is_night;
    }

    /// Non-negative parts with the same sum.
    Parts settle_parts(const Parts& given) {
        if (given.direct >= 0 && given.diffuse >= 0) {
            return given;
        }
        constexpr double kNoise = 0.1;
        const double global = given.direct + given.diffuse;
        const bool is_all_direct = given.diffuse < 0;
        const double excess = -std::min(given.direct, given.diffuse);
        if (excess > kNoise * global && watts(excess) > kDifference) {
            light_.fault = ReadingFault::part_exceeds_global;
        }
        if (global > 0) {
            light_.note = is_all_direct ? ReadingNote::more_direct_than_global
                                        : ReadingNote::more_diffuse_than_global;
        }
        return is_all_direct ? Parts{global, 0} : Parts{0, global};
    }

    void take_parts(const Parts& parts) {
        light_.daylight = spectra_.from_parts(parts.direct, parts.diffuse, unit_);
    }

    /// Splits global light by the model of the diffuse fraction; all is diffuse without a sun.
    void split(double global, DiffuseModel model) {
        if (sine_ > 0) {
            const double clearness = watts(global) / (path_.outside() * sine_);
            light_.daylight =
                spectra_.from_fraction(global, unit_, diffuse_fraction(model, clearness, sine_));
        } else {
            light_.daylight = all_diffuse(global, unit_, spectra_);
        }
    }

    /// Counts the impossible excess of the beam as diffuse. @param is_measured  or of the model
    void bound_beam(double global, bool is_measured) {
        constexpr double kMaxOfClear = 2;
        constexpr double kHighDeg = 10;
        const double outside = path_.outside() * sine_;
        if (light_.daylight.direct > outside && path_.highest_deg() > kHighDeg) {
            light_.note = ReadingNote::more_direct_than_outside;
            light_.daylight = all_diffuse(global, unit_, spectra_);
            return;
        }
        const double most =
            std::min(outside, kMaxOfClear * clear_light(path_, air_).daylight.direct);
        if (light_.daylight.direct > most) {
            constexpr double kWorthANote = 5;  // W m-2: weak beams have large measurement errors
            const bool is_noted = is_measured && light_.daylight.direct - most > kWorthANote;
            light_.note = is_noted ? ReadingNote::beam_too_strong : light_.note;
            const double kept = most * spectra_.direct(span_of(unit_));
            take_parts({kept, global - kept});
        }
    }

    const SunPath& path_;
    double sine_;
    LightUnit unit_;
    const DaylightSpectra& spectra_;
    const ClearAir& air_;
    HourLight light_;
};

}  // namespace

HourLight measured_light(
    const SunPath& path,
    const Reading& reading,
    LightUnit unit,
    DiffuseModel model,
    const DaylightSpectra& spectra,
    const ClearAir& air) {
    return ReadingLight(path, unit, spectra, air).make(reading, model);
}

}  // namespace quasimc
