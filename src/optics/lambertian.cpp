#include "optics/lambertian.h"

#include <algorithm>

#include "optics/directions.h"

namespace quasimc {
namespace {

class Lambertian final : public Bsdf {
  public:
    using Bsdf::Bsdf;

    [[nodiscard]] Vec3 sample(
        const Vec3& n, const Vec3& /*wi*/, double u0, double u1) const override {
        return cosine_direction(hemisphere() == Hemisphere::reflected ? n : -n, u0, u1);
    }

    [[nodiscard]] double pdf(const Vec3& n, const Vec3& /*wi*/, const Vec3& wo) const override {
        return std::max(0.0, outgoing_cosine(hemisphere(), n, wo)) * std::numbers::inv_pi;
    }

    [[nodiscard]] double bsdf(const Vec3& n, const Vec3& /*wi*/, const Vec3& wo) const override {
        return outgoing_cosine(hemisphere(), n, wo) >= 0 ? std::numbers::inv_pi : 0;
    }

    [[nodiscard]] ModelParameters parameters() const override { return {"lambertian", {}}; }
    [[nodiscard]] bool is_reciprocal() const override { return true; }
    [[nodiscard]] bool is_lambertian() const override { return true; }
};

}  // namespace

std::unique_ptr<Bsdf> make_lambertian(Hemisphere hemisphere) {
    return std::make_unique<Lambertian>(hemisphere);
}

}  // namespace quasimc
