#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/vec3.h"
#include "optics/side.h"
#include "quasimc/material.h"
#include "quasimc/mesh.h"

namespace quasimc {

/// A two-sided surface, immutable.
class Material {
  public:
    /// @param upper, lower  of the same number of bands
    Material(std::string name, Side upper, Side lower);

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] const Side& side(SurfaceSide side) const {
        return side == SurfaceSide::upper ? upper_ : lower_;
    }
    [[nodiscard]] std::size_t bands() const { return upper_.albedo().size(); }
    /// Whether the albedo of both sides is the same for light from every direction: absorbed light
    /// then follows from incident light.
    [[nodiscard]] bool has_constant_albedo() const {
        return upper_.has_constant_albedo() && lower_.has_constant_albedo();
    }
    /// Whether light passes unchanged (transmittance 1 in the direction of incidence, both sides,
    /// all bands): a sensor. Such hits are scored and do not change the path.
    [[nodiscard]] bool is_transparent() const { return transparent_; }

    /// Samples light backwards: for light that leaves along `wo` on the side with normal `n`
    /// (dot(wo, n) > 0), samples the direction from which it came. On return wi is the direction in
    /// which that light travels, and weights have become w_b * BSDF_b(wi, wo) |dot(wi, n)| /
    /// density of wi, in which q_k are formed with the lobes that lead to this side: those
    /// reflected on it and those transmitted through from the other (their sum may exceed 1:
    /// survival is then certain and the weights grow). Narrow lobes are not combined with others,
    /// so that light through them is separate.
    struct Gathered {
        Vec3 wi;
        bool narrow = false;  ///< by a lobe that add_reflected() omits
    };
    [[nodiscard]] std::optional<Gathered> gather(
        const Vec3& n,
        SurfaceSide side,
        const Vec3& wo,
        const Draw& draw,
        std::span<double> weights) const;

    /// BSDF_b(wi, wo) * |dot(wi, n)| for each band, without narrow lobes (those whose
    /// peak_brightness() is `narrow_from` or more): the radiance along `wo` on the side `side` with
    /// normal `n`, per irradiance on a plane facing light that travels along `wi`, from either
    /// side. Adds factor * that * weights[b] to out[b].
    void add_reflected(
        const Vec3& n,
        SurfaceSide side,
        const Vec3& wo,
        const Vec3& wi,
        double factor,
        std::span<const double> weights,
        std::span<double> out,
        double narrow_from = kNarrowPeak) const;

  private:
    std::string name_;
    Side upper_, lower_;
    LobeTable to_upper_, to_lower_;  ///< the lobes that lead to a side
    bool transparent_ = false;
};

/// The material of a specification that has no fault. Equal lobes of several bands are merged.
[[nodiscard]] Material make_material(const MaterialSpec& spec, std::size_t bands);

}  // namespace quasimc
