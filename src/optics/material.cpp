#include "optics/material.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/checks.h"

namespace quasimc {
namespace {

/// The lobes that scatter light to a side: its own reflected and the other's transmitted.
LobeTable lobes_leading_to(const Side& side, const Side& other) {
    std::vector<Lobe> lobes;
    for (const Lobe& lobe : side.lobes()) {
        if (lobe.shape->hemisphere() == Hemisphere::reflected) {
            lobes.push_back(lobe);
        }
    }
    for (const Lobe& lobe : other.lobes()) {
        if (lobe.shape->hemisphere() == Hemisphere::transmitted) {
            lobes.push_back(lobe);
        }
    }
    return {lobes, side.albedo().size()};
}

bool passes_everything(const Side& side) {
    const auto is_one = [](double albedo) { return albedo == 1; };
    return side.lobes().size() == 1 && side.has_delta() && side.has_constant_albedo() &&
           side.lobes()[0].shape->hemisphere() == Hemisphere::transmitted &&
           std::all_of(side.albedo().begin(), side.albedo().end(), is_one);
}

/// A lobe sampled backwards, of a surface with normal `n` on the side where light leaves along
/// `wo`. `value` is BSDF |cos wi| at albedo 1, `density` that with which the reversed lobe samples
/// wi. For a reciprocal lobe of constant albedo they are equal.
struct Backwards {
    double value, density;
};

/// Whether value and density of the lobe are equal backwards.
bool is_symmetric(const LobeTable::Row& row) {
    return row.reciprocal && row.constant;
}

Backwards backwards(const LobeTable::Row& row, const Vec3& n, const Vec3& wi, const Vec3& wo) {
    const double density = row.shape->pdf(n, -wo, -wi);
    if (is_symmetric(row)) {
        return {density, density};
    }
    const Vec3 arrival_normal = row.sign * n;
    return {row.shape->bsdf(arrival_normal, wi, wo) * std::abs(dot(wi, n)), density};
}

/// value / density of a lobe that alone can give `wi`; not finite exactly along the surface.
double backwards_ratio(const LobeTable::Row& row, const Vec3& n, const Vec3& wi, const Vec3& wo) {
    if (is_symmetric(row)) {
        return 1;
    }
    if (row.delta) {
        return row.relative_albedo(n, wi);
    }
    const auto [value, density] = backwards(row, n, wi, wo);
    return value / density;
}

}  // namespace

Material::Material(std::string name, Side upper, Side lower)
    : name_(std::move(name)),
      upper_(std::move(upper)),
      lower_(std::move(lower)),
      to_upper_(lobes_leading_to(upper_, lower_)),
      to_lower_(lobes_leading_to(lower_, upper_)),
      transparent_(passes_everything(upper_) && passes_everything(lower_)) {
    EXPECT(upper_.albedo().size() == lower_.albedo().size());
}

std::optional<Material::Gathered> Material::gather(
    const Vec3& n,
    SurfaceSide side,
    const Vec3& wo,
    const Draw& draw,
    std::span<double> weights) const {
    const LobeTable& table = side == SurfaceSide::upper ? to_upper_ : to_lower_;
    const LobeTable::Choice choice = table.choose(draw, weights);
    if (choice.row == nullptr) {
        return std::nullopt;
    }
    const LobeTable::Row& row = *choice.row;
    const Vec3 wi = -row.sample(n, -wo, choice.u, draw.u1);

    if (!row.alone) {
        LobeMix mix(table, weights);
        for (const LobeTable::Row& other : table.rows()) {
            if (other.shares(row) && other.narrow == row.narrow) {
                const auto [value, density] = backwards(other, n, wi, wo);
                mix.add(other, value, density);
            }
        }
        return mix.apply(choice.total) ? std::optional(Gathered{wi, row.narrow}) : std::nullopt;
    }

    const double ratio = backwards_ratio(row, n, wi, wo);
    if (!std::isfinite(ratio)) {
        return std::nullopt;  // exactly along the surface, where no light is
    }
    table.follow(row, ratio * choice.scale, weights);
    return Gathered{wi, row.narrow};
}

// NOLINTNEXTLINE(readability-function-size): eight arguments, none of which belong together.
void Material::add_reflected(
    const Vec3& n,
    SurfaceSide side,
    const Vec3& wo,
    const Vec3& wi,
    double factor,
    std::span<const double> weights,
    std::span<double> out,
    double narrow_from) const {
    const LobeTable& table = side == SurfaceSide::upper ? to_upper_ : to_lower_;
    const double cosine = dot(wi, n);
    const double sign = cosine < 0 ? 1 : -1;
    for (const LobeTable::Row& row : table.rows()) {
        if (row.peak >= narrow_from || row.sign != sign) {
            continue;
        }
        const double bsdf =
            row.lambertian ? std::numbers::inv_pi : row.shape->bsdf(sign * n, wi, wo);
        table.add(row, factor * std::abs(cosine) * bsdf, weights, out);
    }
}

}  // namespace quasimc
