#pragma once

#include <cstdint>
#include <vector>

#include "transport/prepared_scene.h"

namespace quasimc {

/// Which light of a lamp is followed from the lamp, because it falls on something near, where the
/// light grows as 1 / distance^2: few directions drawn elsewhere find such a place, and what they
/// find has a variance without bound. A function of the lamp and of the place where its light falls
/// first, so that what is looked for and what is followed are disjoint and together complete.
class NearLamps {
  public:
    explicit NearLamps(const PreparedScene& prepared);

    /// Whether some light falls so near its lamp that it is followed.
    [[nodiscard]] bool any() const { return any_; }
    /// Whether light that a surface scatters at `place` is near: the first it meets. Local
    /// coordinates.
    [[nodiscard]] bool scatters_near(const BoundSource& light, const Vec3& place) const;
    /// Whether light that falls on a region at `place` is near.
    [[nodiscard]] bool lights_near(
        const BoundSource& light, std::uint32_t region, const Vec3& place) const;

    /// From places near a lamp its light goes on. What goes further than so to the next surface may
    /// be looked for from there, what goes less is followed: it grows as 1 / distance^2 too. Local
    /// units.
    [[nodiscard]] double leg(const BoundSource& light) const { return lamp_of(light).leg; }

    /// How far at least what lies in a box is from a lamp and all places where its light is
    /// scattered near it, local units.
    [[nodiscard]] double gap_to(const BoundSource& light, const Bounds& box) const;
    /// The radius within which light of a lamp is scattered near it; 0: none is.
    [[nodiscard]] double scatter_radius(const BoundSource& light) const {
        return lamp_of(light).scatter_radius;
    }

    /// Of what a lamp lights, and paths from organs look for: the irradiance, mean over its light,
    /// for a spectrum of 1. Other lights: 0.
    [[nodiscard]] double irradiance(const BoundSource& light) const {
        return lamp_of(light).irradiance;
    }

  private:
    struct Lamp {
        Ball body;
        double scatter_radius = 0;  ///< within which scattered light is near; 0: none is
        double leg = 0;             ///< see leg()
        double organ_part = 0;      ///< of the size of an organ, within which light on it is
                                    ///< near; 0: none is
        bool is_bounded = false;    ///< its irradiance, and it is no line
        double irradiance = 0;
        Vec3 half_line;  ///< LampPlace::half_line
    };
    [[nodiscard]] const Lamp& lamp_of(const BoundSource& light) const {
        return lamps_[static_cast<std::size_t>(&light - prepared_.lights().data())];
    }
    /// What a path from a lamp met.
    struct Trial {
        double distance = 0;  ///< from the lamp's centre, of a line from the nearest of its points
        Vec3 place;
        std::uint32_t region = 0;
        double irradiance = 0;  ///< there, for a spectrum of 1
    };
    [[nodiscard]] double irradiance_at(const BoundSource& light, const CastHit& at) const;
    [[nodiscard]] std::vector<Trial> trials_of(
        const BoundSource& light, const LampPlace& lamp) const;
    /// @param usual  BoundSource::usual_irradiance
    [[nodiscard]] double radius_about(
        const std::vector<Trial>& trials, const LampPlace& place, double usual) const;

    const PreparedScene& prepared_;
    std::vector<Lamp> lamps_;         // one for each light
    std::vector<double> organ_size_;  // by region: root of its organ's area, local units
    bool any_ = false;
};

}  // namespace quasimc
