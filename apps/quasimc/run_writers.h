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
    [[nodiscard]] bool wants_days() const override;
    [[nodiscard]] bool wants_total() const override;
    /// What follows is of the next point. @param of_the_last  of the point that ends
    void next_run(const quasimc::RunFile& run, const quasimc::SeriesSummary& of_the_last);
    /// Gives the files their names.
    /// @param of_the_last  of the last point
    /// @returns the digest of the organs of a run that is repeated, else ""
    std::string finish(const quasimc::SeriesSummary& of_the_last);
    /// Where the rows of numbers differ from those of the result that is repeated, in words; "" if
    /// nowhere or without --from. To be asked after finish().
    [[nodiscard]] std::string difference();

    /// @param all  of all points
    /// @param comparison  with the result that was repeated; ends the text
    void print_summary(const quasimc::SeriesSummary& all, const std::string& comparison) const;

    /// @throws InputError  if some of the files could not be written
    void throw_if_given_up() const { files_.throw_if_given_up(); }

  private:
    /// Does it with all writers. A file whose writer fails is given up, and the others are written.
    template <typename Action>
    void for_each_writer(Action action);
    template <typename Wants>
    [[nodiscard]] bool any_writer(Wants wants) const;

    quasimc::OutputFiles files_;
    std::vector<std::unique_ptr<quasimc::OutputWriter>> outputs_;  // of files; null: given up
    quasimc::Summary summary_;
    std::optional<quasimc::RowComparison> comparison_;  // with the result that is repeated
    std::optional<quasimc::JsonWriter> repeated_;       // whose text is compared, and its digest
};
