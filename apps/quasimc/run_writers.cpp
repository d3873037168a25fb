#include "run_writers.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string_view>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "files/file_identity.h"
#include "progress.h"
#include "resultio/field_formats.h"
#include "resultio/series_words.h"
#include "runfile/output_files.h"

std::string flag_of(Output output) {
    std::string name = fmt::format("--{}", quasimc::kOutputFiles[output].key);
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
                {output.place, output.path + " is a file of the checkpoint", "",
                 "name another file"});
        }
    }
    faults.throw_if_any();
}

}  // namespace

/// Paths on the command line count from the current folder, and go before those of the run file.
RunWriters::Asked RunWriters::asked_outputs(
    const RunArguments& arguments, const quasimc::RunFile& run) {
    Asked asked;
    for (Output output = 0; output < kOutputs; ++output) {
        const quasimc::OutputFile& file = quasimc::kOutputFiles[output];
        const std::string& flag = arguments.outputs[output];
        const std::optional<std::string>& stated = run.output.*file.path;
        if (!flag.empty() || stated) {
            asked.numbers[output] = asked.paths.size();
            asked.paths.push_back(
                flag.empty()
                    ? quasimc::
                          OutputPath{*stated, fmt::format("{}: [output]: {}", run.path, file.key)}
                    : quasimc::OutputPath{flag, flag_of(output)});
        }
    }
    refuse_checkpoint(arguments.checkpoint, asked.paths);
    return asked;
}

RunWriters::RunWriters(const RunArguments& arguments, const quasimc::RunFile& first)
    : run_(&first),
      asked_(asked_outputs(arguments, first)),
      outputs_(asked_.paths, inputs_of(arguments, first)),
      summary_(first) {
    using quasimc::CsvRows, quasimc::CsvTimes;
    for (const auto& [output, rows, times] :
         {std::tuple(kCsv, CsvRows::organs, CsvTimes::moments),
          std::tuple(kDays, CsvRows::organs, CsvTimes::days),
          std::tuple(kGroups, CsvRows::groups, CsvTimes::moments),
          std::tuple(kGroupDays, CsvRows::groups, CsvTimes::days)}) {
        if (wants(output)) {
            tables_.emplace_back(first, sink_of(output), rows, times);
        }
    }
    if (wants(kPicture)) {
        const quasimc::OutputPath& file = asked_.paths[*asked_.numbers[kPicture]];
        picture_.emplace(first, file.path, file.place);
    }
    const OutputChoice& choice = arguments.choice;
    const bool has_all_rows = choice.quantities.empty() && choice.bands.empty() && !choice.night;
    if (wants_fields()) {
        fields_.emplace(first);
    }
    if (wants(kNetcdf)) {
        netcdf_.emplace(first, sink_of(kNetcdf));
    }
    if (!arguments.from.empty() && arguments.from != "-" && has_all_rows) {
        comparison_.emplace(arguments.from);
    }
    if (wants(kJson) || !arguments.from.empty()) {
        json_.emplace(first, json_sink());  // for the digest if for nothing else
    }
}

quasimc::TextSink RunWriters::json_sink() {
    quasimc::TextSink file = wants(kJson) ? sink_of(kJson) : quasimc::TextSink();
    if (!comparison_) {
        return file;
    }
    return [this, file = std::move(file)](std::string_view text) {
        comparison_->add(text);
        if (file) {
            file(text);
        }
    };
}

bool RunWriters::wants_total() const {
    return run_->series && (wants(kJson) || comparison_ || picture_ || fields_);
}

bool RunWriters::wants_days() const {
    return wants(kDays) || wants(kGroupDays) || (netcdf_ && run_->series) || wants_total();
}

template <typename Action>
void RunWriters::write_netcdf(Action action) {
    if (!netcdf_) {
        return;
    }
    try {
        action(*netcdf_);
    } catch (const quasimc::InputError& error) {
        netcdf_.reset();
        outputs_.give_up(*asked_.numbers[kNetcdf], error);
    }
}

void RunWriters::next_run(const quasimc::RunFile& run, const quasimc::SeriesSummary& summary) {
    run_ = &run;
    summary_.next_run(run, summary);
    const auto tell = [&](auto& writer) {
        if (writer) {
            writer->next_run(run);
        }
    };
    for (quasimc::CsvWriter& table : tables_) {
        table.next_run(run);
    }
    tell(picture_);
    tell(fields_);
    write_netcdf([&](quasimc::NetcdfWriter& netcdf) { netcdf.next_run(run); });
    write_json([&](auto& json) { json.next_run(run, summary); });
}

std::string RunWriters::finish(const quasimc::SeriesSummary& summary) {
    std::string digest;
    write_json([&](quasimc::JsonWriter& json) { digest = json.finish(summary); });
    if (picture_) {
        sink_of(kPicture)(picture_->draw(summary));
    }
    write_fields(summary);
    write_netcdf([](quasimc::NetcdfWriter& netcdf) { netcdf.finish(); });
    outputs_.commit();
    return digest;
}

bool RunWriters::wants_fields() const {
    return wants(kVtp) || wants(kPly) || wants(kGlb);
}

void RunWriters::write_fields(const quasimc::SeriesSummary& summary) {
    if (!fields_) {
        return;
    }
    const quasimc::FieldScene shown = fields_->shown(summary);
    for (const auto& [output, name] :
         {std::pair(kVtp, "vtp"), std::pair(kPly, "ply"), std::pair(kGlb, "glb")}) {
        if (!wants(output)) {
            continue;
        }
        try {
            quasimc::find_field_format(name)->write(shown, sink_of(output));
        } catch (const quasimc::InputError& error) {
            outputs_.give_up(*asked_.numbers[output], error);
        }
    }
}

std::string RunWriters::difference() {
    return comparison_ && json_ ? comparison_->difference() : "";
}

void RunWriters::print_summary(
    const quasimc::SeriesSummary& all, const std::string& comparison) const {
    const std::string text = summary_.text(all, outputs_.written()) + comparison;
    std::fputs(text.c_str(), outputs_.uses_standard_output() ? stderr : stdout);
}

template <typename Action>
void RunWriters::write_json(Action action) {
    if (!json_) {
        return;
    }
    try {
        action(*json_);
    } catch (const quasimc::InputError& error) {
        if (!wants(kJson)) {
            throw;
        }
        json_.reset();
        outputs_.give_up(*asked_.numbers[kJson], error);
    }
}

void RunWriters::on_time_step(const quasimc::TimeStepResult& step) {
    end_progress_line();
    summary_.add_moment(step.result);
    for (quasimc::CsvWriter& table : tables_) {
        table.add_moment(step.time_step, step.result);
    }
    if (picture_) {
        picture_->add_moment(step.result);
    }
    if (fields_) {
        fields_->add_moment(step.result);
    }
    write_netcdf(
        [&](quasimc::NetcdfWriter& netcdf) { netcdf.add_moment(step.time_step, step.result); });
    write_json([&](auto& json) { json.add_moment(step.time_step, step.result, step.computed); });
}

void RunWriters::on_day(std::size_t day, const quasimc::SeriesSum& sum) {
    for (quasimc::CsvWriter& table : tables_) {
        table.add_day(day, sum);
    }
    write_netcdf([&](quasimc::NetcdfWriter& netcdf) {
        netcdf.add_day(day, quasimc::in_summed_units(*run_, sum));
    });
    write_json([&](auto& json) { json.add_day(day, sum); });
}
