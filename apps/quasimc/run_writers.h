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

/// "--groups-csv". @param output  its key
[[nodiscard]] std::string flag_of(std::string_view output);

/// What the command line of `quasimc run` says.
struct RunArguments {
    std::string file, from;
    std::map<std::string, std::string, std::less<>> outputs;  ///< paths by key; "": none
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

/// An output that was asked for.
struct AskedOutput {
    quasimc::OutputPath file;
    quasimc::MakeOutput* make;
};

/// Writes what the runs of a sweep compute, one after the other, to all files that were asked for,
/// and sums it up.
class RunWriters : public quasimc::RunListener {
  public:
    /// Opens the files, so that a wrong path is reported before anything is computed.
    /// @param first  must outlive the writers, or the call of next_run()
    /// @throws InputError  also of an output that the run has nothing for
    RunWriters(const RunArguments& arguments, const quasimc::RunFile& first);

    void on_time_step(const quasimc::TimeStepResult& step) override;
    void on_day(std::size_t day, const quasimc::SeriesSum& sum) override;
    [[nodiscard]] bool wants(quasimc::SeriesPart part) const override;
    /// Begins the next point. @param series_summary  of the previous point
    void next_run(const quasimc::RunFile& run, const quasimc::SeriesSummary& series_summary);
    /// How a run that is repeated compares with its result; "" where it isn't one.
    struct Repeated {
        std::string digest;      ///< of the organs
        std::string difference;  ///< of the rows of numbers, in words; "" if there is none
    };
    /// Ends the files and gives them their names. @param series_summary  of the last point
    Repeated finish(const quasimc::SeriesSummary& series_summary);

    /// @param all  of all points
    /// @param comparison  with the result that was repeated; ends the text
    void print_summary(const quasimc::SeriesSummary& all, const std::string& comparison) const;

    /// Why some of the files could not be written.
    [[nodiscard]] const quasimc::Faults& faults() const { return files_.faults(); }
    /// Whether files were asked for, and none of them can be written any more.
    [[nodiscard]] bool are_all_given_up() const { return files_.are_all_given_up(); }

  private:
    RunWriters(
        const RunArguments& arguments,
        const quasimc::RunFile& first,
        const std::vector<AskedOutput>& asked);
    /// Does it with all writers. A file whose writer fails is given up, and the others are written.
    template <typename Action>
    void for_each_writer(Action action);

    quasimc::OutputFiles files_;
    std::vector<std::unique_ptr<quasimc::OutputWriter>> outputs_;  // of files; null: given up
    quasimc::Summary summary_;
    std::optional<quasimc::RowComparison> comparison_;  // with the result that is repeated
    std::optional<quasimc::JsonWriter> repeated_;       // whose text is compared, and its digest
};
