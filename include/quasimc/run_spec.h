#pragma once

// The options of a run.

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "quasimc/mesh.h"

namespace quasimc {

class Scene;
class Source;

/// Methods of computing light.
enum class Method {
    light_tracing,  ///< paths from the sources: many organs, sun
    from_organs,    ///< backward paths from points on each organ with next-event estimation: few or
                    ///< small organs, sky
    first_hits,   ///< direct light of suns and skies by scan lines and item buffers, almost without
                  ///< noise, and paths from there; lamps as in light_tracing
    ray_bundles,  ///< direct light as in first_hits, radiosity along bundles of parallel lines:
                  ///< Lambertian surfaces only
    // (tools/new.py enters a method above this line)
    automatic,  ///< the most efficient of the others: plan_method()
};

/// The method of a result, and the reason for it.
struct ChosenMethod {
    Method method = Method::light_tracing;  ///< never automatic
    std::string reason;                     ///< a sentence without its full stop
};

/// Treatment of direct light on organs.
enum class DirectLight {
    included,
    excluded,  ///< it is scattered, but does not count in the results of organs
};

/// The light of the sunlit and the shaded part of each organ.
enum class SunShade {
    together,  ///< is one number
    apart,     ///< is reported apart too: SunShadeLight
};

/// The allocation of the paths of a series to its times.
enum class PathAllocation {
    equal,         ///< equal numbers for all times
    proportional,  ///< in proportion to the light of a time in the sum of its day
};

/// The method for the times of a series.
enum class TimeMethod {
    independent,            ///< each by a computation of its own
    daylight_coefficients,  ///< direct sunlight for each time, all other light from one set of
                            ///< directions (docs/theory/time-series.md): ray bundles only
};

/// The light whose errors count, for RunSpec::target_error and in the choice of a method.
enum class TargetScope {
    automatic,  ///< every organ and, if there are sensors, every sensor
    organs,     ///< every organ; the ground only if there is nothing else
    groups,     ///< every group that RunSpec::groups and layers request
    total,      ///< all organs together, without ground and sensors
    sensors,    ///< every sensor
};

/// A point set for the random numbers of paths.
struct SamplerModel {
    std::string_view name;     ///< name in RunSpec::sampler
    std::string_view summary;  ///< one line
};

/// All samplers, in the order of the manual.
[[nodiscard]] std::vector<SamplerModel> sampler_models();

/// All input of a run except scene and sources. Ranges and units: docs/reference/options.md.
struct RunSpec {
    std::string sampler = "sobol";  ///< a name of sampler_models()
    Method method = Method::automatic;
    std::uint64_t paths = 65536;   ///< per replicate; from_organs: an equal number for each organ
    std::uint32_t replicates = 8;  ///< independent randomizations
    std::uint64_t seed = 1;
    unsigned threads = 0;         ///< 0: all of the machine; does not change results
    std::uint32_t max_depth = 0;  ///< hits after which a path is cut off; 0: none
    /// The weight (paths start with 1) below which Russian roulette applies, 0 to 1. At 1 a path
    /// survives every hit with the probability of the surface's albedo; at smaller values, paths of
    /// larger weights always survive and lose weight: fewer paths end, and each is longer.
    double roulette_threshold = 1;
    StartArea start_area = StartArea::silhouette;
    Accelerator accelerator = Accelerator::embree;
    DirectLight direct_light = DirectLight::included;

    /// For a series of times with lengths: whether paths and target apply to every time or to the
    /// sum of a day. Single runs ignore it.
    PathAllocation path_allocation = PathAllocation::equal;
    /// For a series: the method for its times. Single runs ignore it.
    TimeMethod time_method = TimeMethod::independent;

    double target_error = 0;        ///< target of the relative standard error; 0: none
    double target_fraction = 0.95;  ///< fraction of the organs (or groups, ...) that must reach it
    TargetScope target = TargetScope::automatic;
    /// A name of quantity_table(), or "sunlit_fraction"; "auto": absorbed flux, and for sensors,
    /// which absorb nothing, the light on both sides.
    std::string target_quantity = "auto";
    std::vector<std::string> target_bands = {};  ///< bands in which it holds; empty: all
    double max_seconds = 0;                      ///< time limit of the run; 0: none
    std::uint64_t max_paths = 0;  ///< per replicate, all rounds; 0: only `paths`, or 2^30 with a
                                  ///< target

    /// Size of an independent run of light tracing with plain Monte Carlo to compare with
    /// (Result::audit), as a fraction of the paths; 0: none. At most 1.
    double audit = 0;

    double tally_memory_mb = 256;  ///< private tallies of all threads; larger ones are shared

    /// Pairs of band names, "R:FR": ratio of the light on an organ (both sides).
    std::vector<std::string> ratios = {};

    /// Origins whose light is reported apart too: "sun", "sky", "lamps", or patterns of names of
    /// sources, in which `*` means any characters. A source belongs to the first that fits;
    /// what fits none is "other". Empty: none.
    std::vector<std::string> origins = {};

    SunShade sun_shade = SunShade::together;

    // Groups of organs (GroupSpec): for each value of these labels, and in these layers.
    std::vector<std::string> groups = {};
    std::uint32_t layers = 0;
    std::vector<double> layer_heights = {};
};

/// The method of the specification or, if that is `automatic`, the one that run() would choose: by
/// pilot runs of few paths, about 5 % of the work (docs/develop/decisions/plan-by-pilot-runs.md). A
/// pure function of its arguments, the same on any number of threads.
[[nodiscard]] ChosenMethod plan_method(
    const Scene& scene,
    const std::vector<std::shared_ptr<const Source>>& sources,
    const RunSpec& spec);

}  // namespace quasimc
