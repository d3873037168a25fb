#include "netcdf/netcdf_writer.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "netcdf/netcdf_layout.h"
#include "quasimc/error.h"
#include "runfile/written.h"

namespace quasimc {

bool has_netcdf() {
    return true;
}

class NetcdfWriter::State {
  public:
    State(const RunFile& run, TextSink sink, std::string_view program_version)
        : run_(&run), sink_(std::move(sink)), layout_(run, program_version, file_) {
        times_ = times_of(run);
        if (run.sweep) {
            organs_ = run.scene.organs();
        }
    }

    void add_moment(std::size_t time_step, const Result& result) {
        std::vector<std::size_t> start = layout_.place_of(*run_);
        if (!is_written(*run_, time_step, result)) {
            return;
        }
        if (run_->series) {
            const auto row = layout_.row_of(time_step);
            if (!row) {
                return;
            }
            start.push_back(*row);
        }
        put_light(layout_.light, start, result);
        const std::size_t organs = run_->scene.organs().size();
        if (layout_.sunlit && !result.sunlit_fraction.empty()) {
            put(*layout_.sunlit, start, {organs}, [&](std::size_t organ) -> const Estimate& {
                return result.sunlit_fraction[organ];
            });
        }
        if (layout_.ratios) {
            put(*layout_.ratios, start, {result.ratios, organs},
                [&](std::size_t i) -> const Estimate& {
                    return result.ratio(i % organs, i / organs);
                });
        }
    }

    void add_day(std::size_t day, const SeriesSum& sum) {
        std::vector<std::size_t> start = layout_.place_of(*run_);
        start.push_back(day);
        put_light(layout_.days, start, sum);
    }

    void next_run(const RunFile& run) {
        if (times_of(run) != times_) {
            throw InputError(
                {{"NetCDF", "the points of the sweep have times of their own",
                  "a file has one axis of time", "sweep something else, or write CSV"}});
        }
        if (!has_same_organs(run)) {
            throw InputError(
                {{"NetCDF", "the points of the sweep have organs of their own",
                  "a file has one axis of organs, with their ids, names and labels",
                  "sweep something else, or write CSV"}});
        }
        run_ = &run;
        layout_.put_areas(run);
    }

    void finish() { file_.copy_to(sink_); }

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
                put(variables[number++], start, sizes, [&](std::size_t i) -> const Estimate& {
                    return light.at(i % organs, entry.quantity, list.bands[i / organs]);
                });
            }
        }
    }

    /// Puts a block: `estimate(i)` for each of its numbers.
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
            &Estimate::mean, &Estimate::standard_error, &Estimate::low, &Estimate::high};
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
    std::vector<std::string> times_;  // of the first point, as are
    std::vector<Organ> organs_;
};

NetcdfWriter::NetcdfWriter(const RunFile& run, TextSink sink, std::string_view program_version)
    : state_(std::make_unique<State>(run, std::move(sink), program_version)) {}

NetcdfWriter::~NetcdfWriter() = default;

void NetcdfWriter::add_moment(std::size_t time_step, const Result& result) {
    state_->add_moment(time_step, result);
}

void NetcdfWriter::add_day(std::size_t day, const SeriesSum& sum) {
    state_->add_day(day, sum);
}

void NetcdfWriter::next_run(const RunFile& run) {
    state_->next_run(run);
}

void NetcdfWriter::finish() {
    state_->finish();
}

}  // namespace quasimc
