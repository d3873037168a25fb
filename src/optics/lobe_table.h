#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "base/vec3.h"
#include "optics/bsdf.h"

namespace quasimc {

/// One lobe of a side, with its albedo.
struct Lobe {
    std::shared_ptr<const Bsdf> shape;
    std::vector<double> albedo;  ///< per band; times the shape's relative_albedo
};

/// The random numbers of a scattering, and the limit of Russian roulette.
struct Draw {
    double u0 = 0, u1 = 0;  ///< a point of the unit square; u0 also decides survival and lobe
    /// Light whose weights sum to less survives with the probability of its albedo (Russian
    /// roulette). Other light always survives and loses weight instead, down to this limit.
    double roulette_threshold = std::numeric_limits<double>::infinity();
};

/// The lobes that share the light of a hit, in a layout for speed: the arithmetic of weights that
/// Side (forwards) and Material (backwards) have in common. See docs/theory/what-is-computed.md.
/// Immutable.
class LobeTable {
  public:
    /// @param lobes  each with an albedo above 0 in some band
    LobeTable(std::span<const Lobe> lobes, std::size_t bands);

    struct Row {
        std::shared_ptr<const Bsdf> shape;
        std::size_t begin, end;  ///< bands outside have albedo 0
        std::size_t offset;      ///< index of its albedos, one for every band
        double sign;             ///< 1 reflected, -1 transmitted
        bool delta, lambertian, reciprocal;
        bool narrow;    ///< see is_narrow()
        double peak;    ///< see peak_brightness()
        bool alone;     ///< no other lobe can give the same direction
        bool constant;  ///< the albedo is the same at every angle

        /// shape->relative_albedo at the angle between `wi` and `n`, faster.
        [[nodiscard]] double relative_albedo(const Vec3& n, const Vec3& wi) const {
            return constant ? 1 : shape->relative_albedo(std::abs(dot(wi, n)));
        }

        /// shape->sample, faster.
        [[nodiscard]] Vec3 sample(const Vec3& n, const Vec3& wi, double u0, double u1) const;
        /// Whether both lobes have a density, in the same hemisphere.
        [[nodiscard]] bool shares(const Row& other) const {
            return !delta && !other.delta && sign == other.sign;
        }
    };
    [[nodiscard]] std::span<const Row> rows() const { return rows_; }
    [[nodiscard]] std::size_t bands() const { return bands_; }
    /// Whether the albedo of every lobe is the same at every angle.
    [[nodiscard]] bool has_constant_albedo() const { return constant_; }

    /// A sampled lobe. `row` is null if the light ends.
    struct Choice {
        const Row* row = nullptr;
        double u = 0;      ///< the random number, rescaled to [0, 1)
        double total = 0;  ///< the probability of a lobe is its power divided by this (one band:
                           ///< its albedo)
        double scale = 0;  ///< 1 / the probability of the sampled lobe
    };

    /// Samples a lobe with probability power(lobe) / total. The total is the sum of the weights, or
    /// draw.roulette_threshold if that is less, or the powers of all lobes if they are more. None
    /// if the weights are all 0. The albedos are the given ones, an upper bound at every angle.
    [[nodiscard]] Choice choose(const Draw& draw, std::span<const double> weights) const;

    /// Samples a lobe for light that arrives along `wi` at a surface with normal `n`: with the
    /// power of each lobe at this angle.
    [[nodiscard]] Choice choose(
        const Vec3& n, const Vec3& wi, const Draw& draw, std::span<const double> weights) const;

    /// sum_b w_b a_b of one lobe.
    [[nodiscard]] double power(const Row& row, std::span<const double> weights) const;

    /// w_b *= factor a_b.
    void follow(const Row& row, double factor, std::span<double> weights) const;

    /// out_b += factor a_b w_b.
    void add(const Row& row, double factor, std::span<const double> weights, std::span<double> out)
        const;

    /// The albedos of one lobe, for every band.
    [[nodiscard]] std::span<const double> albedo(const Row& row) const {
        return {albedo_.data() + row.offset, bands_};
    }

  private:
    template <typename Power>
    [[nodiscard]] Choice choose_among(double u0, double total, const Power& power_of) const;
    template <typename Share>
    [[nodiscard]] Choice choose_by(
        const Draw& draw,
        std::span<const double> weights,
        const Share& share_of,
        double largest_sum) const;

    std::size_t bands_;
    std::vector<Row> rows_;
    std::vector<double> albedo_;  ///< albedos of all lobes, one after the other
    double largest_sum_ = 0;      ///< largest sum of the lobes' albedos over the bands
    bool constant_ = true;
};

/// The lobes that can give one direction, combined by the balance heuristic (Veach and Guibas
/// 1995).
class LobeMix {
  public:
    /// @param weights  weights before the hit; must outlive this object
    LobeMix(const LobeTable& table, std::span<double> weights);
    ~LobeMix() = default;
    LobeMix(const LobeMix&) = delete;
    LobeMix& operator=(const LobeMix&) = delete;

    /// Adds a lobe: its value in the direction, per albedo, and the density with which it samples
    /// the direction.
    void add(const LobeTable::Row& row, double value, double density);

    /// w_b *= sum_k a_kb value_k / (sum_k power_k density_k / total). False, with unchanged
    /// weights, if no lobe can sample the direction.
    [[nodiscard]] bool apply(double total);

  private:
    static constexpr std::size_t kInline = 256;

    const LobeTable& table_;
    std::span<double> weights_;
    std::array<double, kInline> small_;
    std::vector<double> large_;  ///< for more bands than kInline
    double* sums_;
    double density_ = 0;
};

}  // namespace quasimc
