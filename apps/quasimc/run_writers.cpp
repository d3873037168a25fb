#include "run_writers.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "files/file_identity.h"
#include "progress.h"
#include "resultio/output_input.h"
#include "text/document.h"

std::string flag_of(std::string_view output) {
    std::string name = fmt::format("--{}", output);
    std::replace(name.begin(), name.end(), '_', '-');
    return name;
}

std::vector<quasimc::InputFile> inputs_of(
    const RunArguments& arguments, const quasimc::RunFile& run) {
    std::vector<quasimc::InputFile> inputs = run.inputs;
    const auto add = [&](const std::string& path) { inputs.push_back({path, path, "", 0, false}); };
    if (!arguments.from.empty()) {
        add(arguments.from);
    }
    if (!arguments.checkpoint.empty()) {
        add(arguments.checkpoint);
    }
    std::for_each(arguments.parts.begin(), arguments.parts.end(), add);
    return inputs;
}

namespace {

/// No output may be one of the files of a checkpoint, which need not be there yet.
void refuse_checkpoint(
    const std::string& checkpoint, const std::vector<quasimc::OutputPath>& outputs) {
    namespace fs = std::filesystem;
    if (checkpoint.empty()) {
        return;
    }
    quasimc::Faults faults;
    const auto name_of = [](const std::string& path) {
        return quasimc::followed(fs::absolute(path)).string();
    };
    const std::string own = name_of(checkpoint);
    for (const quasimc::OutputPath& output : outputs) {
        const std::string name = output.path == "-" ? "" : name_of(output.path);
        if (name == own || name == own + ".done" || name == own + ".lock") {
            faults.add(
                {output.where, output.path + " is a file of the checkpoint", "",
                 "name another file"});
        }
    }
    faults.throw_if_any();
}

/// Adds a fault for each table that a run lacks for an output.
void check_needs(
    const quasimc::OutputKey& key, const quasimc::RunFile& run, quasimc::Faults& faults) {
    for (const quasimc::OutputNeed& need : key.needs) {
        if (!need.table.empty() && run.document->find(need.table) == nullptr) {
            faults.add(
                {flag_of(key.name), fmt::format("the run has no {}", need.shown),
                 std::string(need.reason), ""});
        }
    }
}

/// The requested outputs. Paths on the command line count from the current folder,
/// and override those of the run file.
std::vector<RequestedOutput> requested_outputs(
    const RunArguments& arguments, const quasimc::RunFile& run) {
    std::vector<RequestedOutput> requested;
    quasimc::Faults faults;
    quasimc::for_each_output([&](const quasimc::OutputKey& key, quasimc::MakeOutput* make) {
        const std::string& path = arguments.outputs.at(std::string(key.name));
        const auto given = run.output.files.find(key.name);
        if (!path.empty()) {
            requested.push_back({{path, flag_of(key.name)}, make});
            check_needs(key, run, faults);
        } else if (given != run.output.files.end()) {
            requested.push_back(
                {{given->second, fmt::format("{}: [output]: {}", run.path, key.name)}, make});
        }
    });
    faults.throw_if_any();
    for (const quasimc::TableSpec& table : run.output.tables) {
        requested.push_back({{table.file, table.location}, quasimc::make_table, &table});
    }
    return requested;
}

std::vector<quasimc::OutputPath> paths_of(
    const std::vector<RequestedOutput>& requested, const std::string& checkpoint) {
    std::vector<quasimc::OutputPath> paths;
    paths.reserve(requested.size());
    for (const RequestedOutput& output : requested) {
        paths.push_back(output.file);
    }
    refuse_checkpoint(checkpoint, paths);
    return paths;
}

}  // namespace

RunWriters::RunWriters(const RunArguments& arguments, const quasimc::RunFile& first)
    : RunWriters(arguments, first, requested_outputs(arguments, first)) {}

RunWriters::RunWriters(
    const RunArguments& arguments,
    const quasimc::RunFile& first,
    const std::vector<RequestedOutput>& requested)
    : files_(paths_of(requested, arguments.checkpoint), inputs_of(arguments, first)),
      summary_(first) {
    for (const auto& [file, make, table] : requested) {
        outputs_.push_back(
            make({first, files_.sink(outputs_.size()), file.path, file.where, table}));
    }
    if (arguments.from.empty()) {
        return;
    }
    const OutputChoice& choice = arguments.choice;
    const bool has_all_rows =
        choice.quantities.empty() && choice.bands.empty() && !choice.include_night;
    quasimc::TextSink compare;
    if (arguments.from != "-" && has_all_rows) {
        comparison_.emplace(arguments.from);
        compare = [this](std::string_view text) { comparison_->add(text); };
    }
    repeated_.emplace(first, compare);
}

template <typename Action>
void RunWriters::for_each_writer(Action action) {
    action(summary_);
    if (repeated_) {
        action(*repeated_);
    }
    for (std::size_t i = 0; i < outputs_.size(); ++i) {
        try {
            if (outputs_[i]) {
                action(*outputs_[i]);
            }
        } catch (const quasimc::InputError& error) {
            outputs_[i].reset();
            files_.give_up(i, error);
        }
    }
}

void RunWriters::on_time_step(const quasimc::TimeStepResult& step) {
    end_progress_line();
    for_each_writer([&](quasimc::OutputWriter& writer) {
        if (writer.wants(quasimc::SeriesPart::time_steps)) {
            writer.on_time_step(step);
        }
    });
}

void RunWriters::on_day(std::size_t day, const quasimc::SeriesSum& sum) {
    for_each_writer([&](quasimc::OutputWriter& writer) {
        if (writer.wants(quasimc::SeriesPart::days)) {
            writer.on_day(day, sum);
        }
    });
}

void RunWriters::on_sums(const quasimc::SeriesSums& sums) {
    for_each_writer([&](quasimc::OutputWriter& writer) {
        if (writer.wants(quasimc::SeriesPart::sums)) {
            writer.on_sums(sums);
        }
    });
}

bool RunWriters::wants(quasimc::SeriesPart part) const {
    return part == quasimc::SeriesPart::time_steps || (repeated_ && repeated_->wants(part)) ||
           std::any_of(outputs_.begin(), outputs_.end(), [&](const auto& writer) {
               return writer && writer->wants(part);
           });
}

void RunWriters::next_run(
    const quasimc::RunFile& run, const quasimc::SeriesSummary& series_summary) {
    for_each_writer([&](quasimc::OutputWriter& writer) { writer.next_run(run, series_summary); });
}

RunWriters::Repeated RunWriters::finish(const quasimc::SeriesSummary& series_summary) {
    for_each_writer([&](quasimc::OutputWriter& writer) { writer.finish(series_summary); });
    files_.commit();
    return {repeated_ ? repeated_->digest() : "", comparison_ ? comparison_->difference() : ""};
}

void RunWriters::print_summary(
    const quasimc::SeriesSummary& all, const std::string& comparison) const {
    const std::string text = summary_.text(all, files_.written()) + comparison;
    std::fputs(text.c_str(), files_.uses_standard_output() ? stderr : stdout);
}
