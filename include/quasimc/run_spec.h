#pragma once

// How a run is done.

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "quasimc/mesh.h"

namespace quasimc {

class Scene;
class Source;

/// How light is computed.
enum class Method {
    light_tracing,  ///< light tracing: many organs, sun
    from_organs,    ///< from points on each organ, light sampled at every hit: few or small organs,
                    ///< sky
    first_hits,     ///< where suns and skies fall first, found by scan lines and item buffers:
                    ///< direct light almost without noise; lamps as `sources`
    ray_bundles,    ///< direct light as first_hits, scattered light all at once along bundles of
                    ///< lines: matt surfaces only
    // (tools/new.py enters a method above this line)
    automatic,  ///< whichever of the others has the smallest errors for its time: plan_method()
};

/// How a result was computed, and why so.
struct ChosenMethod {
    Method method = Method::light_tracing;  ///< never automatic
    std::string reason;                     ///< a sentence without its full stop
};

/// What becomes of light that falls on an organ straight from a source.
enum class DirectLight {
    included,
    excluded,  ///< it is scattered as always, but is no part of any organ's numbers
};

/// How the paths of a series are shared out among its times.
enum class PathAllocation {
    equal,         ///< every time has as many
    proportional,  ///< by the light that a time brings to the sum of its day
};

/// How the times of a series are computed.
enum class TimeMethod {
    independent,            ///< each for itself
    daylight_coefficients,  ///< the sun's direct light for itself, all else from the light of one
                            ///< set of directions (docs/theory/time-series.md): ray bundles only
};

/// A point set that paths are made from.
struct SamplerModel {
    std::string_view name;     ///< as in RunSpec::sampler
    std::string_view summary;  ///< one line
};

/// All samplers, in the order of the manual.
[[nodiscard]] std::vector<SamplerModel> sampler_models();

/// How a run is done: everything but scene and sources. Ranges and units:
/// docs/reference/options.md.
struct RunSpec {
    std::string sampler = "sobol";  ///< a name of sampler_models()
    Method method = Method::automatic;
    std::uint64_t paths = 65536;   ///< per replicate; for organs: shared out equally among them
    std::uint32_t replicates = 8;  ///< independent randomizations
    std::uint64_t seed = 1;
    unsigned threads = 0;         ///< 0: as many as the machine has; never changes a result
    std::uint32_t max_depth = 0;  ///< hits after which a path is cut off; 0: none
    /// Weight (a path starts with 1) that Russian roulette plays for, 0 to 1. At 1 a path survives
    /// every hit with the surface's albedo; below, heavier paths go on surely and lose weight:
    /// fewer paths end, each is longer.
    double roulette_threshold = 1;
    StartArea start_area = StartArea::silhouette;
    Accelerator accelerator = Accelerator::embree;
    DirectLight direct_light = DirectLight::included;

    /// Of a series of times with lengths: whose precision paths and target are for. A single run
    /// takes no notice of it.
    PathAllocation path_allocation = PathAllocation::equal;
    /// Of a series: whether its times share what they can. A single run takes no notice of it.
    TimeMethod time_method = TimeMethod::independent;

    double target_error = 0;  ///< relative standard error of the absorbed flux to reach; 0: none
    double target_fraction = 0.95;  ///< ... by this fraction of the organs, in every band
    double max_seconds = 0;         ///< the run ends after that; 0: no limit
    std::uint64_t max_paths = 0;    ///< per replicate, all rounds; 0: only `paths`, or 2^30 with a
                                    ///< target

    /// After the run, plain Monte Carlo tracing from the sources with this share of its paths, to
    /// compare with (Result::audit); 0: none. At most 1.
    double audit = 0;

    double tally_memory_mb = 256;  ///< private tallies of all threads; larger ones are shared

    /// Pairs of band names, "R:FR": ratio of the light that falls on an organ (both sides).
    std::vector<std::string> ratios = {};

    // Organs taken together (GroupSpec): of each value of these labels, and in these layers.
    std::vector<std::string> groups = {};
    std::uint32_t layers = 0;
    std::vector<double> layer_heights = {};
};

/// How to trace: as the specification says or, if that is `automatic`, by the rules of
/// docs/develop/notebook/choosing.md, which ask for the smallest errors of the measured organs in a
/// given time. A method that can't be run is never chosen, but for ray_bundles where very many
/// surfaces cross each other: a run finds that out, and takes another. A pure function of its
/// arguments.
[[nodiscard]] ChosenMethod plan_method(
    const Scene& scene,
    const std::vector<std::shared_ptr<const Source>>& sources,
    const RunSpec& spec);

}  // namespace quasimc
