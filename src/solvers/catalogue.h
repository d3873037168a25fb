#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "solvers/solver.h"
#include "solvers/sum_meaning.h"

namespace quasimc {

/// One row of the catalogue: a method.
struct SolverEntry {
    Method method;
    std::string_view name;     ///< in run files: "first_hits"
    std::string_view summary;  ///< one line for the manual
    std::unique_ptr<Solver> (*make)(const SolverInput& input);
    SumMeaning (*meaning)(const PreparedScene& prepared, const RunSpec& spec);
    EscapedLight escaped = EscapedLight::summed;  ///< how escaped light is obtained
    /// Whether a first round of `first_paths` paths, and further rounds of 1, 2, 4, ... times as
    /// many, give the same bits as a single round of all paths. Null: they never do.
    bool (*do_rounds_add_up)(const Scene& scene, std::uint64_t first_paths) = nullptr;
};

/// All solvers, without Method::automatic.
[[nodiscard]] std::span<const SolverEntry> solver_catalogue();

/// The row of a method; null for Method::automatic.
[[nodiscard]] const SolverEntry* find_solver(Method method);

/// The solver of RunSpec::method, which must not be automatic.
[[nodiscard]] std::unique_ptr<Solver> make_solver(const SolverInput& input);

/// Sums of no paths yet, for the solver of the specification.
[[nodiscard]] Sums empty_sums(const PreparedScene& prepared, const RunSpec& spec);

}  // namespace quasimc
