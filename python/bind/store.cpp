// Results as files and as bytes.

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/stl.h>

#include "bind.h"
#include "control.h"
#include "document.h"
#include "files/input_files.h"
#include "light/source_origins.h"
#include "quasimc/lamp_control.h"
#include "quasimc/result_file.h"
#include "quasimc/run.h"
#include "record.h"
#include "replicates.h"
#include "result.h"
#include "resultio/describe_series.h"
#include "resultio/output_input.h"
#include "resultio/read_result.h"
#include "resultio/replay_result.h"
#include "run/evaluation_of.h"
#include "run/zero_result.h"
#include "runfile/run_file.h"
#include "runfile/sweep.h"
#include "runfile/written.h"
#include "scene.h"
#include "series/trace_spec.h"

namespace quasimc::python {
namespace {

/// The input files of a document; its run file is the first.
InputFiles files_of(const Document& document) {
    InputFiles files(document.folder);
    for (const InputFile& input : document.inputs) {
        files.note(input);
    }
    return files;
}

RunFile run_of(const Document& document) {
    InputFiles files = files_of(document);
    return read_run_document(document.node, document.name, files, {}, {}, NoLightPolicy::allowed);
}

/// The writer of a format: "json", "csv", or "table" for the first [[table]] of the run.
std::unique_ptr<OutputWriter> make_writer(
    const std::string& format, const RunFile& run, const TextSink& sink) {
    if (format == "table") {
        return make_table({run, sink, {}, {}, &run.output.tables.at(0)});
    }
    return format == "csv" ? make_csv({run, sink}) : make_json({run, sink});
}

/// A result in a format of make_writer().
py::bytes written(
    const Document& document, const std::shared_ptr<RunRecord>& record, const std::string& format) {
    std::string text;
    {
        const py::gil_scoped_release release;
        RunFile run = run_of(document);
        run.series = record->series;
        const auto writer = make_writer(format, run, [&](std::string_view part) { text += part; });
        writer->finish(replay(*record, run.scene, *writer));
    }
    return py::bytes(text);
}

/// Writes the results of all points of a sweep. @param format  of make_writer()
void write_sweep(
    const Document& document,
    const std::vector<std::shared_ptr<RunRecord>>& records,
    const std::string& format,
    const TextSink& sink) {
    RunSweep runs =
        read_sweep_document(document.node, document.name, [&] { return files_of(document); });
    std::unique_ptr<RunFile> run;
    std::unique_ptr<OutputWriter> writer;
    SeriesSummary last;
    for (std::size_t i = 0; i < records.size(); ++i) {
        auto next = std::make_unique<RunFile>(runs.take(i));
        next->series = records[i]->series;
        if (writer) {
            writer->next_run(*next, last);
        } else {
            writer = make_writer(format, *next, sink);
        }
        run = std::move(next);
        last = replay(*records[i], run->scene, *writer);
    }
    writer->finish(last);
}

py::bytes written_sweep(
    const Document& document,
    const std::vector<std::shared_ptr<RunRecord>>& records,
    const std::string& format) {
    std::string text;
    {
        const py::gil_scoped_release release;
        write_sweep(document, records, format, [&](std::string_view part) { text += part; });
    }
    return py::bytes(text);
}

/// The record of a run without time steps.
std::shared_ptr<RunRecord> record_of(
    const SceneHandle& scene, const std::shared_ptr<Result>& result) {
    auto record = std::make_shared<RunRecord>();
    record->scene = scene.scene;
    record->time_steps = record->computed = {0};
    record->results = {result};
    return record;
}

/// A scene without its light, as a JSON result of zeros.
py::bytes written_scene(const Document& document) {
    std::string text;
    {
        const py::gil_scoped_release release;
        const RunFile run = run_of(document);
        const TextSink sink = [&](std::string_view part) { text += part; };
        write_json(run, zero_result(run.scene, run.spec), sink);
    }
    return py::bytes(text);
}

py::tuple handles_of(RunFile& run, const py::object& core) {
    SceneHandle scene{std::make_shared<const Scene>(std::move(run.scene)), std::move(run.warnings)};
    return py::make_tuple(std::move(scene), core, run.source_notes, run.spec.ratios);
}

/// The only result of a record, or the record of a series.
py::object core_of(const std::shared_ptr<RunRecord>& record) {
    return record->series ? py::cast(record) : py::cast(record->results.at(0));
}

/// A document of a run. @param node  the run file, or that of a point of its sweep
Document document_of(const RunFile& run, Node node) {
    Document document{std::move(node), run.path, run.folder};
    std::ranges::copy_if(run.inputs, std::back_inserter(document.inputs), &InputFile::is_run_file);
    return document;
}

/// The document of a point of a sweep, or of the only run.
Document document_of_point(const RunFile& run) {
    Reporter reporter{run.path, {}, {}};
    const SweepPlan plan(*run.document, reporter);
    return document_of(run, plan.document_at(*run.document, run.point, reporter));
}

/// The selection of [output] as words; "" if all light is written.
std::string selection_of(const RunFile& run) {
    const WrittenColumns columns = written_columns(run);
    if (columns.is_all) {
        return "";
    }
    std::string names, bands;
    for (const QuantityEntry& entry : columns.quantities) {
        names += " " + std::string(entry.name);
    }
    for (const std::size_t b : columns.bands) {
        bands += " " + run.scene.bands()[b].name;
    }
    return "it holds the selection of [output] alone: quantities" + names + ", bands" + bands +
           "; all other light is nan";
}

/// A result of a file: the values of the points of its sweep (None without one), for each point or
/// the only run its scene, its result or series, sources, names of ratios and document; the
/// document of all; and selection_of().
py::tuple read_stored(const std::string& text, const std::string& name, const std::string& folder) {
    std::optional<StoredSweep> stored;
    std::optional<RunFile> first;
    std::optional<Recorder> recorder;
    {
        const py::gil_scoped_release release;
        stored.emplace(read_result_text(text, name, folder));
        first.emplace(stored->runs.take(0));
        recorder.emplace(*first);
        replay_result(text, name, stored->runs, *first, *recorder);
    }
    py::list runs, points;
    const Document whole = document_of(*first, *first->document);
    const std::string selection = selection_of(*first);
    for (std::size_t i = 0; i < recorder->runs().size(); ++i) {
        RunFile run = i == 0 ? std::move(*first) : stored->runs.take(i);
        py::dict point;
        for (const SweptValue& value :
             run.sweep ? (*run.sweep)[i].values : std::vector<SweptValue>()) {
            point[py::str(value.key)] = to_python(*value.value);
        }
        points.append(point);
        const Document document = document_of_point(run);
        runs.append(handles_of(run, core_of(recorder->runs()[i])) + py::make_tuple(document));
    }
    const bool is_sweep = py::len(points[0]) > 0;
    return py::make_tuple(is_sweep ? py::object(points) : py::none(), runs, whole, selection);
}

/// The result of kept sums, as the run had it, and the sums.
/// @param parts  the sums, or shares of them that add up to all
py::tuple restored(const Document& document, const std::vector<std::string>& parts) {
    std::optional<RunFile> run;
    std::optional<Sums> sums;
    Result result;
    {
        const py::gil_scoped_release release;
        run.emplace(run_of(document));
        sums.emplace(load_sums(parts.at(0)));
        for (std::size_t i = 1; i < parts.size(); ++i) {
            sums->add_share(load_sums(parts[i]));
        }
        run->spec.origins = complete_origins(run->sources, run->spec.origins);
        result = evaluate_run(*sums, run->scene, run->spec, run->sources);
        add_sunlit_of_hidden_suns(run->scene, run->sources, result);
    }
    EvaluationSpec evaluation = evaluation_of(run->scene, run->sources, run->spec);
    const py::tuple handles = handles_of(*run, py::cast(reported_result(std::move(result))));
    auto kept = std::make_shared<ReplicateSums>(ReplicateSums{
        handles[0].cast<const SceneHandle&>().scene, std::move(*sums), std::move(evaluation)});
    return handles + py::make_tuple(std::move(kept));
}

/// The origin that is the light of the lamps of a control and of nothing else; "" if there is none.
std::string origin_of(const RunFile& run, const LampControl& control) {
    const Sources sources = sources_of(run.series->time_steps);
    const SourceOrigins origins = source_origins(sources, run.spec.origins);
    std::set<std::size_t> own, others;
    for (std::size_t s = 0; s < sources.size() && !origins.names.empty(); ++s) {
        (controls(control, *sources[s]) ? own : others).insert(origins.of_source[s]);
    }
    const bool is_alone = own.size() == 1 && !others.contains(*own.begin());
    return is_alone ? origins.names[*own.begin()] : "";
}

/// Decides the factors of a document's only control, for which the light at its sensors is
/// computed: its outcome, and the origin of its lamps.
py::dict controlled(const Document& document) {
    std::optional<RunFile> run;
    std::string origin;
    {
        const py::gil_scoped_release release;
        run.emplace(run_of(document));
        TimeSeries& series = *run->series;
        Simulator simulator;
        series.outcomes = in_summed_units(
            run->scene.bands(), series.controls,
            control_lamps(
                {run->scene, run->sources, run->spec, series.controls}, simulator,
                series.time_steps));
        origin = origin_of(*run, series.controls.at(0));
    }
    py::dict own = controls_of(*run->series, run->scene)[0];
    own["origin"] = origin;
    return own;
}

}  // namespace

void bind_store(py::module_& module) {
    module.def("written", &written, py::arg("document"), py::arg("record"), py::arg("format"));
    module.def(
        "written_sweep", &written_sweep, py::arg("document"), py::arg("records"),
        py::arg("format"));
    module.def("controlled", &controlled, py::arg("document"));
    module.def("record_of", &record_of, py::arg("scene"), py::arg("result"));
    module.def("written_scene", &written_scene, py::arg("document"));
    module.def("read_stored", &read_stored, py::arg("text"), py::arg("name"), py::arg("folder"));
    module.def("restored", &restored, py::arg("document"), py::arg("parts"));
    module.def(
        "saved_sums", [](const ReplicateSums& kept) { return py::bytes(save_sums(kept.sums)); });
}

}  // namespace quasimc::python
