// Results as files and as bytes.

#include <algorithm>
#include <memory>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include <pybind11/stl.h>

#include "bind.h"
#include "document.h"
#include "files/input_files.h"
#include "light/source_origins.h"
#include "quasimc/result_file.h"
#include "replicates.h"
#include "result.h"
#include "resultio/read_light.h"
#include "resultio/read_result.h"
#include "resultio/read_rows.h"
#include "run/evaluation_of.h"
#include "run/zero_result.h"
#include "runfile/run_file.h"
#include "scene.h"

namespace quasimc::python {
namespace {

RunFile run_of(const Document& document) {
    InputFiles files(document.folder);
    return read_run_document(document.node, document.name, files, {}, {}, NoLightPolicy::allowed);
}

/// The rows of a result in the order of a scene that has the same organs, by id.
class RowOrder {
  public:
    /// @throws InputError  if the scene has other organs
    RowOrder(const Result& result, const Scene& scene) {
        std::unordered_map<std::int64_t, std::size_t> rows;
        for (const Organ& organ : result.names->organs()) {
            rows.emplace(organ.id, rows.size());
        }
        for (const Organ& organ : scene.organs()) {
            const auto found = rows.find(organ.id);
            if (found == rows.end() || rows.size() != scene.organs().size()) {
                throw InputError(
                    {{"scene", "it would be read with other ids of organs",
                      "files have changed, or both files and meshes have no ids",
                      "give add_file(first_id=...) and add_mesh(organ=...)"}});
            }
            from_.push_back(found->second);
        }
        to_.resize(from_.size());
        for (std::size_t i = 0; i < from_.size(); ++i) {
            to_[from_[i]] = static_cast<std::uint32_t>(i);
        }
    }

    void apply(Result& result) const {
        const std::size_t row = kQuantities * result.bands;
        put(result.values, row);
        put(result.sunlit_fraction, result.sunlit_fraction.empty() ? 0 : 1);
        put(result.ratio_values, result.ratios);
        for (OrganGroup& group : result.groups.groups) {
            for (std::uint32_t& organ : group.organs) {
                organ = to_[organ];
            }
            std::ranges::sort(group.organs);
        }
        for (OriginLight& origin : result.origins) {
            apply(origin.light);
        }
    }

  private:
    void put(std::vector<Estimate>& values, std::size_t row) const {
        const std::vector<Estimate> old = values;
        for (std::size_t i = 0; row > 0 && i < from_.size(); ++i) {
            std::copy_n(old.begin() + from_[i] * row, row, values.begin() + i * row);
        }
    }

    std::vector<std::size_t> from_;
    std::vector<std::uint32_t> to_;
};

/// A result in a format of OutputWriter: "json", "csv".
py::bytes written(const Document& document, const Result& result, const std::string& format) {
    std::string text;
    {
        const py::gil_scoped_release release;
        const RunFile run = run_of(document);
        Result ordered = result;
        RowOrder(result, run.scene).apply(ordered);
        const TextSink sink = [&](std::string_view part) { text += part; };
        if (format == "csv") {
            write_csv(run, ordered, sink);
        } else {
            write_json(run, ordered, sink);
        }
    }
    return py::bytes(text);
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

py::tuple handles_of(RunFile& run, Result result, const py::object& rest) {
    SceneHandle scene{std::make_shared<const Scene>(std::move(run.scene)), std::move(run.warnings)};
    return py::make_tuple(
        std::move(scene), reported_result(std::move(result)), rest, run.source_notes,
        run.spec.ratios);
}

/// A JSON result: scene, light of organs, everything else as a dict, sources, names of ratios.
py::tuple read_stored(const std::string& text, const std::string& name, const std::string& folder) {
    Result light;
    Node rest;
    std::optional<RunFile> run;
    {
        const py::gil_scoped_release release;
        run.emplace(read_result_text(text, name, folder).runs.take(0));
        if (run->series) {
            throw InputError(
                {{name, "is a result of many times", "only results of one time can be opened",
                  "run its run file by quasimc.load"}});
        }
        const auto take = [&](std::size_t, const Result& result) { light = result; };
        read_light(text, name, *run, {.on_time_step = take, .on_day = {}});
        rest = read_rows(text, name, {.rest = RowsQuery::Rest::all}, {});
        light.groups.groups = make_groups(run->scene, group_spec(run->spec));
        light.groups.bands = light.bands;
    }
    return handles_of(*run, std::move(light), to_python(rest));
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
    const py::tuple handles = handles_of(*run, std::move(result), py::none());
    auto kept = std::make_shared<ReplicateSums>(ReplicateSums{
        handles[0].cast<const SceneHandle&>().scene, std::move(*sums), std::move(evaluation)});
    return py::make_tuple(handles[0], handles[1], handles[3], handles[4], std::move(kept));
}

}  // namespace

void bind_store(py::module_& module) {
    module.def("written", &written, py::arg("document"), py::arg("result"), py::arg("format"));
    module.def("written_scene", &written_scene, py::arg("document"));
    module.def("read_stored", &read_stored, py::arg("text"), py::arg("name"), py::arg("folder"));
    module.def("restored", &restored, py::arg("document"), py::arg("parts"));
    module.def(
        "saved_sums", [](const ReplicateSums& kept) { return py::bytes(save_sums(kept.sums)); });
}

}  // namespace quasimc::python
