#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "files/output_files.h"
#include "netcdf/netcdf_writer.h"
#include "option_flags.h"
#include "output_choice.h"
#include "quasimc/quasimc.h"
#include "resultio/row_comparison.h"
#include "run_fields.h"
#include "run_picture.h"

/// The files that a run may write: their numbers in quasimc::kOutputFiles.
using Output = std::size_t;
constexpr Output kCsv = 0, kDays = 1, kGroups = 2, kGroupDays = 3, kPicture = 4, kVtp = 5, kPly = 6,
                 kGlb = 7, kNetcdf = 8, kJson = 9, kOutputs = 10;
/// "--groups-csv".
[[nodiscard]] std::string flag_of(Output output);

/// What the command line of `quasimc run` says.
struct RunArguments {
    std::string file, from;
    std::array<std::string, kOutputs> outputs;
    OutputChoice choice;
    bool quiet = false, progress = false;
    OptionFlags flags;
    std::string part, sums;  ///< of `run` alone, as what follows:
    std::string checkpoint;
    static constexpr double kUsualEvery = 60;
    double every = kUsualEvery;  ///< seconds
    bool resume = false;
    bool view = false;
    std::vector<std::string> parts;  ///< of `merge` alone: files
};

/// What was read: beside the files of the run, the result that is repeated, and parts.
[[nodiscard]] std::vector<quasimc::InputFile> inputs_of(
    const RunArguments& arguments, const quasimc::RunFile& run);

/// What the runs of a sweep write while they are computed, one after the other.
class RunWriters : public quasimc::RunListener {
  public:
    /// Opens the files, so that a wrong path is told before anything is computed.
    /// @param first  must outlive the writers, or the call of next_run()
    RunWriters(const RunArguments& arguments, const quasimc::RunFile& first);

    void on_time_step(const quasimc::TimeStepResult& step) override;
    void on_day(std::size_t day, const quasimc::SeriesSum& sum) override;
    [[nodiscard]] bool wants_days() const override;
    [[nodiscard]] bool wants_total() const override;
    /// What follows is of the next point. @param summary  of the point that ends
    void next_run(const quasimc::RunFile& run, const quasimc::SeriesSummary& summary);
    /// Gives the files their names.
    /// @param summary  of the last point
    /// @returns the digest of the organs, if it was asked for
    std::string finish(const quasimc::SeriesSummary& summary);
    /// Where the rows of numbers differ from those of the result that is repeated, in words; "" if
    /// nowhere or without --from. To be asked after finish().
    [[nodiscard]] std::string difference();

    /// @param all  of all points
    /// @param comparison  with the result that was repeated; ends the text
    void print_summary(const quasimc::SeriesSummary& all, const std::string& comparison) const;

    /// @throws InputError  if some of the files could not be written
    void throw_if_given_up() const { outputs_.throw_if_given_up(); }

  private:
    /// Which files a run writes, and where.
    struct Asked {
        std::array<std::optional<std::size_t>, kOutputs> numbers;  // among the paths
        std::vector<quasimc::OutputPath> paths;
    };
    [[nodiscard]] static Asked asked_outputs(
        const RunArguments& arguments, const quasimc::RunFile& run);
    [[nodiscard]] bool wants(Output output) const { return asked_.numbers[output].has_value(); }
    [[nodiscard]] quasimc::TextSink sink_of(Output output) {
        return outputs_.sink(*asked_.numbers[output]);
    }
    /// Where the text of the JSON result goes; empty if nobody reads it.
    [[nodiscard]] quasimc::TextSink json_sink();
    /// No room for what the writer keeps until the end costs no more than its own file.
    template <typename Action>
    void write_json(Action action);
    /// Nor do points of a sweep that have no place in the file.
    template <typename Action>
    void write_netcdf(Action action);
    [[nodiscard]] bool wants_fields() const;
    void write_fields(const quasimc::SeriesSummary& summary);

    const quasimc::RunFile* run_;
    Asked asked_;
    quasimc::OutputFiles outputs_;
    quasimc::Summary summary_;
    std::vector<quasimc::CsvWriter> tables_;
    std::optional<RunPicture> picture_;
    std::optional<RunFields> fields_;
    std::optional<quasimc::NetcdfWriter> netcdf_;
    std::optional<quasimc::RowComparison> comparison_;  // with the result that is repeated
    std::optional<quasimc::JsonWriter> json_;
};
