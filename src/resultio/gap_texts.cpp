// Gap fractions as rows of a table and as text: docs/reference/gap-fraction.md.

#include "resultio/gap_texts.h"

#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "base/number_text.h"
#include "base/text.h"
#include "resultio/csv_parts.h"
#include "text/line_scanner.h"

namespace quasimc {
namespace {

/// Begins rows with a position and a part of its view.
class GapRows {
  public:
    GapRows(const GapFractions& found, const std::string& first)
        : found_(found), first_(first + csv_field(found.spec.name)) {}

    /// @param position  index; that of none is all
    void start(std::size_t position) {
        const std::vector<Vec3>& positions = found_.spec.positions;
        position_ = position < positions.size()
                        ? fmt::format(
                              ",{},{},{},{}", position + 1, shortest(positions[position].x),
                              shortest(positions[position].y), shortest(positions[position].z))
                        : ",all,,,";
    }
    void add(std::string_view view, std::string_view quantity, const Estimate& estimate) {
        text_ += fmt::format("{}{},{},{}", first_, position_, view, quantity);
        const Estimate e = reported(estimate);
        for (const double x : {e.mean, e.standard_error, e.ci95_low, e.ci95_high}) {
            append_csv(text_, x);
        }
        text_ += '\n';
    }
    [[nodiscard]] std::string ring(std::size_t ring) const {
        const std::vector<double>& bounds = found_.spec.rings_deg;
        return shortest(bounds[ring]) + "," + shortest(bounds[ring + 1]);
    }
    void add_sectors(std::size_t position, std::size_t ring_index) {
        const std::uint32_t sectors = found_.spec.azimuths;
        for (std::uint32_t s = 0; s < sectors; ++s) {
            const std::string view = fmt::format(
                "{},{},{}", ring(ring_index), shortest(360.0 * s / sectors),
                shortest(360.0 * (s + 1) / sectors));
            add(view, "gap_fraction", found_.gap(position, ring_index, s));
        }
    }
    void add_indices(const GapIndices& indices) {
        for (std::size_t r = 0; r < indices.gap.size(); ++r) {
            add(ring(r) + ",0,360", "gap_fraction", indices.gap[r]);
            add(ring(r) + ",0,360", "clumping_index", indices.clumping[r]);
        }
        add(",,,", "sky_transmittance", indices.sky_transmittance);
        add(",,,", "effective_plant_area_index", indices.effective_plant_area_index);
        add(",,,", "plant_area_index", indices.plant_area_index);
        add(",,,", "clumping_index", indices.clumping_index);
        if (indices.lai_2000) {
            add(",,,", "lai_2000_index", *indices.lai_2000);
        }
    }
    [[nodiscard]] std::string text() && { return std::move(text_); }

  private:
    const GapFractions& found_;
    std::string first_, position_, text_;
};

std::string number(const Estimate& e) {
    return std::isnan(e.mean) ? "-"
           : std::isnan(e.standard_error)
               ? fmt::format("{:.4g}", e.mean)
               : fmt::format("{:.4g} +- {:.1g}", e.mean, e.standard_error);
}

std::string line(std::string_view words, const Estimate& e) {
    return fmt::format("  {:<28}{}\n", words, number(e));
}

}  // namespace

std::string gap_header(const std::vector<std::string>& first) {
    std::string text =
        "# column position: number, or all positions together\n"
        "# column zenith_from_deg, zenith_to_deg: ring, angle from the zenith; empty: whole view\n"
        "# column azimuth_from_deg, azimuth_to_deg: sector, clockwise from north\n"
        "# column mean: gap fraction, or index (docs/reference/gap-fraction.md)\n"
        "# column standard_error: of the sampled directions; differences between positions are not "
        "in "
        "it\n"
        "# column ci95_low, ci95_high: ends of the 95 % confidence interval\n";
    for (const std::string& name : first) {
        text += csv_field(name) + ",";
    }
    return text +
           "name,position,x,y,z,zenith_from_deg,zenith_to_deg,azimuth_from_deg,azimuth_to_deg,"
           "quantity,mean,standard_error,ci95_low,ci95_high\n";
}

std::string gap_rows(const GapFractions& found, const std::string& first) {
    GapRows rows(found, first);
    for (std::size_t position = 0; position < found.by_position.size(); ++position) {
        rows.start(position);
        for (std::size_t ring = 0; ring < found.spec.rings(); ++ring) {
            rows.add_sectors(position, ring);
        }
        rows.add_indices(found.by_position[position]);
    }
    rows.start(found.by_position.size());
    rows.add_indices(found.all);
    return std::move(rows).text();
}

std::string describe_gaps(const GapFractions& found) {
    const GapFractionSpec& spec = found.spec;
    const GapIndices& all = found.all;
    std::string text = fmt::format(
        "{}: {}\n  {:<28}{:<20}{}\n", one_line(printable(spec.name)),
        counted(spec.positions.size(), "position"), "zenith angle (deg)", "gap fraction",
        "clumping index");
    for (std::size_t r = 0; r < spec.rings(); ++r) {
        text += fmt::format(
            "  {:<28}{:<20}{}\n",
            shortest(spec.rings_deg[r]) + " to " + shortest(spec.rings_deg[r + 1]),
            number(all.gap[r]), number(all.clumping[r]));
    }
    text += line("transmitted sky", all.sky_transmittance);
    text += line("effective plant area index", all.effective_plant_area_index);
    text += line("plant area index", all.plant_area_index);
    text += line("clumping index", all.clumping_index);
    text += all.lai_2000 ? line("index of an LAI-2000", *all.lai_2000) : "";
    if (all.closed_bins > 0) {
        text += fmt::format(
            "  {} of {} sectors without a gap; each counts as half a ray: take more rays, or fewer "
            "azimuths\n",
            all.closed_bins, spec.positions.size() * spec.rings() * spec.azimuths);
    }
    return text;
}

}  // namespace quasimc
