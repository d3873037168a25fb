#include <cmath>

#include <fmt/format.h>

#include "meshio/caribu_files.h"
#include "runfile/run_file_source_kinds.h"

namespace quasimc {
namespace {

/// Passes the bytes of a file to a reader; empty after a fault.
template <typename Read>
auto read_caribu(
    TableReader& table, const std::string& file, const RunFileContext& context, const Read& read)
    -> std::optional<decltype(read(std::string_view(), table.reporter()))> {
    Reporter own{file, {}, {}};
    try {
        auto result = read(context.files->read(file), own);
        table.reporter().add(own);
        return own.faults.empty() ? std::optional(std::move(result)) : std::nullopt;
    } catch (const InputError& error) {
        table.fault_at(
            "file", fmt::format("file '{}' can't be read", file), error.faults().front().why);
        return std::nullopt;
    }
}

/// The optics of each band; empty after a fault.
std::optional<std::vector<CaribuOptics>> read_optics_of_bands(
    TableReader& table, const RunFileContext& context) {
    std::vector<CaribuOptics> bands;
    const auto nodes = nodes_per_band(table, "file", context.bands);
    for (const Node* node : nodes) {
        const auto* file = node->as<std::string>();
        if (file == nullptr) {
            table.fault_at(
                *node, fmt::format("file is {}", node->type_name()), "it must be a name");
            return std::nullopt;
        }
        auto optics = read_caribu(table, *file, context, read_caribu_optics);
        if (!optics) {
            return std::nullopt;
        }
        bands.push_back(std::move(*optics));
    }
    for (const CaribuOptics& band : bands) {
        if (band.species.size() != bands.front().species.size() ||
            band.soil.has_value() != bands.front().soil.has_value()) {
            table.fault("files of bands have other species", "", "give files of the same scene");
            return std::nullopt;
        }
    }
    return bands.empty() ? std::nullopt : std::optional(std::move(bands));
}

SideOptics side_of(const CaribuSide& side) {
    SideOptics optics;
    optics.reflectance = side.reflectance;
    optics.transmittance = side.transmittance;
    return optics;
}

std::vector<MaterialSpec> caribu_materials(const std::vector<CaribuOptics>& bands) {
    std::vector<MaterialSpec> materials;
    if (bands.front().soil) {
        MaterialSpec& soil = materials.emplace_back();
        soil.name = "soil";
        for (const CaribuOptics& band : bands) {
            soil.upper.push_back(side_of({*band.soil, 0}));
        }
        soil.lower = soil.upper;
    }
    for (std::size_t i = 0; i < bands.front().species.size(); ++i) {
        MaterialSpec stem, leaf;
        stem.name = fmt::format("stem {}", i + 1);
        leaf.name = fmt::format("leaf {}", i + 1);
        for (const CaribuOptics& band : bands) {
            stem.upper.push_back(side_of(band.species[i].stem));
            leaf.upper.push_back(side_of(band.species[i].upper));
            leaf.lower.push_back(side_of(band.species[i].lower));
        }
        stem.lower = stem.upper;
        materials.push_back(std::move(stem));
        materials.push_back(std::move(leaf));
    }
    return materials;
}

/// Adds a source for each line of a file of light.
void add_lights(
    TableReader& table,
    const std::string& file,
    const std::vector<CaribuLight>& lights,
    const std::vector<double>& irradiances,
    const RunFileContext& context,
    SourceList& list) {
    double sum = 0;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const Vec3 inward = context.orientation.inward(lights[i].travel);
        const double size = length(inward);
        if (!(size > 0) || !std::isfinite(size) || !(-inward.z / size > 1e-6)) {
            table.fault_at(
                "file", fmt::format("light {} of '{}' does not travel downwards", i + 1, file),
                "its irradiance is on the horizontal");
            return;
        }
        const Vec3 travel = normalized(inward / size);
        std::vector<double> facing;
        facing.reserve(irradiances.size());
        for (const double irradiance : irradiances) {
            facing.push_back(irradiance * lights[i].irradiance / -travel.z);
        }
        sum += lights[i].irradiance;
        list.sources.push_back(
            make_directional_source(fmt::format("{} {}", file, i + 1), travel, facing));
        list.hours.push_back(std::nullopt);
    }
    std::vector<double> whole = irradiances;
    for (double& irradiance : whole) {
        irradiance *= sum;
    }
    list.notes.push_back(fmt::format(
        "{}: {} directions; {} in all", file, lights.size(),
        format_irradiance("the horizontal", whole, context.bands)));
}

}  // namespace

void read_material_files(TableReader& top, RunFileContext& context, SceneBuilder& builder) {
    for (const Node* node : top.tables("material_file")) {
        TableReader table(*node, "material_file", *context.reporter);
        if (table.any("file") == nullptr) {
            table.missing("file", "name a file of Caribu's optics for all bands or one for each");
        }
        const auto bands = read_optics_of_bands(table, context);
        table.finish();
        if (bands && !table.failed()) {
            for (MaterialSpec& material : caribu_materials(*bands)) {
                context.materials.insert(material.name);
                builder.add_material(std::move(material), table.where());
            }
        }
    }
}

bool read_light_files(TableReader& top, const RunFileContext& context, SourceList& list) {
    const std::vector<const Node*> tables = top.tables("light_file");
    for (const Node* node : tables) {
        TableReader table(*node, "light_file", *context.reporter);
        const auto file = table.required("file", table.text("file"));
        const auto irradiances = table.required(
            "irradiance_horizontal",
            read_irradiances(table, "irradiance_horizontal", context.bands));
        table.finish();
        if (!file || !irradiances || table.failed()) {
            continue;
        }
        if (const auto lights = read_caribu(table, *file, context, read_caribu_light)) {
            add_lights(table, *file, *lights, *irradiances, context, list);
        }
    }
    return !tables.empty();
}

std::optional<std::array<double, 4>> read_pattern_file(
    TableReader& table, const RunFileContext& context) {
    const std::optional<std::string> file = table.text("file");
    if (!file) {
        return std::nullopt;
    }
    if (context.orientation.up() != UpAxis::z) {
        table.fault_at("file", "a pattern is of a scene with up = \"z\"");
        return std::nullopt;
    }
    const auto pattern = read_caribu(table, *file, context, read_caribu_pattern);
    return pattern ? *pattern : std::nullopt;
}

}  // namespace quasimc
