// What a canopy intercepts, absorbs and reflects, in the words of the field.

#include "resultio/canopy_lines.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/number_text.h"
#include "light/daylight/daylight.h"
#include "text/line_scanner.h"

namespace quasimc {
namespace {

bool is_par(const Band& band) {
    constexpr double kFrom = 400, kTo = 700;
    const auto span = span_of_band(band.name, band.from_nm, band.to_nm);
    return span && span->from_nm == kFrom && span->to_nm == kTo;
}

/// " (maize 0.565, bean 0.254)": the shares of the first requested groups, if they are few.
std::string shares_of(const GroupResults& groups, std::size_t band) {
    constexpr std::size_t kMaxGroups = 6;
    std::vector<std::string> texts;
    std::string_view by;
    for (std::size_t g = 0; g < groups.groups.size() && !groups.shares.empty(); ++g) {
        const OrganGroup& group = groups.groups[g];
        by = by.empty() && group.by != kAllOrgans ? std::string_view(group.by) : by;
        const Estimate share = groups.share(g, GroupShare::incident, band);
        if (group.by == by && std::isfinite(share.mean)) {
            texts.push_back(fmt::format("{} {:.3f}", one_line(group.value), reported(share).mean));
        }
    }
    return texts.empty() || texts.size() > kMaxGroups
               ? ""
               : fmt::format(" ({})", fmt::join(texts, ", "));
}

/// The complement of a fraction.
Estimate complement(const Estimate& e) {
    return {1 - e.mean, e.standard_error, 1 - e.ci95_high, 1 - e.ci95_low};
}

}  // namespace

std::string with_error(const Estimate& e) {
    constexpr int kDecimals = 4;
    const std::string text = with_decimals(reported(e).mean, kDecimals);
    return std::isfinite(e.standard_error) && e.standard_error > 0
               ? fmt::format("{} +- {:.1g}", text, e.standard_error)
               : text;
}

void CanopySum::add(const Result& result, double weight) {
    by_height_.add(result, weight);
    bands_.resize(result.canopy.size());
    for (std::size_t b = 0; b < bands_.size(); ++b) {
        const double incident = weight * result.canopy[b].incident;
        if (!(incident > 0)) {
            continue;
        }
        bands_[b].incident += incident;
        for (std::size_t i = 0; i < fraction_table().size(); ++i) {
            const Estimate& part = result.canopy[b].*fraction_table()[i].part;
            Fraction& sum = bands_[b].fractions[i];
            sum.amount += incident * part.mean;
            sum.variance += incident * part.standard_error * incident * part.standard_error;
        }
    }
}

std::vector<std::string> CanopySum::lines(const RunFile& run, const GroupResults* groups) const {
    std::vector<std::string> lines;
    for (std::size_t b = 0; b < std::min(bands_.size(), kMaxBands); ++b) {
        const OfBand& sums = bands_[b];
        CanopyFractions fractions;
        for (std::size_t i = 0; i < fraction_table().size() && sums.incident > 0; ++i) {
            const double mean = sums.fractions[i].amount / sums.incident;
            const double error = std::sqrt(sums.fractions[i].variance) / sums.incident;
            fractions.*fraction_table()[i].part = {mean, error, mean, mean};
        }
        const Band& band = run.scene.bands()[b];
        std::vector<std::string> words;
        const auto add = [&](std::string_view name, const Estimate& e, const std::string& rest) {
            if (!std::isnan(e.mean)) {
                words.push_back(fmt::format("{} {}{}", name, with_error(e), rest));
            }
        };
        if (!(sums.incident > 0)) {
            continue;
        }
        add(is_par(band) ? "fIPAR" : "intercepted", complement(fractions.transmittance), "");
        add(is_par(band) ? "fAPAR" : "absorbed", fractions.absorptance,
            groups == nullptr ? "" : shares_of(*groups, b));
        add("albedo", fractions.reflectance, "");
        add("ground", fractions.ground_absorptance, "");
        lines.push_back(fmt::format("{}: {}", one_line(band.name), fmt::join(words, ", ")));
    }
    const std::vector<std::string> by_height = by_height_.lines(run);
    lines.insert(lines.end(), by_height.begin(), by_height.end());
    return lines;
}

}  // namespace quasimc
