#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "results/audit.h"
#include "results/detector_result.h"
#include "solvers/run_spec.h"
#include "sums/statistics.h"

namespace quasimc {

/// What is reported for each organ and band. Densities are per one-sided area of the organ.
enum class Quantity {
    absorbed_flux,  ///< irradiance unit x area unit
    absorbed_flux_density,
    incident_upper,  ///< light that falls on the upper side / area
    incident_lower,
    incident_direct,     ///< both sides, straight from the sources / area
    incident_scattered,  ///< both sides, after at least one organ / area
};
inline constexpr std::size_t kQuantities = 6;

/// One row of the table of quantities.
struct QuantityEntry {
    Quantity quantity;
    std::string_view name;     ///< "absorbed_flux"
    std::string_view summary;  ///< one line for the manual
    bool is_flux;              ///< unit x area, otherwise per area
};
[[nodiscard]] const std::array<QuantityEntry, kQuantities>& quantity_table();

/// Where the light of one band went, flux. emitted + roulette = absorbed_by_organs +
/// absorbed_by_ground + escaped + cut_off to rounding. `roulette` is what Russian roulette added
/// less what it took: its mean is 0. Tracing from organs gives emitted and absorbed; escaped is
/// then the rest, and says so.
struct BandBudget {
    double emitted = 0;
    Estimate absorbed_by_organs, absorbed_by_ground, escaped, cut_off, roulette;
    /// |emitted + roulette - absorbed - escaped - cut off| / emitted.
    double closure_error = 0;
};

/// Why no further round was traced. time_is_up and path_limit: the target, if one was set, was
/// missed.
enum class StopReason { paths_done, target_reached, time_is_up, path_limit };

struct Result {
    std::size_t bands = 0;
    std::size_t ratios = 0;
    /// [(organ * kQuantities + quantity) * bands + band], organs in the scene's order; see at().
    std::vector<Estimate> values;
    /// Per organ: fraction of the one-sided area lit straight by the directional sources (their
    /// mean weighted by irradiance); empty when there are none. A leaf whose sides are lit by two
    /// suns counts for each.
    std::vector<Estimate> sunlit_fraction;
    /// [organ * ratios + i], i as in RunSpec::ratios.
    std::vector<Estimate> ratio_values;
    std::vector<BandBudget> budget;  ///< per band
    bool escaped_is_remainder = false;
    std::vector<DetectorResult> detectors;  ///< in the order of Scene::detectors()

    ChosenMethod chosen;
    std::optional<Audit> audit;  ///< if RunSpec::audit asked for one
    std::uint64_t paths = 0;     ///< per replicate, all rounds
    std::uint32_t replicates = 0;
    std::uint64_t rays = 0;  ///< all replicates
    StopReason stop = StopReason::paths_done;
    double fraction_at_target = 0;  ///< of the organs; 0 when no target was set
    double build_seconds = 0;       ///< acceleration structure, wall
    double trace_seconds = 0;       ///< wall
    double trace_cpu_seconds = 0;   ///< all threads

    [[nodiscard]] std::size_t organs() const { return values.size() / (kQuantities * bands); }
    [[nodiscard]] const Estimate& at(std::size_t organ, Quantity q, std::size_t band) const {
        return values[(organ * kQuantities + static_cast<std::size_t>(q)) * bands + band];
    }
    [[nodiscard]] const Estimate& ratio(std::size_t organ, std::size_t i) const {
        return ratio_values[organ * ratios + i];
    }
};

}  // namespace quasimc
