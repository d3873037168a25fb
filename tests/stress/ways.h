#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "quasimc/run_file.h"
#include "stress/nodes.h"
#include "stress/reference.h"

// A run file computed in every way.

namespace quasimc::stress {

/// A number of a run, and what the run says of its error.
struct Number {
    double mean = 0, error = 0;
    double low = 0, high = 0;  ///< 95 % interval
    bool is_known = false;     ///< whether this way computes it
};

/// What is compared of each organ and band.
inline constexpr std::array kComparedQuantities{
    Quantity::absorbed_flux, Quantity::incident_upper, Quantity::incident_lower,
    Quantity::incident_direct, Quantity::incident_scattered};

/// What was asked, read and checked, and what the reference needs if it can do it.
struct Case {
    RunFile run;
    std::optional<PlainScene> plain;
    /// Per number: what slips between triangles that touch, a millionth of what shines on the
    /// organ. No two numbers count as different that differ by less.
    std::vector<double> slips;
    /// Per number: the relative error that is left to rounding. Of needles, thinner than a
    /// thousandth of the scene, single precision leaves more.
    std::vector<double> roundings;
};
/// Case::slips and Case::roundings.
[[nodiscard]] std::vector<double> slips_of(const Node& document, const Scene& scene);
[[nodiscard]] std::vector<double> roundings_of(const Scene& scene);

/// @throws InputError  if the document is no run file
[[nodiscard]] Case make_case(const Node& document);

/// How a case is computed. `plain_paths` is light tracing with plain random numbers and rays that
/// try every triangle; `reference` shares nothing with the program's engine.
enum class Way {
    light_tracing,
    first_hits,
    from_organs,
    ray_bundles,
    automatic,
    plain_paths,
    reference
};
[[nodiscard]] std::string name_of(Way way);

struct Effort {
    std::uint64_t paths = 512;  ///< per replicate
    std::uint32_t replicates = 16;
    std::uint64_t seed = 1;
    unsigned threads = 1;
};

/// Of a close look, per replicate.
inline constexpr std::uint64_t kClosePaths = 2048;

/// What one way says of a case.
struct Answer {
    Way way = Way::light_tracing;
    double freedom = 15;  ///< of the errors
    std::vector<Number> numbers;
    std::optional<Result> result;  ///< of the program's own ways
};

/// The names of the numbers: "organ 2 incident_upper b0", ...
[[nodiscard]] std::vector<std::string> number_names(const Scene& scene);

/// Whether the program offers this way for the case without a warning: not from organs what lamps
/// repeat, nor by bundles what shines or has long patches.
[[nodiscard]] bool is_offered(const Case& it, Way way);

[[nodiscard]] Answer compute(const Case& it, Way way, const Effort& effort);

/// The ways that a case is compared in: each of the program's, and the best yardstick there is.
[[nodiscard]] std::vector<Way> ways_of(const Case& it);

}  // namespace quasimc::stress
