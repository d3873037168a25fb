#pragma once

// Results for every organ and for groups of organs, with errors; the energy budget; and audits.

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "quasimc/run_spec.h"
#include "quasimc/source.h"
#include "quasimc/sums.h"
#include "quasimc/sun_shade.h"

namespace quasimc {

class Scene;

/// OrganGroup::by of the group of all organs, and of layers.
inline constexpr std::string_view kAllOrgans = "all", kLayer = "layer";

/// Groups of organs.
struct GroupSpec {
    /// Keys of labels: each value of "plant" is a group, each pair of values of "plant+kind"; with
    /// a condition: "plant where height > 1.2"; with a name: "top: plant where height > 1.2".
    std::vector<std::string> labels = {};
    /// Layers of equal height, from the ground (or the lowest point of the organs) to the highest
    /// point of the organs; 0: none.
    std::uint32_t layers = 0;
    /// Alternatively, the heights between layers, ascending, at least two; scene units, up.
    std::vector<double> layer_heights = {};
};

/// The light whose statistical errors count.
struct Question {
    TargetScope scope = TargetScope::automatic;
    std::string quantity = "auto";        ///< as RunSpec::target_quantity
    std::vector<std::size_t> bands = {};  ///< empty: all
};

/// The groups that a run requests.
[[nodiscard]] inline GroupSpec group_spec(const RunSpec& spec) {
    return {spec.groups, spec.layers, spec.layer_heights};
}

/// Organs whose light is summed. Only organs that are measured belong to groups, the ground to
/// none, and sensors only to those of labels.
struct OrganGroup {
    static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

    std::string by;  ///< kAllOrgans, kLayer, or the request: its name, or its text
    std::string
        value;  ///< value of the label ("1+leaf" for two), or number of the layer, from 1 below
    std::vector<std::uint32_t> organs = {};  ///< indices in the scene's list, ascending
    double area = 0;                         ///< one-sided, of all its organs
    /// For a layer: its lower and upper height. An organ belongs to the layer that holds the
    /// centroid of its area (the last layer, its upper height too).
    double height_min = kNone, height_max = kNone;
    /// For a layer above a ground or in a cell that is periodic along both axes: one-sided area of
    /// its organs (leaf area, where all are leaves) per horizontal area; and that of the organs of
    /// this layer and those above.
    double plant_area_index = kNone, cumulative_plant_area_index = kNone;
    /// The keys of the group with their values; none for all organs.
    std::vector<std::pair<std::string, std::string>> labels = {};
};

/// The flux that a group absorbs as a fraction of other light.
enum class GroupShare {
    incident,  ///< share of the light on the horizontal (CanopyFractions::incident)
    absorbed,  ///< share of the flux that the group of all organs absorbs
};
inline constexpr std::size_t kGroupShares = 2;

/// The groups of a scene: all organs first, then those of labels in the order in which values first
/// appear, then layers from below.
/// @param spec  checked by check_groups()
[[nodiscard]] std::vector<OrganGroup> make_groups(const Scene& scene, const GroupSpec& spec);

class Scene;
class SceneNames;  // quasimc/scene.h
class OrganLight;
struct Result;

/// The estimate as it is reported. Intervals are limited to physically possible values; a mean
/// beyond them, by chance, is moved to the end of its interval. Such means are biased and the
/// original ones are not, so sums, averages and models should use the latter. Zeros have no sign.
[[nodiscard]] constexpr Estimate reported(const Estimate& e) {
    return {
        std::clamp(e.mean, e.ci95_low, e.ci95_high) + 0.0, e.standard_error, e.ci95_low,
        e.ci95_high};
}

/// A correct result fails an audit with at most this probability.
inline constexpr double kAuditLevel = 1e-4;

/// Comparison of two results in one band.
struct BandAudit {
    /// sum of w (a - b)^2 / sum of w (var a + var b) of incident light, over the sides of all
    /// organs that both results have, w the organ's area; about 1 if both are correct.
    double reduced_chi_square = 1;
    double freedom = 0;             ///< effective number of independent sides
    double chi_square_p_value = 1;  ///< probability of a larger chi-square if both are correct
    /// Flux absorbed by all organs (without the ground), first minus second result. NaN unless all
    /// organs are measured.
    double difference = 0, standard_error = 0;
    double difference_p_value = 1;  ///< probability of a larger one, of either sign
};

/// A result compared with that of an independent run: docs/theory/statistics.md.
struct Audit {
    std::uint64_t paths = 0;  ///< paths of the independent run, per replicate
    std::uint32_t replicates = 0;
    std::vector<BandAudit> bands;
    double p_value = 1;  ///< smallest p-value times the number of tests; at most 1

