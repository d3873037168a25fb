// Reads [[gap_fraction]]: positions from which gaps of the canopy are measured.

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "results/organ_values.h"
#include "results/where_expression.h"
#include "runfile/copies.h"
#include "runfile/run_file_sections.h"

namespace quasimc {
namespace {

std::optional<std::vector<double>> read_rings(TableReader& table) {
    const Node* node = table.any("rings_deg");
    if (node == nullptr) {
        return std::nullopt;
    }
    const auto* list = node->as<Node::List>();
    if (list == nullptr) {
        table.fault_at(
            *node, "rings_deg is not a list", "it has the bounds of rings, degrees from the zenith",
            "for example [0, 13, 28, 43, 58, 74]");
        return std::nullopt;
    }
    std::vector<double> rings;
    for (const Node& item : *list) {
        if (const auto angle = table.real_at("rings_deg", item, {0, 90})) {
            rings.push_back(*angle);
        }
    }
    return rings;
}

std::uint32_t read_count(
    TableReader& table, std::string_view key, double most, std::uint32_t usual) {
    return static_cast<std::uint32_t>(table.integer(key, {1, most}).value_or(usual));
}

/// A seed may be any whole number that TOML has.
std::uint64_t read_seed(TableReader& table, std::uint64_t usual) {
    const auto seed = table.integer("seed", {0, 9.2e18});
    return seed ? static_cast<std::uint64_t>(*seed) : usual;
}

std::optional<GapFractionSpec> read_gap_fraction(const Node& node, RunFileContext& context) {
    TableReader table(node, "gap_fraction", *context.reporter);
    GapFractionSpec spec;
    spec.name = table.text("name").value_or(spec.name);
    table.rename(fmt::format("gap_fraction '{}'", spec.name));
    if (const auto at = table.required("at", read_copies(table, spec.name, context))) {
        for (const Copy& copy : *at) {
            spec.positions.push_back(copy.row.position);
        }
    }
    spec.rings_deg = read_rings(table).value_or(spec.rings_deg);
    spec.azimuths = read_count(table, "azimuths", kMaxGapAzimuths, spec.azimuths);
    spec.rays = read_count(table, "rays", kMaxGapRays, spec.rays);
    spec.replicates = read_count(table, "replicates", kMaxGapReplicates, spec.replicates);
    spec.seed = read_seed(table, spec.seed);
    if (const auto where = read_where(table, "where")) {
        spec.where = where->text();
    }
    spec.location = fmt::format("{}: {}", table.where(), table.what());
    table.finish();
    return table.failed() ? std::nullopt : std::optional(std::move(spec));
}

/// Whether any organ fulfils the condition on those that block.
bool is_fulfilled(const Scene& scene, const std::string& condition) {
    const OrganValues values(scene, {});
    const WhereExpression where(condition);
    return std::ranges::any_of(scene.organs(), [&](const Organ& organ) {
        return !organ.is_ground && values.holds(where, organ);
    });
}

}  // namespace

void check_gaps(
    const Scene* scene,
    const std::vector<GapFractionSpec>& specs,
    Faults& faults,
    std::vector<Warning>& warnings) {
    for (const GapFractionSpec& spec : specs) {
        const std::size_t before = faults.size();
        if (scene == nullptr) {
            check_gap_keys(spec, faults);
            continue;
        }
        check_gap_fraction(*scene, spec, faults);
        if (faults.size() == before && !spec.where.empty() && !is_fulfilled(*scene, spec.where)) {
            warnings.push_back(
                {spec.location, fmt::format("where: no organ fulfils \"{}\"", spec.where)});
        }
    }
}

std::vector<GapFractionSpec> read_gap_fractions(TableReader& top, RunFileContext& context) {
    std::vector<GapFractionSpec> specs;
    for (const Node* node : top.tables("gap_fraction")) {
        std::optional<GapFractionSpec> spec = read_gap_fraction(*node, context);
        if (!spec) {
            continue;
        }
        const bool is_known = std::any_of(specs.begin(), specs.end(), [&](const auto& other) {
            return other.name == spec->name;
        });
        if (is_known) {
            context.reporter->fault(
                node->line, fmt::format("gap_fraction '{}' exists already", spec->name),
                "names identify their rows", "give it a name");
        }
        specs.push_back(std::move(*spec));
    }
    return specs;
}

}  // namespace quasimc
