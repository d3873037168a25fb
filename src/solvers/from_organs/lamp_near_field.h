#pragma once

#include <cstdint>
#include <vector>

#include "transport/prepared_scene.h"

namespace quasimc {

/// The near field of each lamp. Its irradiance grows there as 1 / distance^2, which points of
/// organs would sample with unbounded variance; paths from the lamp sample it instead. The near
/// field depends only on the lamp and the first point that its light hits, so that both strategies
/// are disjoint and together complete (path_class.h).
class LampNearField {
  public:
    explicit LampNearField(const PreparedScene& prepared);

    /// Whether some surface lies in the near field of a lamp.
    [[nodiscard]] bool any() const { return any_; }
    /// Whether a surface that scatters light of a lamp first at `p` lies in its near field. Local
    /// coordinates.
    [[nodiscard]] bool scatters_near(const BoundSource& light, const Vec3& p) const;
    /// Whether light of a lamp that hits a region at `p` does so in the near field.
    [[nodiscard]] bool lights_near(
        const BoundSource& light, std::uint32_t region, const Vec3& p) const;

    /// The shortest distance over which points are connected with vertices in the near field, local
    /// units: the geometry term of a connection grows as 1 / distance^2 too.
    [[nodiscard]] double min_connection_distance(const BoundSource& light) const {
        return lamp_of(light).min_connection_distance;
    }

    /// The least distance of a box from a lamp and from all vertices in its near field, local
    /// units.
    [[nodiscard]] double gap_to(const BoundSource& light, const Bounds& box) const;
    /// The radius of the near field for scattered light; 0: there is none.
    [[nodiscard]] double scatter_radius(const BoundSource& light) const {
        return lamp_of(light).scatter_radius;
    }

    /// The irradiance of a lamp outside its near field, mean over its light there, for a spectrum
    /// of 1; 0 for other lights.
    [[nodiscard]] double irradiance(const BoundSource& light) const {
        return lamp_of(light).irradiance;
    }

  private:
    struct Lamp {
        BoundingSphere body;
        double scatter_radius = 0;  ///< within which scattered light is near; 0: none is
        double min_connection_distance = 0;
        double organ_part = 0;    ///< distance over the size of an organ within which its direct
                                  ///< light is near; 0: none is
        bool is_bounded = false;  ///< bounded irradiance, and no line
        double irradiance = 0;
        Vec3 half_line;  ///< LampExtent::half_line
    };
    [[nodiscard]] const Lamp& lamp_of(const BoundSource& light) const {
        return lamps_[prepared_.lights().index_of(light)];
    }
    /// The first hit of a path from a lamp.
    struct PilotSample {
        double distance = 0;  ///< from the lamp's centre, or the nearest point of a line
        Vec3 p;
        std::uint32_t region = 0;
        double irradiance = 0;  ///< there, for a spectrum of 1
    };
    [[nodiscard]] double irradiance_at(const BoundSource& light, const CastHit& at) const;
    [[nodiscard]] std::vector<PilotSample> pilot_samples(
        const BoundSource& light, const LampExtent& lamp) const;
    /// @param usual  BoundSource::usual_irradiance
    [[nodiscard]] double radius_about(
        const std::vector<PilotSample>& samples, const LampExtent& extent, double usual) const;

    const PreparedScene& prepared_;
    std::vector<Lamp> lamps_;         // one for each light
    std::vector<double> organ_size_;  // by region: root of its organ's area, local units
    bool any_ = false;
};

}  // namespace quasimc
