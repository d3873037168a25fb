#include "netcdf/netcdf_writer.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "netcdf/netcdf_layout.h"
#include "quasimc/error.h"
#include "resultio/describe_series.h"
#include "runfile/written.h"

namespace quasimc {

namespace {

class NetcdfLight final : public NetcdfWriter {
  public:
    NetcdfLight(const RunFile& run, TextSink sink, std::string_view program_version)
        : run_(&run), sink_(std::move(sink)), layout_(run, program_version, file_) {
        times_ = times_of(run);
        if (run.sweep) {
            organs_ = run.scene.organs();
        }
    }

    void on_time_step(const TimeStepResult& step) override {
        const Result& result = step.result;
        std::vector<std::size_t> start = layout_.indices_of(*run_);
        if (!is_written(*run_, step.time_step, result)) {
            return;
        }
        if (run_->series) {
            const auto row = layout_.row_of(step.time_step);
            if (!row) {
                return;
            }
            start.push_back(*row);
        }
        put_light(layout_.light, start, result);
        put_origins(layout_.light_by_origin, start, result);
        const std::size_t organs = run_->scene.organs().size();
        if (layout_.sunlit && !result.sunlit_fraction.empty()) {
            put(*layout_.sunlit, start, {organs}, [&](std::size_t organ) -> const Estimate& {
                return result.sunlit_fraction[organ];
            });
        }
        for (const NetcdfPart& part : layout_.parts) {
            put_part(part, part.light, start, result.sun_shade);
        }
        if (layout_.ratios) {
            put(*layout_.ratios, start, {result.ratios, organs},
                [&](std::size_t i) { return result.ratio(i % organs, i / organs); });
        }
        put_detectors(start, result);
    }

    void on_day(std::size_t day, const SeriesSum& sum) override {
        add_day(day, in_summed_units(*run_, sum));
    }

    [[nodiscard]] bool wants(SeriesPart part) const override {
        return part == SeriesPart::time_steps ||
               (part == SeriesPart::days && run_->series.has_value());
    }

    void add_day(std::size_t day, const SeriesSum& sum) override {
        std::vector<std::size_t> start = layout_.indices_of(*run_);
        start.push_back(day);
        put_light(layout_.days, start, sum);
        put_origins(layout_.days_by_origin, start, sum);
        for (const NetcdfPart& part : layout_.parts) {
            put_part(part, *part.days, start, sum.sun_shade);
        }
        if (layout_.sunlit_hours && !sum.sunlit_hours.empty()) {
            put(*layout_.sunlit_hours, start, {sum.sunlit_hours.size()},
                [&](std::size_t organ) { return sum.sunlit_hours[organ]; });
        }
    }

    void next_run(const RunFile& run, const SeriesSummary& /*series_summary*/) override {
        if (times_of(run) != times_) {
            throw InputError(
                {{"NetCDF", "the points of the sweep have different time steps",
                  "a file has one time axis", "sweep something else, or write CSV"}});
        }
        if (!has_same_organs(run)) {
            throw InputError(
                {{"NetCDF", "the points of the sweep have different organs",
                  "a file has one axis of organs with ids, names and labels",
                  "sweep something else, or write CSV"}});
        }
        run_ = &run;
        layout_.put_areas(run);
    }

    void finish(const SeriesSummary& /*series_summary*/) override { file_.copy_to(sink_); }

  private:
    static std::vector<std::string> times_of(const RunFile& run) {
        std::vector<std::string> times;
        for (std::size_t i = 0; run.series && i < run.series->notes.size(); ++i) {
            times.push_back(run.series->notes[i].time);
        }
        return times;
    }

    [[nodiscard]] bool has_same_organs(const RunFile& run) const {
        return std::equal(
            organs_.begin(), organs_.end(), run.scene.organs().begin(), run.scene.organs().end(),
            [](const Organ& a, const Organ& b) {
                return a.id == b.id && a.name == b.name && a.labels == b.labels;
            });
    }

