// The transmittance of a canopy by height.

#include "resultio/height_lines.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "resultio/canopy_lines.h"
#include "results/groups.h"
#include "results/sensor_transmittance.h"
#include "text/line_scanner.h"

namespace quasimc {
namespace {

/// The height of a horizontal mean of irradiance from above; empty for other sensors.
std::optional<double> level_of(const SensorSet& set) {
    constexpr double kRounding = 1e-9;
    const double height = set.points.front().position.z;
    const bool is_level = std::ranges::all_of(set.points, [&](const SensorPoint& point) {
        return std::abs(point.position.z - height) <= kRounding * (1 + std::abs(height));
    });
    return set.is_averaged && is_level && receives_horizontal(set) ? std::optional(height)
                                                                   : std::nullopt;
}

}  // namespace

TransmittanceSum::TransmittanceSum(const Scene& scene) {
    std::size_t row = 0;
    for (const SensorSet& set : scene.sensors()) {
        if (const auto height = level_of(set)) {
            levels_.push_back({set.name, row, *height});
        }
        row += set.rows();
    }
    std::ranges::stable_sort(levels_, {}, &Level::height);
    area_ = levels_.empty() ? 0 : horizontal_area(scene);
}

void TransmittanceSum::add(const Result& result, double weight) {
    if (levels_.empty() || result.sensors == nullptr || result.canopy.empty()) {
        return;
    }
    bands_.resize(result.canopy.size());
    for (std::size_t b = 0; b < bands_.size(); ++b) {
        const double incident = weight * result.canopy[b].incident / area_;
        if (!(incident > 0)) {
            continue;
        }
        OfBand& sums = bands_[b];
        sums.incident += incident;
        sums.amounts.resize(levels_.size());
        sums.variances.resize(levels_.size());
        for (std::size_t i = 0; i < levels_.size(); ++i) {
            const Estimate light =
                scaled(result.sensors->at(levels_[i].row, Quantity::incident_upper, b), weight);
            sums.amounts[i] += light.mean;
            sums.variances[i] += light.standard_error * light.standard_error;
        }
    }
}

std::string TransmittanceSum::text_of(const OfBand& band, const std::string& unit) const {
    constexpr std::size_t kMaxLevels = 12;
    const bool has_equal_heights =
        std::ranges::adjacent_find(levels_, {}, &Level::height) != levels_.end();
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < std::min(levels_.size(), kMaxLevels); ++i) {
        const double mean = band.amounts[i] / band.incident;
        const double error = std::sqrt(band.variances[i]) / band.incident;
        texts.push_back(
            with_error({mean, error, mean, mean}) +
            fmt::format(" at {:.6g} {}", levels_[i].height, one_line(unit)) +
            (has_equal_heights ? fmt::format(" ({})", one_line(levels_[i].name)) : ""));
    }
    if (levels_.size() > kMaxLevels) {
        texts.push_back(fmt::format("and {} more", levels_.size() - kMaxLevels));
    }
    return fmt::format("transmittance {}", fmt::join(texts, ", "));
}

std::vector<std::string> TransmittanceSum::lines(const RunFile& run) const {
    std::vector<std::string> lines;
    for (std::size_t b = 0; b < std::min(bands_.size(), CanopySum::kMaxBands); ++b) {
        if (bands_[b].incident > 0) {
            lines.push_back(fmt::format(
                "{}: {}", one_line(run.scene.bands()[b].name),
                text_of(bands_[b], run.scene.length_unit())));
        }
    }
    return lines;
}

}  // namespace quasimc