    [[nodiscard]] bool agrees() const { return p_value >= kAuditLevel; }
};

/// Compares the results of two independent runs of a scene, of at least two replicates each.
[[nodiscard]] Audit compare_results(const Scene& scene, const Result& a, const Result& b);

/// Quantities reported for each organ and band. Densities are per one-sided area of the organ.
enum class Quantity {
    absorbed_flux,  ///< irradiance unit x area unit
    absorbed_flux_density,
    incident_upper,  ///< light on the upper side / area
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

/// The energy budget of one band, flux. emitted + imbalance = absorbed_by_organs +
/// absorbed_by_ground + escaped + cut_off to rounding. `imbalance` is the light added minus the
/// light removed by Russian roulette: its mean is 0. Paths from organs give emitted and absorbed
/// light; escaped is then the remainder (Result::escaped_by_difference).
struct BandBudget {
    Estimate emitted;  ///< for skies and lamps a sum over samples, with its error
    Estimate absorbed_by_organs, absorbed_by_ground, escaped, cut_off, imbalance;
    /// |emitted + imbalance - absorbed - escaped - cut off| / emitted.
    double closure_error = 0;
};

/// The light of groups of organs. Errors are those of the sums, replicate by replicate: errors of
/// organs that shade one another are correlated (docs/theory/statistics.md).
struct GroupResults {
    std::vector<OrganGroup> groups;
    std::size_t bands = 0, ratios = 0;
    /// [(group * kQuantities + quantity) * bands + band]: fluxes are sums, densities are per
    /// OrganGroup::area; see at().
    std::vector<Estimate> values;
    /// Per group, as Result::sunlit_fraction, and times the area; empty without directional
    /// sources.
    std::vector<Estimate> sunlit_fraction, sunlit_area;
    std::vector<Estimate> ratio_values;  ///< [group * ratios + i], as Result::ratio_values
    /// [(group * kGroupShares + share) * bands + band]; see share(). Over times: of the sums.
    std::vector<Estimate> shares = {};
    SunShadeLight sun_shade = {};  ///< rows as in `groups`

    /// Unknown without light, or without horizontal area.
    [[nodiscard]] Estimate share(std::size_t group, GroupShare share, std::size_t band) const {
        return shares[(group * kGroupShares + static_cast<std::size_t>(share)) * bands + band];
    }
    [[nodiscard]] Estimate at(std::size_t group, Quantity q, std::size_t band) const {
        return values[(group * kQuantities + static_cast<std::size_t>(q)) * bands + band];
    }
    [[nodiscard]] Estimate ratio(std::size_t group, std::size_t i) const {
        return ratio_values[group * ratios + i];
    }
};

/// Reflectance, transmittance and absorptance of a canopy above a ground or in a periodic cell in
/// one band: fractions of the horizontal irradiance (docs/theory/statistics.md). Unknown ones are
/// NaN.
struct CanopyFractions {
    /// Flux on the horizontal area of the cell or the ground. It follows from the sources and has
    /// no error; fractions over a cell relate to the emission of each replicate.
    double incident = 0;
    Estimate
        reflectance;  ///< fraction that leaves the scene upwards: the albedo of canopy and ground
    Estimate transmittance;       ///< fraction that reaches the ground
    Estimate absorptance;         ///< fraction absorbed by organs
    Estimate ground_absorptance;  ///< fraction absorbed by the ground
};

/// The light of a detector, flux: irradiance unit x area unit.
struct DetectorResult {
    std::string name, type;
    std::string quantity;           ///< quantity by which light is sorted, with its unit
    std::vector<std::string> bins;  ///< their names
    std::vector<Estimate> values;   ///< [bin * bands + band]; see at()

