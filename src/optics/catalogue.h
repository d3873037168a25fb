#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "optics/bsdf.h"
#include "quasimc/material.h"

namespace quasimc {

/// The largest exponent that glossy models take: the lobe is then 0.1 degrees wide, less than the
/// sun. A narrower lobe is a mirror.
inline constexpr double kMaxExponent = 1e6;

/// One row of the table of lobe models.
struct BsdfEntry {
    std::string_view name;     ///< in run files: `reflection_model = "..."`
    std::string_view summary;  ///< one line for the manual
    std::span<const BsdfParameter> parameters;
    /// @param values  one for each of the parameters, in their order and domains
    std::unique_ptr<Bsdf> (*make)(Hemisphere hemisphere, std::span<const double> values);

    /// The parameter of that name, or null.
    [[nodiscard]] const BsdfParameter* find_parameter(std::string_view parameter) const;
};

/// All lobe models, in the order of the manual. A mirror's transmitted lobe goes straight on.
[[nodiscard]] std::span<const BsdfEntry> bsdf_catalogue();

/// The row of that name, or null.
[[nodiscard]] const BsdfEntry* find_bsdf(std::string_view name);

/// Every name of a parameter in a catalogue, once, with the widest domain that a model gives it.
[[nodiscard]] std::vector<BsdfParameter> parameters_of_all(
    std::span<const BsdfEntry> models = bsdf_catalogue());

/// The values of a model's parameters in the order of its row: the given ones, or else the
/// defaults; NaN for one that has neither. Parameters of other models are ignored.
[[nodiscard]] std::vector<double> parameter_values(
    const BsdfEntry& model, const BsdfParameters& given);

/// "exponent 0 ... 1000000" for the manual; "" for a model without parameters.
[[nodiscard]] std::string describe_parameters(const BsdfEntry& model);

}  // namespace quasimc
