#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "quasimc/run_file.h"
#include "stress/nodes.h"
#include "stress/reference.h"

// The computation of a run file in every way.

namespace quasimc::stress {

/// A number of a run, with its reported error.
struct Number {
    double mean = 0, error = 0;
    double low = 0, high = 0;  ///< 95 % interval
    bool is_known = false;     ///< whether this way computes it
};

/// Quantities that are compared for each organ and band.
inline constexpr std::array kComparedQuantities{
    Quantity::absorbed_flux, Quantity::incident_upper, Quantity::incident_lower,
    Quantity::incident_direct, Quantity::incident_scattered};

/// A parsed and checked run file, and the scene of the reference if it supports it.
struct Case {
    RunFile run;
    std::optional<PlainScene> plain;
    /// Per number: the light that slips between triangles that touch, a millionth of the organ's
    /// incident light. Smaller differences are ignored.
    std::vector<double> slips;
    /// Per number: the relative error by rounding. It is larger for needles, thinner than a
    /// thousandth of the scene.
    std::vector<double> roundings;
};
/// Case::slips and Case::roundings.
[[nodiscard]] std::vector<double> slips_of(const Node& document, const Scene& scene);
[[nodiscard]] std::vector<double> roundings_of(const Scene& scene);

/// @throws InputError  if the document is no run file
[[nodiscard]] Case make_case(const Node& document);

/// Ways to compute a case. `plain_paths` is light tracing with random numbers and brute-force rays;
/// `reference` shares nothing with the program's engine.
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

/// Number of paths per replicate in a close test.
inline constexpr std::uint64_t kClosePaths = 2048;

/// The result of one way for a case.
struct Answer {
    Way way = Way::light_tracing;
    double freedom = 15;  ///< degrees of freedom of the errors
    std::vector<Number> numbers;
    std::optional<Result> result;  ///< for the program's own ways
};

/// The names of the numbers: "organ 2 incident_upper b0", ...
[[nodiscard]] std::vector<std::string> number_names(const Scene& scene);

/// Whether the program offers this way for the case without a warning: not paths from organs for
/// repeated lamps, nor bundles for surfaces that are not diffuse, or with long patches.
[[nodiscard]] bool is_offered(const Case& it, Way way);

[[nodiscard]] Answer compute(const Case& it, Way way, const Effort& effort);

/// The ways in which a case is compared: all of the program's, and the best available reference.
[[nodiscard]] std::vector<Way> ways_of(const Case& it);

}  // namespace quasimc::stress
