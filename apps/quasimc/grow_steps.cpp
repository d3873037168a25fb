#include "grow_steps.h"

#include <algorithm>

#include <fmt/format.h>

#include "quasimc/version.h"
#include "resultio/csv_parts.h"
#include "results/units.h"
#include "text/line_scanner.h"

namespace {

/// The sum of a band over all organs: the first group.
quasimc::Estimate sum_of(const quasimc::Result& result, std::size_t band) {
    return result.groups.values.empty()
               ? quasimc::Estimate{}
               : result.groups.at(0, quasimc::Quantity::absorbed_flux, band);
}

}  // namespace

std::vector<quasimc::Estimate> absorbed_light(const quasimc::StepLight& light) {
    std::vector<quasimc::Estimate> absorbed;
    for (const quasimc::Result& result : light.results) {
        const std::size_t bands = light.results.size() == 1 ? result.bands : 1;
        for (std::size_t b = 0; b < bands; ++b) {
            absorbed.push_back(quasimc::reported(sum_of(result, b)));
        }
    }
    return absorbed;
}

void StepTable::add(GrownPlant& plant) {
    Row row{.step = plant.step(), .modules = plant.plant().string().size()};
    if (const auto& scene = plant.scene()) {
        row.organs = scene->organs().size();
        for (const quasimc::Organ& organ : scene->organs()) {
            row.area += organ.area;
        }
    }
    if (!rows_.empty() && rows_.back().step == row.step) {
        rows_.pop_back();
    }
    rows_.push_back(std::move(row));
}

void StepTable::set_light(const GrowEnvironment& environment) {
    const auto row = std::find_if(rows_.rbegin(), rows_.rend(), [&](const Row& entry) {
        return entry.step == environment.pass_step();
    });
    if (row != rows_.rend()) {
        const quasimc::StepSnapshot light = environment.light();
        bands_ = light.specification.bands;
        row->absorbed = absorbed_light(*light.light);
    }
}

std::string StepTable::text() const {
    std::string text = fmt::format(
        "# QuasiMC {}, table of steps\n# column step: derivation steps of the string\n"
        "# column area: one-sided area of the drawn organs\n",
        quasimc::version());
    text += bands_.empty() ? "" : quasimc::csv_error_columns();
    std::string header = "step,modules,organs,area";
    for (const quasimc::Band& band : bands_) {
        const std::string unit = quasimc::flux_unit(band.unit, "");
        text += fmt::format(
            "# column absorbed_flux_{}: light that the organs with queries absorb{}{}\n",
            quasimc::one_line(band.name), unit.empty() ? "" : ", ", unit);
        const std::string name = "absorbed_flux_" + band.name;
        header += fmt::format(
            ",{},{},{}", quasimc::csv_field(name), quasimc::csv_field(name + "_se"),
            quasimc::csv_field(name + "_ci95_high"));
    }
    text += header + "\n";
    for (const Row& row : rows_) {
        text += fmt::format("{},{},{}", row.step, row.modules, row.organs);
        quasimc::append_csv(text, row.area);
        for (std::size_t b = 0; b < bands_.size(); ++b) {
            if (b < row.absorbed.size()) {
                quasimc::append_csv(text, row.absorbed[b]);
            } else {
                text += ",,,";
            }
        }
        text += "\n";
    }
    return text;
}
