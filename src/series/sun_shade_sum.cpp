#include "series/sun_shade_sum.h"

#include <algorithm>

namespace quasimc {
namespace {

constexpr double kSecondsPerHour = 3600;
/// Smaller fractions of an area are rounding.
constexpr double kNoArea = 1e-12;

using Part = SunShadePart;

const SunShadeEntry& entry_of(std::size_t value, std::size_t bands) {
    return sun_shade_table()[value / bands % kSunShadeQuantities];
}

/// The fraction of a row's area that is sunlit on a surface.
Estimate lit_of(
    const SunShadeLight& light,
    const std::vector<Estimate>& sunlit,
    std::size_t row,
    SunShadeSurface surface) {
    if (surface == SunShadeSurface::absorbed_by_both) {
        return sunlit.empty() ? Estimate{} : sunlit[row];
    }
    return light.at(
        row, surface == SunShadeSurface::upper ? SunShadeQuantity::sunlit_fraction_upper
                                               : SunShadeQuantity::sunlit_fraction_lower);
}

/// The area of a part, as a fraction. Only mean and error are set.
Estimate area_of(Part part, const Estimate& lit) {
    const double mean = part == Part::sunlit ? lit.mean : 1 - lit.mean;
    return {mean > kNoArea ? mean : 0, lit.standard_error};
}

}  // namespace

SunShadeAdder::SunShadeAdder(std::size_t rows, std::size_t bands)
    : bands_(bands),
      sums_(rows * kSunShadeQuantities * bands),
      hours_(rows),
      quotients_(sums_.size()) {}

void SunShadeAdder::add(
    const SunShadeLight& light,
    const std::vector<Estimate>& sunlit,
    const TimeWeight& weight,
    double freedom) {
    const double hours = weight.whole / kSecondsPerHour;
    for (std::size_t i = 0; i < sums_.size(); ++i) {
        const SunShadeEntry& entry = entry_of(i, bands_);
        if (entry.part == Part::direct || entry.part == Part::fraction) {
            sums_[i].add(light.values[i], entry.has_bands() ? weight.part : hours, freedom);
        } else {
            const std::size_t row = i / (kSunShadeQuantities * bands_);
            const Estimate lit = lit_of(light, sunlit, row, entry.surface);
            quotients_[i].add(light.values[i], area_of(entry.part, lit), weight, freedom);
        }
    }
    for (std::size_t row = 0; row < hours_.size() && !sunlit.empty(); ++row) {
        hours_[row].add(sunlit[row], hours, freedom);
    }
    seconds_ += weight.whole;
}

SunShadeLight SunShadeAdder::sum(double seconds) const {
    SunShadeLight sum{bands_};
    for (std::size_t i = 0; i < sums_.size(); ++i) {
        const Part part = entry_of(i, bands_).part;
        TimeQuotient quotient = quotients_[i];
        if (part == Part::shaded) {
            quotient.add_whole(seconds - seconds_);
        }
        sum.values.push_back(
            part == Part::direct || part == Part::fraction ? sums_[i].estimate()
                                                           : quotient.estimate());
    }
    return sum;
}

std::vector<Estimate> SunShadeAdder::sunlit_hours() const {
    std::vector<Estimate> hours(hours_.size());
    std::ranges::transform(
        hours_, hours.begin(), [](const TimeSum& sum) { return sum.estimate(); });
    return hours;
}

}  // namespace quasimc
