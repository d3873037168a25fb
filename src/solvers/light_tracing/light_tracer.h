#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "solvers/solver.h"
#include "sums/tally.h"
#include "transport/light_sampler.h"
#include "transport/particle.h"
#include "transport/start_order.h"

namespace quasimc {

/// Whether light is traced, by light of the prepared scene; empty: all lights.
using TracedLights = std::vector<bool>;

/// Traces light from the sources: blocks of consecutive points, each an independent task.
class LightTracer {
  public:
    LightTracer(const SolverInput& input, TracedLights traced);

    /// Points per block: enough that neighbours are near, few enough for the cache and for many
    /// threads.
    static constexpr std::uint64_t kPathsPerBlock = 16384;
    /// Number of blocks a round of one replicate is cut into.
    [[nodiscard]] static std::uint64_t blocks(const Round& round);

    /// Memory of a worker, reused between blocks.
    struct Scratch {
        explicit Scratch(std::size_t bands) : particle(bands) {}
        PathStarts starts;
        std::vector<double> u2;              // random number of the first hit
        std::vector<std::uint32_t> sources;  // source of each start; empty if there is one
        ParticleScratch particle;
    };

    void trace(
        const Round& round,
        std::uint32_t replicate,
        std::uint64_t block,
        Scratch& scratch,
        Tally& tally) const;

  private:
    /// The points of a block, and their common settings.
    struct Block {
        PathRules rules;
        std::uint64_t first = 0;
        std::uint64_t count = 0;
    };
    /// Points of a block that are traced together: neighbours lit by the same source.
    struct Group {
        std::size_t source = 0;
        std::span<const std::uint32_t> points;  // in the block
    };

    [[nodiscard]] std::vector<std::vector<double>> brightest_paths() const;
    [[nodiscard]] double survival(
        const std::vector<double>& spectrum, const Material& material, SurfaceSide side) const;
    void prepare(const Block& block, Scratch& scratch) const;
    [[nodiscard]] static Group next_group(const Scratch& scratch, std::size_t begin);
    std::uint64_t trace_single(
        const Block& block, const Group& group, Scratch& scratch, Tally& tally) const;
    std::uint64_t trace_packet(
        const Block& block, const Group& group, Scratch& scratch, Tally& tally) const;
    std::uint64_t shade(
        const Block& block,
        const Group& group,
        const Packet& packet,
        const std::array<RayEnd, kPacket>& ends,
        Scratch& scratch,
        Tally& tally) const;

    const PreparedScene& prepared_;
    const Sampler& sampler_;
    const RunSpec& spec_;
    TracedLights traced_;
    LightSampler light_sampler_;
    std::stop_token stop_;
    double roulette_threshold_;
    std::vector<std::optional<Vec3>> beams_;  // by source: its direction if it is a beam
    bool only_beams_ = true;
    std::vector<double> survival_;  // [spectrum][material][side]
};

}  // namespace quasimc
