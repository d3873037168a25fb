#include "optics/mirror.h"

#include "optics/directions.h"

namespace quasimc {
namespace {

class Mirror final : public Bsdf {
  public:
    using Bsdf::Bsdf;

    [[nodiscard]] Vec3 sample(
        const Vec3& n, const Vec3& wi, double /*u0*/, double /*u1*/) const override {
        return specular_direction(hemisphere(), n, wi);
    }

    [[nodiscard]] double pdf(
        const Vec3& /*n*/, const Vec3& /*wi*/, const Vec3& /*wo*/) const override {
        return 0;
    }

    [[nodiscard]] bool is_delta() const override { return true; }
    [[nodiscard]] ModelParameters parameters() const override { return {"mirror", {}}; }
    [[nodiscard]] bool is_reciprocal() const override { return true; }
};

}  // namespace

std::unique_ptr<Bsdf> make_mirror(Hemisphere hemisphere) {
    return std::make_unique<Mirror>(hemisphere);
}

}  // namespace quasimc
