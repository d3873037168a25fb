#include <algorithm>
#include <array>
#include <map>

#include <fmt/format.h>

#include "base/text.h"
#include "optics/catalogue.h"
#include "runfile/run_file_sections.h"

namespace quasimc {
namespace {

constexpr Range kFraction{0, 1};

/// The name of a lobe model; empty after a fault.
std::optional<std::string> read_model(TableReader& table, std::string_view key, const Node& node) {
    const auto* text = node.as<std::string>();
    if (text == nullptr) {
        table.fault_at(node, fmt::format("{} is {}", key, node.type_name()), "it must be a name");
        return std::nullopt;
    }
    if (find_bsdf(*text) == nullptr) {
        const auto names = names_in(bsdf_catalogue());
        table.fault_at(
            node, fmt::format("{}: '{}' is not one of {}", key, *text, joined(names, ", ")), "",
            near_word_text(*text, names));
        return std::nullopt;
    }
    return *text;
}

std::optional<std::vector<std::string>> models_per_band(
    TableReader& table, std::string_view key, const std::vector<Band>& bands) {
    std::vector<std::string> models;
    for (const Node* node : nodes_per_band(table, key, bands)) {
        const std::optional<std::string> model = read_model(table, key, *node);
        if (!model) {
            return std::nullopt;
        }
        models.push_back(*model);
    }
    return models.empty() ? std::nullopt : std::optional(models);
}

/// The keys of one lobe, per band.
struct LobeKeys {
    std::optional<std::vector<double>> amount;
    std::optional<std::vector<std::string>> model;
    std::map<std::string_view, std::vector<double>> parameters;  ///< the given ones, by name
    friend bool operator==(const LobeKeys&, const LobeKeys&) = default;
};

struct SideKeys {
    LobeKeys reflection, transmission;
    friend bool operator==(const SideKeys&, const SideKeys&) = default;
};

/// Names of the keys of a lobe. Readers keep views of them.
struct LobeKeyNames {
    std::string_view amount;
    std::string model;
    std::vector<std::pair<std::string, BsdfParameter>> parameters;  ///< each with its key
};

/// @param word  "reflection" or "transmission"
LobeKeyNames names_of(std::string_view amount, std::string_view word) {
    LobeKeyNames names{amount, fmt::format("{}_model", word), {}};
    for (const BsdfParameter& p : parameters_of_all()) {
        names.parameters.emplace_back(fmt::format("{}_{}", word, p.name), p);
    }
    return names;
}

LobeKeys read_lobe(TableReader& table, const LobeKeyNames& names, const std::vector<Band>& bands) {
    LobeKeys keys;
    keys.amount = read_per_band(table, names.amount, bands, kFraction);
    keys.model = models_per_band(table, names.model, bands);
    for (const auto& [key, p] : names.parameters) {
        if (auto values = read_per_band(table, key, bands, {p.low, p.high})) {
            keys.parameters.emplace(p.name, std::move(*values));
        }
    }
    return keys;
}

SideKeys read_side(TableReader& table, const RunFileContext& context) {
    static const LobeKeyNames reflection = names_of("reflectance", "reflection");
    static const LobeKeyNames transmission = names_of("transmittance", "transmission");
    SideKeys keys{
        read_lobe(table, reflection, context.bands), read_lobe(table, transmission, context.bands)};
    for (auto* read : {read_spectral_optics, read_usual_optics}) {
        if (auto optics = read(table, context)) {
            if (keys.reflection.amount || keys.transmission.amount) {
                table.fault(
                    "its optics are given twice", "",
                    "use one of spectrum, optics, and reflectance with transmittance");
            }
            keys.reflection.amount = std::move(optics->reflectance);
            keys.transmission.amount = std::move(optics->transmittance);
        }
    }
    return keys;
}

LobeKeys overridden(LobeKeys common, const LobeKeys& side) {
    common.amount = side.amount ? side.amount : common.amount;
    if (side.model) {
        common.parameters.clear();  // another model has other parameters
        common.model = side.model;
    }
    for (const auto& [name, values] : side.parameters) {
        common.parameters[name] = values;
    }
    return common;
}

/// The lobe of one band.
struct BandLobe {
    double amount = 0;
    std::string model = "lambertian";
    BsdfParameters parameters;  ///< the parameters of the model
};

BandLobe lobe_of(const LobeKeys& keys, std::size_t band) {
    BandLobe lobe;
    lobe.amount = keys.amount ? (*keys.amount)[band] : 0;
    lobe.model = keys.model ? (*keys.model)[band] : lobe.model;
    const BsdfEntry& model = *find_bsdf(lobe.model);
    for (const auto& [name, values] : keys.parameters) {
        if (model.find_parameter(name) != nullptr) {
            lobe.parameters.emplace(name, values[band]);
        }
    }
    return lobe;
}

/// @param word  "reflection" or "transmission"
void check_parameters(TableReader& table, const LobeKeys& keys, std::string_view word) {
    const std::vector<std::string> models =
        keys.model.value_or(std::vector<std::string>(1, "lambertian"));
    for (const BsdfParameter& p : parameters_of_all()) {
        bool is_taken = false;
        bool is_needed = false;
        for (const std::string& model : models) {
            const BsdfParameter* own = find_bsdf(model)->find_parameter(p.name);
            is_taken = is_taken || own != nullptr;
            is_needed = is_needed || (own != nullptr && !own->usual);
        }
        const bool is_given = keys.parameters.count(p.name) > 0;
        if (is_needed && !is_given) {
            table.fault(
                fmt::format("{}_{} is missing", word, p.name),
                fmt::format("its {}_model takes one", word));
        }
        if (!is_taken && is_given) {
            table.fault(
                fmt::format("{}_{} is given", word, p.name),
                fmt::format("the model {} has no {}", models.front(), p.name),
                fmt::format("set {}_model, or leave the {} out", word, p.name));
        }
    }
}

void check_stated(TableReader& table, const SideKeys& keys) {
    if (!keys.reflection.amount && !keys.transmission.amount) {
        table.fault("reflectance is missing", "", "write reflectance = 0 for a black surface");
    }
}

/// Makes one side of a material. @param words  name of the side in messages, or ""
std::vector<SideOptics> make_side(
    TableReader& table,
    const SideKeys& keys,
    const std::vector<Band>& bands,
    std::string_view words) {
    std::vector<SideOptics> side;
    for (std::size_t b = 0; b < bands.size() && !table.failed(); ++b) {
        const BandLobe r = lobe_of(keys.reflection, b);
        const BandLobe t = lobe_of(keys.transmission, b);
        side.push_back({r.amount, t.amount, r.model, r.parameters, t.model, t.parameters});
        if (r.amount + t.amount > 1) {
            table.fault(fmt::format(
                "{}band {}: reflectance {} + transmittance {} exceeds 1", words, bands[b].name,
                r.amount, t.amount));
        }
    }
    return side;
}

SideKeys read_own_side(
    TableReader& material,
    std::string_view key,
    const SideKeys& common,
    const RunFileContext& context) {
    const Node* node = material.any(key);
    if (node == nullptr) {
        return common;
    }
    TableReader table(*node, fmt::format("{}: {} side", material.what(), key), material.reporter());
    const SideKeys side = read_side(table, context);
    table.finish();
    return {
        overridden(common.reflection, side.reflection),
        overridden(common.transmission, side.transmission)};
}

/// Warns of a material that is black without a reflectance.
void warn_of_black(
    TableReader& table, const MaterialSpec& spec, std::array<const SideKeys*, 2> sides) {
    const bool is_given = sides[0]->reflection.amount && sides[1]->reflection.amount;
    bool is_black = !is_given && !table.failed();
    for (const auto* side : {&spec.upper, &spec.lower}) {
        for (const SideOptics& optics : *side) {
            is_black = is_black && optics.reflectance == 0 && optics.transmittance == 0;
        }
    }
    if (is_black) {
        table.warn(fmt::format(
            "{} is black in every band: its reflectance is missing and 0 is used", table.what()));
    }
}

/// Makes a material; one with faults is black, to avoid a further fault that it does not exist.
MaterialSpec make_material_spec(
    TableReader& table,
    std::string name,
    const SideKeys& upper,
    const SideKeys& lower,
    const std::vector<Band>& bands) {
    const bool differ = !(upper == lower);
    for (const SideKeys* side : {&upper, &lower}) {
        if (!table.failed() && (side == &upper || differ)) {
            check_stated(table, *side);
            check_parameters(table, side->reflection, "reflection");
            check_parameters(table, side->transmission, "transmission");
        }
    }
    MaterialSpec spec{
        std::move(name), make_side(table, upper, bands, differ ? "upper side, " : ""), {}};
    spec.lower = differ ? make_side(table, lower, bands, "lower side, ") : spec.upper;
    warn_of_black(table, spec, {&upper, &lower});
    if (table.failed()) {
        spec.upper = spec.lower = std::vector<SideOptics>(bands.size());
    }
    return spec;
}

void read_material(const Node& node, RunFileContext& context, SceneBuilder& builder) {
    TableReader table(node, "material", *context.reporter);
    const std::optional<std::string> name = table.required("name", table.text("name"));
    if (name && name->empty()) {
        table.fault_at("name", "its name is empty");
    }
    table.rename(fmt::format("material '{}'", name.value_or("")));
    const SideKeys common = read_side(table, context);
    const SideKeys upper = read_own_side(table, "upper", common, context);
    const SideKeys lower = read_own_side(table, "lower", common, context);
    table.finish();

    MaterialSpec spec = make_material_spec(table, name.value_or(""), upper, lower, context.bands);
    if (!name || name->empty()) {
        return;
    }
    context.materials.insert(*name);
    builder.add_material(std::move(spec), table.where());
}

}  // namespace

void read_materials(TableReader& top, RunFileContext& context, SceneBuilder& builder) {
    for (const Node* node : top.tables("material")) {
        read_material(*node, context, builder);
    }
    read_material_files(top, context, builder);
}

}  // namespace quasimc