    [[nodiscard]] Estimate at(std::size_t bin, std::size_t band) const {
        return values[bin * (values.size() / bins.size()) + band];
    }
};

/// The reason for the end of a run.
enum class StopReason {
    finished,
    target_reached,
    time_limit,   ///< before the requested paths or target
    path_limit,   ///< before the target, if one was set
    interrupted,  ///< requested by the caller
    no_light,     ///< no light of any source reaches the scene (one leaf, edge-on to the sun): all
                  ///< light is 0 without an error
};

/// The errors after a round of a run with several rounds.
struct RoundErrors {
    std::uint64_t paths = 0;  ///< per replicate, of all rounds up to it that it adds to
    double seconds = 0;       ///< since the run began
    /// Relative standard errors of the light of RunSpec::target, by default of the flux that organs
    /// absorb, over organs (or groups, ...) and bands in which light was sampled: median and
    /// largest. NaN: none.
    double median = 0, worst = 0;
    /// Fraction of the organs (or groups, ...) at the target: the smaller one of organs and sensors
    /// if it is for both; 0 without a target.
    double fraction_at_target = 0;
};

struct OriginLight;

/// Means are original estimates: reported() gives those for files, tables and pictures.
struct Result {
    std::size_t bands = 0;
    std::size_t ratios = 0;
    /// The bands and organs of the numbers, shared with the scene.
    std::shared_ptr<const SceneNames> names = {};
    /// [(organ * kQuantities + quantity) * bands + band], organs in the scene's order; see at().
    std::vector<Estimate> values;
    /// Per organ: fraction of the one-sided area with direct light of the directional sources
    /// (their mean weighted by irradiance); empty without these. A leaf whose sides are lit by two
    /// suns counts for each.
    std::vector<Estimate> sunlit_fraction;
    SunShadeLight sun_shade;  ///< rows are organs, in the scene's order
    /// [organ * ratios + i], i as in RunSpec::ratios.
    std::vector<Estimate> ratio_values;
    GroupResults groups;                  ///< all organs first
    std::vector<BandBudget> budget;       ///< per band
    std::vector<CanopyFractions> canopy;  ///< per band; empty without ground or periodic cell
    bool escaped_by_difference = false;
    std::vector<DetectorResult> detectors;  ///< in the order of Scene::detectors()
    /// The light of each origin (RunSpec::origins) alone: all of the above except ratios, sunlit
    /// fractions and the light of parts. Their means add up to those of all light, to rounding.
    std::vector<OriginLight> origins;
    /// The light on sensors (Scene::sensors()), in their order, as that on organs; they absorb
    /// none. Null without sensors, and if the run was stopped before their light was computed.
    /// Result::rays and times include them.
    std::shared_ptr<const Result> sensors = {};

    ChosenMethod chosen;
    std::optional<Audit> audit;  ///< if RunSpec::audit requests one
    std::uint64_t paths = 0;     ///< per replicate, all rounds
    /// The paths traced before the run was resumed from a checkpoint, which times do not include;
    /// for an incomplete round in proportion to its completed tasks.
    double paths_before = 0;
    std::uint32_t replicates = 0;
    std::uint64_t rays = 0;  ///< all replicates
    StopReason stop = StopReason::finished;
    double fraction_at_target = 0;  ///< as RoundErrors::fraction_at_target, after the last round
    /// For a run with a target or a limit of paths: its rounds since it was resumed. With a target
    /// the first ones may be pilot rounds, whose paths later ones do not include. Empty: a single
    /// round.
    std::vector<RoundErrors> rounds;
    double preparation_seconds = 0;  ///< acceleration structure, wall
    double solve_seconds = 0;        ///< wall
    double solve_cpu_seconds = 0;    ///< all threads