    /// @param light  a Result or a SeriesSum
    template <typename Light>
    void put_light(
        const std::vector<NetcdfEstimates>& variables,
        const std::vector<std::size_t>& start,
        const Light& light) {
        const std::size_t organs = run_->scene.organs().size();
        std::size_t number = 0;
        for (const NetcdfBands& list : layout_.bands) {
            const bool has_axis = list.suffix.empty();
            const std::vector<std::size_t> sizes =
                has_axis ? std::vector{list.bands.size(), organs} : std::vector{organs};
            for (const QuantityEntry& entry : layout_.columns.quantities) {
                put(variables[number++], start, sizes, [&](std::size_t i) {
                    return light.at(i % organs, entry.quantity, list.bands[i / organs]);
                });
            }
        }
    }

    /// @param light  a Result or a SeriesSum
    template <typename Light>
    void put_origins(
        const std::vector<NetcdfEstimates>& variables,
        const std::vector<std::size_t>& start,
        const Light& light) {
        for (std::size_t i = 0; i < light.origins.size(); ++i) {
            std::vector<std::size_t> own = start;
            own.push_back(i);
            put_light(variables, own, light.origins[i].light);
        }
    }

    void put_part(
        const NetcdfPart& part,
        const NetcdfEstimates& to,
        const std::vector<std::size_t>& start,
        const SunShadeLight& light) {
        if (light.empty()) {
            return;
        }
        const std::size_t organs = run_->scene.organs().size();
        put(to, start, part.has_axis ? std::vector{part.bands.size(), organs} : std::vector{organs},
            [&](std::size_t i) {
                return light.at(i % organs, part.entry.quantity, part.bands[i / organs]);
            });
    }

    void put_detectors(const std::vector<std::size_t>& start, const Result& result) {
        for (std::size_t d = 0; d < result.detectors.size(); ++d) {
            const DetectorResult& detector = result.detectors[d];
            const std::size_t bins = detector.bins.size();
            for (std::size_t l = 0; l < layout_.bands.size(); ++l) {
                const NetcdfBands& list = layout_.bands[l];
                const bool has_axis = list.suffix.empty();
                put(layout_.detectors[d][l], start,
                    has_axis ? std::vector{list.bands.size(), bins} : std::vector{bins},
                    [&](std::size_t i) { return detector.at(i % bins, list.bands[i / bins]); });
            }
        }
    }

    /// Writes a block: `estimate(i)` for each of its numbers.
    template <typename GetEstimate>
    void put(
        const NetcdfEstimates& to,
        const std::vector<std::size_t>& start,
        const std::vector<std::size_t>& sizes,
        const GetEstimate& estimate) {
        NetcdfBlock block{start, std::vector<std::size_t>(start.size(), 1)};
        std::size_t count = 1;
        for (const std::size_t size : sizes) {
            block.start.push_back(0);
            block.count.push_back(size);
            count *= size;
        }
        constexpr std::array kParts{
            &Estimate::mean, &Estimate::standard_error, &Estimate::ci95_low, &Estimate::ci95_high};
        std::vector<double> numbers(count);
        for (std::size_t part = 0; part < kParts.size(); ++part) {
            for (std::size_t i = 0; i < count; ++i) {
                numbers[i] = reported(estimate(i)).*kParts[part];
            }
            file_.put(to.variables[part], block, numbers);
        }
    }

    const RunFile* run_;
    TextSink sink_;
    NetcdfFile file_;
    NetcdfLayout layout_;
    std::vector<std::string> times_;  // of the first point, like `organs_`
    std::vector<Organ> organs_;
};

}  // namespace

bool has_netcdf() {
    return true;
}

std::unique_ptr<NetcdfWriter> make_netcdf_writer(
    const RunFile& run, TextSink sink, std::string_view program_version) {
    return std::make_unique<NetcdfLight>(run, std::move(sink), program_version);
}

}  // namespace quasimc
