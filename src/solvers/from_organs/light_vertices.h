#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "transport/prepared_scene.h"
#include "transport/surface.h"

namespace quasimc {

/// A vertex of a light subpath near its lamp, to which paths from organs are connected. Local
/// coordinates.
struct LightVertex {
    const BoundSource* light = nullptr;
    Vec3 p;
    Surface surface;
    Vec3 wi;                  ///< direction of the incident light
    std::uint32_t depth = 0;  ///< number of scatterings, including this one
};

/// The light vertices of one subpath.
class LightVertices {
  public:
    void clear() { all_.clear(), weights_.clear(); }
    /// @param weights  of the incident light, per band
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

/// Connects paths from organs to light vertices (bidirectional path tracing, Lafortune and Willems
/// 1993). Connections shorter than LampNearField::min_connection_distance() are left to the light
/// subpath, which bounds the geometry term (Keller 1997).
class VertexLight {
  public:
    /// @param scale  as that of NextEvent
    /// @param narrow_from  peak_brightness() from which on lobes contribute nothing
    VertexLight(const PreparedScene& prepared, double scale, double narrow_from)
        : prepared_(prepared), scale_(scale), narrow_from_(narrow_from) {}

    /// The light of one connection.
    struct Connection {
        Vec3 wi;                 ///< direction of the light
        bool is_traced = false;  ///< a ray was cast
        bool arrives = false;    ///< otherwise the irradiance is not set
    };
    /// Connects point `p` with a vertex.
    /// @param triangle  on which the point lies
    /// @param min_distance  of a connection
    /// @param irradiance  on a plane facing the light, per band, units of NextEvent
    Connection connect(
        const LightVertex& vertex,
        std::span<const double> weights,
        const Vec3& p,
        std::uint32_t triangle,
        double min_distance,
        std::span<double> irradiance) const;

  private:
    const PreparedScene& prepared_;
    double scale_, narrow_from_;
};

}  // namespace quasimc