    [[nodiscard]] std::size_t organs() const { return values.size() / (kQuantities * bands); }
    [[nodiscard]] Estimate at(std::size_t organ, Quantity q, std::size_t band) const {
        return values[(organ * kQuantities + static_cast<std::size_t>(q)) * bands + band];
    }
    [[nodiscard]] Estimate ratio(std::size_t organ, std::size_t i) const {
        return ratio_values[organ * ratios + i];
    }
    /// Returns the light of the organ with a name, result["leaf 3"]; the result must outlive it.
    /// @throws InputError  if there is no such organ, or there are several
    [[nodiscard]] OrganLight operator[](std::string_view organ) const&;
    OrganLight operator[](std::string_view organ) const&& = delete;
    /// Returns the light of the organ at an index, in the order of Scene::organs(); the result must
    /// outlive it.
    /// @throws InputError  if the index is not below the number of organs
    [[nodiscard]] OrganLight operator[](std::size_t index) const&;
    OrganLight operator[](std::size_t index) const&& = delete;
    /// Returns the light of the organ with an id; the result must outlive it.
    /// @throws InputError  if there is no such organ
    [[nodiscard]] OrganLight organ(std::int64_t id) const&;
    OrganLight organ(std::int64_t id) const&& = delete;
};

/// The light of an origin.
struct OriginLight {
    std::string name;
    Result light;  ///< without origins, and data of the run
};

/// A band, given by its name or its index.
class BandKey {
  public:
    template <std::integral Index>
    BandKey(Index index)  // NOLINT(google-explicit-constructor): allows result.at("PAR")
        : key_(static_cast<std::size_t>(index)) {}
    BandKey(std::string name)  // NOLINT(google-explicit-constructor)
        : key_(std::move(name)) {}
    BandKey(const char* name)  // NOLINT(google-explicit-constructor)
        : key_(std::string(name)) {}
    BandKey(std::string_view name)  // NOLINT(google-explicit-constructor)
        : key_(std::string(name)) {}

    /// Returns the index of the band. @throws InputError  if there is no such band
    [[nodiscard]] std::size_t index(const SceneNames& names) const;

  private:
    std::variant<std::size_t, std::string> key_;
};

/// The light of one organ: result["leaf 3"].absorbed_flux("PAR"). The functions have the names of
/// the quantities; each throws an InputError if there is no such band.
class OrganLight {
  public:
    /// @param index  the organ's, in the order of Scene::organs()
    OrganLight(const Result& result, std::size_t index) : result_(&result), index_(index) {}

    [[nodiscard]] Estimate at(Quantity quantity, const BandKey& band) const;
    [[nodiscard]] Estimate absorbed_flux(const BandKey& band) const {
        return at(Quantity::absorbed_flux, band);
    }
    [[nodiscard]] Estimate absorbed_flux_density(const BandKey& band) const {
        return at(Quantity::absorbed_flux_density, band);
    }
    [[nodiscard]] Estimate incident_upper(const BandKey& band) const {
        return at(Quantity::incident_upper, band);
    }
    [[nodiscard]] Estimate incident_lower(const BandKey& band) const {
        return at(Quantity::incident_lower, band);
    }
    [[nodiscard]] Estimate incident_direct(const BandKey& band) const {
        return at(Quantity::incident_direct, band);
    }
    [[nodiscard]] Estimate incident_scattered(const BandKey& band) const {
        return at(Quantity::incident_scattered, band);
    }
    /// Returns the fraction of the area with direct light of suns.
    /// @throws InputError  if there is no sun
    [[nodiscard]] Estimate sunlit_fraction() const;

  private:
    const Result* result_;
    std::size_t index_;
};

/// The sources of an origin of light, as EvaluationSpec has those of all.
struct OriginSources {
    std::vector<double> horizontal_irradiance = {};
    Sources sources = {};
};

/// Options of the evaluation of sums.
struct EvaluationSpec {
    std::vector<std::pair<std::size_t, std::size_t>> ratios = {};  ///< pairs of bands
    DirectLight direct_light = DirectLight::included;
    SunShade sun_shade = SunShade::together;  ///< `apart` only for sums with these blocks
    GroupSpec groups = {};
    Question question = {};  ///< for errors_so_far() and pooled_error() only
    /// Horizontal irradiance of all sources, per band; empty if unknown (lamps).
    std::vector<double> horizontal_irradiance = {};
    /// Sources of the light: no interval exceeds their largest possible contribution. Empty:
    /// unknown.
    Sources sources = {};
    std::vector<OriginSources> origins = {};  ///< in the order of the sums; empty: unknown
    unsigned threads = 1;                     ///< never changes a number
};

/// Estimates of each organ, ratio and band from the sums of a run, with errors from the replicates:
/// a pure function. Sets all of the result except the data of the run itself (Result::chosen, stop,
/// times).
/// @param sums  with at least one path
/// @param scene  scene of the sums
[[nodiscard]] Result evaluate(const Sums& sums, const Scene& scene, const EvaluationSpec& spec);
/// Evaluates sums and frees their memory while the result grows, to limit the peak.
[[nodiscard]] Result evaluate(Sums&& sums, const Scene& scene, const EvaluationSpec& spec);

}  // namespace quasimc
