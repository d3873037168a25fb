// Preetham, Shirley and Smits (1999), "A practical analytic model for daylight", SIGGRAPH 99,
// 91-100: the luminance of table 2, a formula of Perez et al. (1993) fitted to skies of a
// turbidity.

#include <cmath>

#include "base/checks.h"
#include "light/models/perez_formula.h"
#include "light/models/source.h"

namespace quasimc {

SkyShape preetham_shape(double turbidity, const Vec3& to_sun) {
    EXPECT(turbidity >= kLowestTurbidity && turbidity <= kHighestTurbidity);
    const double t = turbidity;
    const PerezFormula formula{
        0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251, 0.1206 * t - 2.5771,
        -0.0670 * t + 0.3703};
    return {[formula, to_sun](const Vec3& d) { return formula.radiance(d, to_sun); }, {}, {}};
}

}  // namespace quasimc
