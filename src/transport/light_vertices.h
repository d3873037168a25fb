#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "transport/near_lamps.h"
#include "transport/prepared_scene.h"
#include "transport/surface.h"

namespace quasimc {

/// A place near a lamp where a path of its light is scattered, from which points elsewhere may take
/// light. Local coordinates.
struct LightVertex {
    const BoundSource* light = nullptr;
    Vec3 place;
    Surface surface;
    Vec3 wi;                  ///< in which the light came
    std::uint32_t depth = 0;  ///< scatterings up to here, this one with them
};

/// The light vertices of one path.
class LightVertices {
  public:
    void clear() { all_.clear(), weights_.clear(); }
    /// @param weights  of the light that falls there, per band
    void add(const LightVertex& vertex, std::span<const double> weights) {
        all_.push_back(vertex);
        weights_.insert(weights_.end(), weights.begin(), weights.end());
    }
    [[nodiscard]] const std::vector<LightVertex>& all() const { return all_; }
    [[nodiscard]] std::span<const double> weights(std::size_t i) const {
        const std::size_t bands = weights_.size() / all_.size();
        return {weights_.data() + i * bands, bands};
    }

  private:
    std::vector<LightVertex> all_;
    std::vector<double> weights_;
};

/// Takes light from light vertices to other places: it connects a path from a lamp and one from an
/// organ (Lafortune and Willems 1993; of lit places as lamps, Keller 1997). Which way of light a
/// connection brings, and which is followed, the length of the way tells (NearLamps::leg).
class VertexLight {
  public:
    /// @param scale  as that of NextEvent
    /// @param sharp_from  peak_brightness() of lobes that send nothing
    VertexLight(const PreparedScene& prepared, double scale, double sharp_from)
        : prepared_(prepared), scale_(scale), sharp_from_(sharp_from) {}

    /// What comes to a place from a vertex.
    struct Arrival {
        Vec3 wi;                    ///< in which the light travels
        bool is_asked_for = false;  ///< a ray was cast
        bool arrives = false;       ///< otherwise the irradiance is not set
    };
    /// @param triangle  on which the place lies
    /// @param leg  the shortest way to there
    /// @param irradiance  on a plane facing the light, per band, units of NextEvent
    Arrival find(
        const LightVertex& vertex,
        std::span<const double> weights,
        const Vec3& place,
        std::uint32_t triangle,
        double leg,
        std::span<double> irradiance) const;

  private:
    const PreparedScene& prepared_;
    double scale_, sharp_from_;
};

}  // namespace quasimc
