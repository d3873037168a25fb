#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/distribution.h"
#include "light/models/pattern.h"
#include "light/models/source.h"

namespace quasimc {
namespace {

using std::numbers::pi;

/// Position of x between ascending values: the interval, and the fraction in it.
struct AngleBetween {
    std::size_t interval = 0;
    double part = 0;
};
AngleBetween angle_between(const std::vector<double>& values, double x) {
    if (values.size() == 1) {
        return {};
    }
    const std::size_t i = interval_between(values, x);
    return {i, std::clamp((x - values[i]) / (values[i + 1] - values[i]), 0.0, 1.0)};
}

/// The azimuth in the file for `phi_deg`, 0 to 360 about the aim. Files count counterclockwise as
/// seen from above a lamp aimed down: about the opposite of its aim.
double folded(double phi_deg, double last_deg) {
    if (last_deg == 0) {
        return 0;
    }
    const double of_file = 360 - phi_deg;
    const double half = of_file > 180 && last_deg <= 180 ? phi_deg : of_file;
    return half > 90 && last_deg <= 90 ? 180 - half : half;
}

double intensity_of(const PhotometricWeb& web, double theta, double phi) {
    const AngleBetween v = angle_between(web.vertical_deg, theta * 180 / pi);
    const AngleBetween h =
        angle_between(web.horizontal_deg, folded(phi * 180 / pi, web.horizontal_deg.back()));
    const std::size_t rows = web.vertical_deg.size();
    const auto at = [&](std::size_t column) {
        const double* candela = &web.candela[column * rows + v.interval];
        return candela[0] + v.part * (candela[1] - candela[0]);
    };
    const double low = at(h.interval);
    return h.part > 0 ? low + h.part * (at(h.interval + 1) - low) : low;
}

/// All azimuths, radians, where the intensity has a kink.
std::vector<double> bends(const std::vector<double>& horizontal_deg) {
    const double last = horizontal_deg.back();
    std::vector<double> all{0, 2 * pi};
    const auto add = [&](double deg) {
        if (last > 0 && deg > 0 && deg < 360) {
            all.push_back(deg * pi / 180);
        }
    };
    for (const double deg : horizontal_deg) {
        add(360 - deg);
        if (last <= 180) {
            add(deg);
        }
        if (last <= 90) {
            add(180 - deg);
            add(180 + deg);
        }
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

}  // namespace

Pattern web_pattern(PhotometricWeb web) {
    std::vector<double> thetas;
    for (const double deg : web.vertical_deg) {
        thetas.push_back(deg * pi / 180);
    }
    constexpr double kLongest = pi / 72;
    const std::vector<double> azimuths = bends(web.horizontal_deg);
    const double widest = azimuths.size() == 2 ? 2 * pi : kLongest;
    return {
        [web = std::move(web)](double theta, double phi) { return intensity_of(web, theta, phi); },
        refined(thetas, kLongest, 1), refined(azimuths, widest, 1)};
}

}  // namespace quasimc
