#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "solvers/solver.h"
#include "solvers/sum_meaning.h"

namespace quasimc {

/// One row of the catalogue: a way of computing.
struct SolverEntry {
    Method method;
    std::string_view name;     ///< as users write it: "first_hits"
    std::string_view summary;  ///< one line for the manual
    std::unique_ptr<Solver> (*make)(const SolverInput& input);
    SumMeaning (*meaning)(const PreparedScene& prepared, const RunSpec& spec);
    EscapedLight escaped = EscapedLight::summed;  ///< what it knows of light that leaves the scene
    /// Whether a first round of so many paths, and further ones of 1, 2, 4, ... times as many,
    /// bring the bits of a single round of all of them. Null: they never do.
    bool (*do_rounds_add_up)(const Scene& scene, std::uint64_t first_paths) = nullptr;
};

/// All solvers. Method::automatic is none of them.
[[nodiscard]] std::span<const SolverEntry> solver_catalogue();

/// The row of a method; null for Method::automatic.
[[nodiscard]] const SolverEntry* find_solver(Method method);

/// The solver of RunSpec::method, which must not be automatic.
[[nodiscard]] std::unique_ptr<Solver> make_solver(const SolverInput& input);

/// Sums of no paths yet, for the solver of the specification.
[[nodiscard]] Sums empty_sums(const PreparedScene& prepared, const RunSpec& spec);

}  // namespace quasimc
