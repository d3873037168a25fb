#include "grow_outputs.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/text.h"
#include "grow_pictures.h"
#include "growth/turtle/plain_geometry.h"
#include "meshio/formats.h"
#include "numbered_path.h"
#include "resultio/field_formats.h"
#include "resultio/organ_table.h"
#include "shown_fields.h"
#include "text/little_endian.h"

namespace {

using quasimc::Scene;
using quasimc::TextSink;

/// The string as cpfg's option -strb writes it: parameters are numbers of 32 bits.
std::string binary_string(const quasimc::ModuleString& string, std::int64_t step) {
    std::string bytes;
    for (auto p = quasimc::ModuleString::begin(); p < string.end(); p = string.next(p)) {
        bytes += string.symbol(p);
        for (std::size_t i = 0; i < string.count(p); ++i) {
            bytes += i == 0 ? '(' : ',';
            quasimc::append_little_endian(bytes, string.parameter(p, i));
        }
        bytes += string.count(p) > 0 ? ")" : "";
    }
    return fmt::format("L-system string:{} {}\n", bytes.size(), step) + bytes;
}

std::string box_line(const quasimc::Bounds& box) {
    return fmt::format(
        "box: x: {:g},{:g} y: {:g},{:g} z: {:g},{:g}\n", box.low.x, box.high.x, box.low.y,
        box.high.y, box.low.z, box.high.z);
}

void write_drawing(GrownPlant& plant, const TextSink& sink) {
    quasimc::PlainGeometry drawing(plant.view());
    plant.plant().draw(drawing);
    sink(drawing.text());
}

/// The shapes of a plant. @throws InputError  if it has none
const Scene& shapes_of(GrownPlant& plant, const std::string& path) {
    if (!plant.scene()) {
        throw quasimc::InputError(
            {{path, fmt::format("the plant of step {} has no shape", plant.step()), "",
              "check the homomorphism of the model; --string writes the string"}});
    }
    return *plant.scene();
}

/// Writes the organs that have light, or without light those that are drawn.
void write_table(GrownPlant& plant, const std::string& path, const TextSink& sink) {
    const GrowEnvironment* lit = plant.lit();
    if (lit == nullptr || !lit->light().light->scene) {
        quasimc::write_organ_table(
            shapes_of(plant, path), {}, fmt::format("# step: {}\n", plant.step()), sink);
        return;
    }
    const quasimc::StepSnapshot light = lit->light();
    const Scene& scene = *light.light->scene;
    std::vector<std::uint32_t> organs(scene.organs().size());
    for (std::uint32_t i = 0; i < organs.size(); ++i) {
        organs[i] = i;
    }
    std::vector<quasimc::OrganColumn> columns;
    for (ShownValues& values : light_values(light, organs)) {
        columns.push_back({values.key, values.unit, std::move(values.estimates)});
    }
    const std::string comments = fmt::format(
        "# step: {}\n{}", lit->pass_step(),
        lit->has_stand() ? "" : "# column id: number of the query in its pass\n");
    quasimc::write_organ_table(scene, columns, comments, sink);
}

/// Writes the shapes with the light that belongs to them.
void write_lit_shapes(
    GrownPlant& plant,
    const quasimc::FieldFormat& format,
    const std::string& path,
    const TextSink& sink) {
    const Scene& scene = shapes_of(plant, path);
    std::vector<ShownValues> all;
    if (plant.has_own_light()) {
        all = light_values(plant.lit()->light(), plant.lit()->light_of(scene));
    }
    const auto colored = std::find_if(all.begin(), all.end(), [](const ShownValues& values) {
        return values.key.starts_with("absorbed_flux_density");
    });
    format.write(field_scene(scene, all, colored == all.end() ? nullptr : &*colored), sink);
}

/// The file of the flag -o, unless it is a picture.
/// @throws InputError  if no format has the end of its name
GrowOutput plant_output(const std::string& path, const std::string& where) {
    const std::string extension =
        quasimc::lower_case(std::filesystem::path(path).extension().string());
    GrowOutput output{{path, where}, {}, true};
    const quasimc::FieldFormat* fields = quasimc::field_format_of_path(path);
    const quasimc::FormatEntry* geometry = quasimc::format_of_path(path);
    const bool has_geometry = geometry != nullptr && geometry->write != nullptr;
    if (extension == ".csv") {
        output.write = [path](GrownPlant& plant, const TextSink& sink) {
            write_table(plant, path, sink);
        };
    } else if (fields != nullptr || has_geometry) {
        output.write = [=](GrownPlant& plant, const TextSink& sink) {
            if (fields != nullptr && (plant.has_own_light() || !has_geometry)) {
                write_lit_shapes(plant, *fields, path, sink);
            } else {
                quasimc::write_geometry(*geometry, shapes_of(plant, path), sink);
            }
        };
    } else {
        throw quasimc::InputError(
            {{where, fmt::format("'{}' is not a format that a plant can be written in", path),
              "the format follows from the end of its name",
              fmt::format("use {}, vtp, png, csv", fmt::join(quasimc::writable_formats(), ", "))}});
    }
    return output;
}

std::function<void(GrownPlant&, const TextSink&)> string_writer(bool homomorphism) {
    return [homomorphism](GrownPlant& plant, const TextSink& sink) {
        sink(plant.string(homomorphism).lines());
    };
}

/// The files of the folder of a series.
void add_series(const GrowArguments& arguments, std::vector<GrowOutput>& outputs) {
    const std::filesystem::path folder(arguments.series);
    const std::string shapes = (folder / "step_%03d.glb").string();
    outputs.push_back(
        {{shapes, "--series"},
         [shapes](GrownPlant& plant, const TextSink& sink) {
             quasimc::write_glb(shapes_of(plant, shapes), sink);
         },
         true});
    outputs.push_back(
        {{(folder / "step_%03d.txt").string(), "--series"}, string_writer(arguments.homomorphism)});
}

}  // namespace

