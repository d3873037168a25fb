#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "coupling/lighting.h"
#include "coupling/protocol/messages.h"
#include "coupling/step_light.h"
#include "coupling/vlab/specification.h"

namespace quasimc {

/// One step, as input for its output files.
struct StepView {
    const Specification& spec;
    const Pass& pass;
    const Lighting& lighting;
    const StepLight& light;
    std::uint64_t step = 0;  ///< counted from 0
    /// The value that the return type of a band gives for a query, by its index in the pass.
    std::function<Estimate(std::uint32_t query, std::size_t band)> returned;
};

/// `name` with the number of the step before its extension: "light.dat" -> "light0012.dat".
[[nodiscard]] std::string numbered_name(const std::string& name, std::uint64_t step);

/// The table of a step: a header, then a line for each organ that asked, in the order of the
/// queries: area, mean projected area, sunlit and shaded part of it; for each band the mean of the
/// absorbed flux (or the quantity of the band's return type), the mean over the irradiance of the
/// horizontal, and the variance between runs (0 where it is unknown); with two bands their ratio
/// and its variance. The header has the column names of the original program.
[[nodiscard]] std::string variance_table(const StepView& view);

/// Writes variance_table: the first step to the file that the specification names, later ones (and
/// all if it names none) to numbered ones. @throws InputError  if it can't be written
void write_variance_file(const StepView& view);

/// Writes the organs of a step, coloured by the light they absorb per area in the first band, as a
/// PLY file: blue is dark, yellow the light that an organ facing all light absorbs. @throws
/// InputError
void write_picture_file(const StepView& view);

}  // namespace quasimc
