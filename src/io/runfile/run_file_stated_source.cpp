// Sources of the kinds that the catalogue tells all of: keys, amount of light, how to make one.

#include <fmt/format.h>

#include "base/text.h"
#include "io/runfile/run_file_source_kinds.h"

namespace quasimc {
namespace {

/// The value of each key of the row; those of keys with faults are left out.
void read_keys(
    const SourceEntry& kind,
    TableReader& table,
    const RunFileContext& context,
    StatedSource& stated) {
    for (const SourceKey& key : kind.keys) {
        if (key.type == SourceKeyType::number) {
            auto value = table.real(key.name, {key.low, key.high});
            if (!value && key.usual && table.any(key.name) == nullptr) {
                value = key.usual;
            }
            if (table.required(key.name, value)) {
                stated.numbers[key.name] = *value;
            }
        } else if (key.type == SourceKeyType::position) {
            if (const auto value = table.required(key.name, table.vector(key.name))) {
                stated.vectors[key.name] = context.orientation.inward(*value);
            }
        } else if (const auto value = read_direction(table, key.name, std::nullopt, context)) {
            stated.vectors[key.name] = *value;
        }
    }
}

std::optional<std::vector<double>> read_amount(
    const SourceEntry& kind, TableReader& table, const RunFileContext& context) {
    if (kind.amount == SourceAmount::flux) {
        return read_flux(table, context);
    }
    const std::string_view key = kind.amount == SourceAmount::irradiance_facing
                                     ? "irradiance_facing"
                                     : "irradiance_horizontal";
    return table.required(key, read_irradiances(table, key, context.bands));
}

std::string amount_words(
    const SourceEntry& kind, const std::vector<double>& amount, const RunFileContext& context) {
    if (kind.amount == SourceAmount::flux) {
        return flux_words(amount, context);
    }
    return irradiance_words(
        kind.amount == SourceAmount::irradiance_facing ? "plane facing it" : "horizontal", amount,
        context.bands);
}

/// ", sharpness 2, position (0, 0, 3)"
std::string key_words(
    const SourceEntry& kind, const StatedSource& stated, const RunFileContext& context) {
    std::string words;
    for (const SourceKey& key : kind.keys) {
        const bool is_number = key.type == SourceKeyType::number;
        words += fmt::format(
            ", {} {}", key.name,
            is_number ? shortest(stated.numbers.at(key.name))
                      : vector_words(context.orientation.outward(stated.vectors.at(key.name))));
    }
    return words;
}

}  // namespace

std::optional<NotedSource> read_stated_source(
    const SourceEntry& kind,
    TableReader& table,
    const std::string& name,
    const RunFileContext& context) {
    StatedSource stated{name, {}};
    read_keys(kind, table, context, stated);
    const auto amount = read_amount(kind, table, context);
    if (!amount || stated.numbers.size() + stated.vectors.size() < kind.keys.size()) {
        return std::nullopt;
    }
    stated.spectrum = *amount;
    std::string note = fmt::format(
        "{}: {}{}, {}", name, kind.words, key_words(kind, stated, context),
        amount_words(kind, *amount, context));
    return NotedSource{kind.make(stated), std::move(note)};
}

}  // namespace quasimc
