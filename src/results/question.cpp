#include "results/question.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "results/bounds/organ_contributions.h"
#include "results/groups.h"

namespace quasimc {
namespace {

constexpr std::string_view kAutomatic = "auto";
constexpr std::string_view kSunlit = "sunlit_fraction";

const QuantityRow* row_of(std::string_view quantity) {
    const auto* found = std::find_if(
        kQuantityRows.begin(), kQuantityRows.end(),
        [&](const QuantityRow& row) { return row.entry.name == quantity; });
    return found == kQuantityRows.end() ? nullptr : found;
}

bool is_absorbed(std::string_view quantity) {
    const QuantityRow* row = row_of(quantity);
    return row != nullptr && row->parts.is_absorbed;
}

/// The quantity that is asked for sets with organs, or for sets of sensors.
AskedQuantity asked_quantity(std::string_view quantity, bool are_sensors) {
    if (quantity == kSunlit) {
        return {.is_sunlit = true};
    }
    if (quantity == kAutomatic && are_sensors) {
        return {.parts = kIncidentLight};
    }
    const QuantityRow* row = row_of(quantity);
    const QuantityRow& own = row != nullptr ? *row : kQuantityRows.front();
    return {.parts = own.parts, .is_flux = own.entry.is_flux};
}

/// Whether the light of an organ is asked for, alone or in a sum.
bool is_asked(const Scene& scene, const Organ& organ, TargetScope scope) {
    const bool fits = scope == TargetScope::automatic ||
                      (scope == TargetScope::sensors) == is_sensor(scene, organ);
    return organ.measured && fits && !(scope == TargetScope::total && organ.is_ground);
}

/// The light of sets with organs that absorb, and of sets of sensors alone.
struct AskedKinds {
    AskedLight organs, sensors;
};

void add_set(const Scene& scene, std::span<const std::uint32_t> set, AskedKinds& kinds) {
    const auto is_own_sensor = [&](std::uint32_t i) { return is_sensor(scene, scene.organs()[i]); };
    const auto is_reached = [&](std::uint32_t i) {
        const Organ& organ = scene.organs()[i];
        return organ.covered_area < kFullyLit * organ.area;
    };
    AskedLight& own =
        std::all_of(set.begin(), set.end(), is_own_sensor) ? kinds.sensors : kinds.organs;
    const std::size_t before = own.organs.size();
    std::copy_if(set.begin(), set.end(), std::back_inserter(own.organs), is_reached);
    if (own.organs.size() > before) {
        own.ends.push_back(own.organs.size());
    }
}

void add_single_organs(const Scene& scene, TargetScope scope, AskedKinds& kinds) {
    const auto& organs = scene.organs();
    const bool is_ground_alone = std::none_of(organs.begin(), organs.end(), [&](const Organ& o) {
        return is_asked(scene, o, scope) && !o.is_ground;
    });
    for (std::uint32_t i = 0; i < organs.size(); ++i) {
        if (is_asked(scene, organs[i], scope) && (!organs[i].is_ground || is_ground_alone)) {
            add_set(scene, {&i, 1}, kinds);
        }
    }
}

void add_groups(const Scene& scene, const EvaluationSpec& spec, AskedKinds& kinds) {
    for (const OrganGroup& group : make_groups(scene, spec.groups)) {
        const bool is_total = group.by == kAllOrgans;
        if (is_total == (spec.question.scope == TargetScope::total)) {
            add_set(scene, group.organs, kinds);
        }
    }
}

void check_scope(const Scene& scene, const RunSpec& spec, Faults& faults) {
    const bool has_groups = !spec.groups.empty() || spec.layers > 0 || !spec.layer_heights.empty();
    if (spec.target == TargetScope::groups && !has_groups) {
        faults.add({"target", "\"groups\", but there are none", "", "set groups or layers"});
    }
    const auto& organs = scene.organs();
    const bool has_light = spec.target == TargetScope::groups ||
                           (spec.target == TargetScope::sensors && !scene.sensors().empty()) ||
                           (spec.target == TargetScope::automatic && spec.target_error == 0) ||
                           std::any_of(organs.begin(), organs.end(), [&](const Organ& organ) {
                               return is_asked(scene, organ, spec.target);
                           });
    if (!has_light) {
        const bool are_sensors = spec.target == TargetScope::sensors;
        faults.add(
            {spec.target == TargetScope::automatic ? "target_error" : "target",
             are_sensors ? "\"sensors\", but there are none" : "no organ is measured", "",
             are_sensors ? "add sensors" : ""});
    }
}

void check_quantity(const RunSpec& spec, Faults& faults) {
    const std::vector<std::string_view> names = target_quantities();
    if (std::find(names.begin(), names.end(), spec.target_quantity) == names.end()) {
        faults.add(
            {"target_quantity", fmt::format("'{}' is not a quantity", spec.target_quantity), "",
             near_word_text(spec.target_quantity, names)});
    }
    if (spec.target == TargetScope::sensors && is_absorbed(spec.target_quantity)) {
        faults.add(
            {"target_quantity", fmt::format("{} of sensors", spec.target_quantity),
             "sensors absorb nothing", "use incident_upper"});
    }
}

}  // namespace

void check_band(
    const Scene& scene, const std::string& where, const std::string& name, Faults& faults) {
    std::vector<std::string_view> names;
    for (const Band& band : scene.bands()) {
        names.push_back(band.name);
    }
    if (std::find(names.begin(), names.end(), name) == names.end()) {
        faults.add(
            {where, fmt::format("'{}' is not a band (bands: {})", name, joined(names, ", ")), "",
             near_word_text(name, names)});
    }
}

std::vector<std::string_view> target_quantities() {
    std::vector<std::string_view> names{kAutomatic};
    for (const QuantityEntry& entry : quantity_table()) {
        names.push_back(entry.name);
    }
    names.push_back(kSunlit);
    return names;
}

Question question_of(const Scene& scene, const RunSpec& spec) {
    Question question{.scope = spec.target, .quantity = spec.target_quantity};
    for (const std::string& name : spec.target_bands) {
        question.bands.push_back(scene.names()->band_index(name));
    }
    return question;
}

void check_target(const Scene& scene, const RunSpec& spec, Faults& faults) {
    check_scope(scene, spec, faults);
    check_quantity(spec, faults);
    for (const std::string& name : spec.target_bands) {
        check_band(scene, "target_bands", name, faults);
    }
}

std::vector<AskedLight> asked_light(const Scene& scene, const EvaluationSpec& spec) {
    const Question& question = spec.question;
    AskedKinds kinds;
    kinds.organs.quantity = asked_quantity(question.quantity, false);
    kinds.sensors.quantity = asked_quantity(question.quantity, true);
    if (question.scope == TargetScope::groups || question.scope == TargetScope::total) {
        add_groups(scene, spec, kinds);
    } else {
        add_single_organs(scene, question.scope, kinds);
    }
    std::vector<AskedLight> asked;
    for (AskedLight* kind : {&kinds.organs, &kinds.sensors}) {
        const bool is_nothing = kind == &kinds.sensors && kind->quantity.parts.is_absorbed;
        if (kind->sets() > 0 && !is_nothing) {
            asked.push_back(std::move(*kind));
        }
    }
    return asked;
}

std::vector<std::size_t> AskedReader::bands() const {
    std::vector<std::size_t> bands = spec_.question.bands;
    if (asked_.quantity.is_sunlit) {
        return {0};
    }
    if (bands.empty()) {
        bands.resize(sums_->bands());
        std::iota(bands.begin(), bands.end(), std::size_t{0});
    }
    return bands;
}

double AskedReader::area_of(std::size_t set) const {
    double sum = 0;
    for (const std::uint32_t organ : asked_.set(set)) {
        sum += scene_.organs()[organ].area;
    }
    return sum;
}

double AskedReader::unit_of(std::size_t set) const {
    return asked_.quantity.is_flux ? 1 : 1 / area_of(set);
}

std::vector<double> AskedReader::values(std::size_t set, std::size_t band) const {
    const AskedQuantity& quantity = asked_.quantity;
    const bool has_sun = sums_->units.sunlit_area > 0;
    const double unit = unit_of(set);
    std::vector<double> values(sums_->replicates.size());
    for (std::uint32_t r = 0; r < values.size(); ++r) {
        for (const std::uint32_t organ : asked_.set(set)) {
            const OrganReader reader = reader_of(organ);
            if (!quantity.is_sunlit) {
                values[r] += reader.incident(r, band).of(quantity.parts);
            } else if (has_sun) {
                values[r] += reader.sunlit_area(r);
            }
        }
        values[r] *= unit;
    }
    return values;
}

Estimate AskedReader::estimate(
    std::size_t set, std::size_t band, std::span<const double> values) const {
    if (asked_.quantity.is_sunlit && !(sums_->units.sunlit_area > 0)) {
        return {};
    }
    OrganContributions contributions;
    for (const std::uint32_t organ : asked_.set(set)) {
        const OrganReader reader = reader_of(organ);
        contributions.include(
            asked_.quantity.is_sunlit ? OrganContributions::sunlit(reader)
                                      : OrganContributions(reader, band));
    }
    return asked_.quantity.is_sunlit
               ? contributions.estimate_sunlit(area_of(set), values)
               : contributions.estimate(asked_.quantity.parts, unit_of(set), values);
}

}  // namespace quasimc
