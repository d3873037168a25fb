#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "files/output_files.h"
#include "option_flags.h"
#include "output_choice.h"
#include "quasimc/quasimc.h"
#include "resultio/row_comparison.h"
#include "runfile/output_catalogue.h"

/// The flag of an output, "--groups-csv". @param output  its key
[[nodiscard]] std::string flag_of(std::string_view output);

/// The command line of `quasimc run`.
struct RunArguments {
    std::string file, from;
    std::map<std::string, std::string, std::less<>> outputs;  ///< paths by key; "": none
    OutputChoice choice;
    bool quiet = false, progress = false;
    OptionFlags flags;
    std::string part, sums;  ///< the members below, up to `resume`, are of `run` only
    std::string checkpoint;
    static constexpr double kDefaultInterval = 60;
    double checkpoint_interval = kDefaultInterval;  ///< seconds
    bool resume = false;
    bool view = false;
    std::vector<std::string> parts;  ///< part files, of `merge` only
};

/// The input files: those of the run, the repeated result, and parts.
[[nodiscard]] std::vector<quasimc::InputFile> inputs_of(
    const RunArguments& arguments, const quasimc::RunFile& run);

/// A requested output.
struct RequestedOutput {
    quasimc::OutputPath file;
    quasimc::MakeOutput* make;
    const quasimc::TableSpec* table = nullptr;  ///< the [[table]] that requests it
};

/// Writes the results of the runs of a sweep, one after the other, to all requested files, and
/// prints the summary.
class RunWriters : public quasimc::RunListener {
  public:
    /// Opens the files, so that a wrong path is reported before anything is computed.
    /// @param first  must outlive the writers, or the call of next_run()
    /// @throws InputError  also for an output without content
    RunWriters(const RunArguments& arguments, const quasimc::RunFile& first);

    void on_time_step(const quasimc::TimeStepResult& step) override;
    void on_day(std::size_t day, const quasimc::SeriesSum& sum) override;
    void on_sums(const quasimc::SeriesSums& sums) override;
    [[nodiscard]] bool wants(quasimc::SeriesPart part) const override;
    /// Begins the next point. @param series_summary  summary of the previous point
    void next_run(const quasimc::RunFile& run, const quasimc::SeriesSummary& series_summary);
    /// Comparison of a repeated run with its result; "" for other runs.
    struct Repeated {
        std::string digest;      ///< digest of the organs
        std::string difference;  ///< RowComparison::difference()
    };
    /// Ends the files and gives them their names. @param series_summary  summary of the last point
    Repeated finish(const quasimc::SeriesSummary& series_summary);

    /// @param all  summary of all points
    /// @param comparison  with the repeated result; the end of the text
    void print_summary(const quasimc::SeriesSummary& all, const std::string& comparison) const;

    /// Why some of the files could not be written.
    [[nodiscard]] const quasimc::Faults& faults() const { return files_.faults(); }
    /// Whether files were requested, and none of them can be written any more.
    [[nodiscard]] bool are_all_given_up() const { return files_.are_all_given_up(); }

  private:
    RunWriters(
        const RunArguments& arguments,
        const quasimc::RunFile& first,
        const std::vector<RequestedOutput>& requested);
    /// Calls `action` for all writers. If one fails, its file is given up; the others are written.
    template <typename Action>
    void for_each_writer(Action action);

    quasimc::OutputFiles files_;
    std::vector<std::unique_ptr<quasimc::OutputWriter>> outputs_;  // one per file; null: given up
    quasimc::Summary summary_;
    std::optional<quasimc::RowComparison> comparison_;  // with the repeated result
    std::optional<quasimc::JsonWriter> repeated_;       // its text and its digest are compared
};