std::vector<GrowOutput> grow_outputs(const GrowArguments& arguments) {
    std::vector<GrowOutput> outputs;
    const auto add = [&](const std::string& path, const char* where, auto write) {
        if (!path.empty()) {
            outputs.push_back({{path == "stdout" ? "-" : path, where}, std::move(write)});
        }
    };
    const bool homomorphism = arguments.homomorphism;
    add(arguments.string, "--string", string_writer(homomorphism));
    add(arguments.binary_string, "--string-binary",
        [homomorphism](GrownPlant& plant, const TextSink& sink) {
            sink(binary_string(plant.string(homomorphism), plant.step()));
        });
    add(arguments.box, "--box",
        [](GrownPlant& plant, const TextSink& sink) { sink(box_line(plant.bounds())); });
    add(arguments.drawing, "--drawing", write_drawing);
    if (!arguments.output.empty() && !is_picture_name(arguments.output)) {
        outputs.push_back(plant_output(arguments.output, "-o"));
    }
    if (!arguments.series.empty()) {
        add_series(arguments, outputs);
    }
    return outputs;
}

namespace {

/// Removes the outputs that are written at every step. @returns them
std::vector<GrowOutput> take_numbered(std::vector<GrowOutput>& outputs) {
    const auto first = std::stable_partition(
        outputs.begin(), outputs.end(),
        [](const GrowOutput& output) { return !numbered_path(output.file.path, 0); });
    std::vector<GrowOutput> numbered(
        std::make_move_iterator(first), std::make_move_iterator(outputs.end()));
    outputs.erase(first, outputs.end());
    return numbered;
}

std::vector<quasimc::OutputPath> paths_of(const std::vector<GrowOutput>& outputs) {
    std::vector<quasimc::OutputPath> paths;
    paths.reserve(outputs.size());
    for (const GrowOutput& output : outputs) {
        paths.push_back(output.file);
    }
    return paths;
}

/// A file that two outputs have in common in some step, if one is a file of each step.
std::optional<std::string> common_path(
    const GrowOutput& a, const GrowOutput& b, std::int64_t last_step) {
    constexpr std::int64_t kMaxChecked = 10'000;
    const auto path_of = [](const GrowOutput& output, std::int64_t step) {
        const std::string& path = output.file.path;
        return std::filesystem::path(numbered_path(path, step).value_or(path)).lexically_normal();
    };
    if (!numbered_path(a.file.path, 0) && !numbered_path(b.file.path, 0)) {
        return std::nullopt;  // OutputFiles reports it
    }
    for (std::int64_t step = 0; step <= std::min(last_step, kMaxChecked); ++step) {
        if (path_of(a, step) == path_of(b, step)) {
            return path_of(a, step).string();
        }
    }
    return std::nullopt;
}

}  // namespace

void check_numbered(const std::vector<GrowOutput>& outputs, std::int64_t last_step) {
    quasimc::Faults faults;
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        for (std::size_t j = i + 1; j < outputs.size(); ++j) {
            if (const auto path = common_path(outputs[i], outputs[j], last_step)) {
                faults.add(
                    {outputs[i].file.where,
                     fmt::format("'{}' is the file of another output", *path),
                     fmt::format("{} names it", outputs[j].file.where), "name another file"});
            }
        }
    }
    faults.throw_if_any();
}

GrowWriters::GrowWriters(std::vector<GrowOutput> outputs, std::vector<quasimc::InputFile> inputs)
    : of_steps_(take_numbered(outputs)),
      of_end_(std::move(outputs)),
      inputs_(std::move(inputs)),
      files_(paths_of(of_end_), inputs_) {}

void GrowWriters::write_step(GrownPlant& plant) const {
    for (const GrowOutput& output : of_steps_) {
        if (output.has_shapes && !plant.scene()) {
            continue;
        }
        quasimc::OutputFiles file(
            {{*numbered_path(output.file.path, plant.step()), output.file.where}}, inputs_);
        output.write(plant, file.sink(0));
        file.commit();
        file.throw_if_given_up();
    }
}

quasimc::Faults GrowWriters::finish(GrownPlant& plant) {
    quasimc::Faults faults;
    try {
        for (std::size_t i = 0; i < of_end_.size(); ++i) {
            try {
                of_end_[i].write(plant, files_.sink(i));
            } catch (const quasimc::InputError& error) {
                files_.give_up(i, error);
            }
        }
        files_.commit();
        faults.add(files_.faults());
    } catch (const quasimc::InputError& error) {
        faults.add(error);  // no file is left
    }
    return faults;
}
