#include "light/daylight/diffuse_fraction.h"

#include <algorithm>

namespace quasimc {

double diffuse_fraction_erbs(double clearness) {
    const double k = clearness;
    if (k <= 0.22) {
        return 1 - 0.09 * k;
    }
    if (k <= 0.80) {
        return 0.9511 + k * (-0.1604 + k * (4.388 + k * (-16.638 + k * 12.336)));
    }
    return 0.165;
}

double diffuse_fraction_reindl(double clearness, double sine) {
    const double k = clearness;
    if (k <= 0.3) {
        return std::min(1.0, 1.020 - 0.254 * k + 0.0123 * sine);
    }
    if (k < 0.78) {
        return std::clamp(1.400 - 1.749 * k + 0.177 * sine, 0.1, 0.97);
    }
    return std::clamp(0.486 * k - 0.182 * sine, 0.1, 1.0);
}

double diffuse_fraction_spitters(double clearness, double sine) {
    const double k = clearness;
    const double clear = 0.847 - 1.61 * sine + 1.04 * sine * sine;
    const double bend = (1.47 - clear) / 1.66;
    if (k <= 0.22) {
        return 1;
    }
    if (k <= 0.35) {
        return 1 - 6.4 * (k - 0.22) * (k - 0.22);
    }
    return k <= bend ? 1.47 - 1.66 * k : clear;
}

double diffuse_fraction(DiffuseModel model, double clearness, double sine) {
    switch (model) {
        case DiffuseModel::reindl:
            return diffuse_fraction_reindl(clearness, sine);
        case DiffuseModel::spitters:
            return diffuse_fraction_spitters(clearness, sine);
        default:
            return diffuse_fraction_erbs(clearness);
    }
}

}  // namespace quasimc
