#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "base/surface_side.h"
#include "base/vec3.h"
#include "optics/catalogue.h"
#include "optics/side.h"

namespace quasimc {

/// What a person says of one side of a surface in one waveband: light that arrives on this side.
/// Models are those of the catalogue, with their parameters by name; one that a model does not take
/// is passed over.
struct SideOptics {
    double reflectance = 0;  ///< rho, 0..1; fraction that leaves on the side it came from
    double transmittance =
        0;  ///< tau, 0..1; fraction that leaves on the other side; rho + tau <= 1
    std::string reflection_model = "lambertian";
    BsdfParameters reflection_parameters = {};
    std::string transmission_model = "lambertian";
    BsdfParameters transmission_parameters = {};

    friend bool operator==(const SideOptics&, const SideOptics&) = default;
};

/// A material as a person states it; one SideOptics per band.
struct MaterialSpec {
    std::string name;
    std::vector<SideOptics> upper, lower;

    friend bool operator==(const MaterialSpec&, const MaterialSpec&) = default;
};

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
    /// Whether the albedo of both sides is the same for light from every direction: what is
    /// absorbed then follows from what arrives.
    [[nodiscard]] bool has_constant_albedo() const {
        return upper_.has_constant_albedo() && lower_.has_constant_albedo();
    }
    /// Whether light passes as if nothing were there (transmittance 1 straight on, both sides, all
    /// bands): a sensor. Such hits are counted and change nothing.
    [[nodiscard]] bool is_transparent() const { return transparent_; }

    /// Light seen backwards: given that light leaves along `wo` on the side with normal `n`
    /// (dot(wo, n) > 0), draws where it may have come from. On return wi is the direction in which
    /// that light travels, and weights have become
    /// w_b * BSDF_b(wi, wo) |dot(wi, n)| / density of wi, in which q_k are formed with the lobes
    /// that lead to this side: those reflected on it and those transmitted through from the other
    /// (their sum may exceed 1: survival is then certain and the weights grow).
    struct Gathered {
        Vec3 wi;
        bool delta = false;
    };
    [[nodiscard]] std::optional<Gathered> gather(
        const Vec3& n,
        SurfaceSide side,
        const Vec3& wo,
        const Draw& draw,
        std::span<double> weights) const;

    /// BSDF_b(wi, wo) * |dot(wi, n)| for each band, lobes of one direction left out: the radiance
    /// along `wo` on the side with normal `n` (`side` tells which) per irradiance on a plane
    /// facing light that travels along `wi`, from either side. Adds factor * that * weights[b] to
    /// out[b].
    void add_reflected(
        const Vec3& n,
        SurfaceSide side,
        const Vec3& wo,
        const Vec3& wi,
        double factor,
        std::span<const double> weights,
        std::span<double> out) const;

  private:
    std::string name_;
    Side upper_, lower_;
    LobeTable to_upper_, to_lower_;  ///< the lobes that lead to a side
    bool transparent_ = false;
};

/// Checks a stated material (every number finite and in range, rho + tau <= 1 in each band and
/// side, known model names, every parameter stated and in its domain, `bands` entries a side); adds
/// every fault to `faults`, at "place, upper side, band 2". Bands count from 1.
/// @param place  where the material stands; empty for "material 'name'"
void check_material(
    const MaterialSpec& spec, std::size_t bands, const std::string& place, Faults& faults);

/// The material of a specification that has no fault. Equal lobes of several bands are merged.
[[nodiscard]] Material make_material(const MaterialSpec& spec, std::size_t bands);

}  // namespace quasimc
