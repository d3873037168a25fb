// Costs of the units of work: `./dev bench costs` measures them.

#include "planner/work_cost.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sums/sum_data.h"

namespace quasimc {
namespace {

/// ns, by WorkUnit.
constexpr std::array<double, kWorkUnits> kNanoseconds{30, 270, 60, 48, 0.8, 15, 5, 29, 14};
/// A ray takes its time for each halving of the triangles, and longer in a periodic scene.
constexpr double kPeriodic = 1.5;

}  // namespace

double nanoseconds_of(WorkUnit unit) {
    return kNanoseconds[static_cast<std::size_t>(unit)];
}

double seconds_of_unit(const Sums& sums, const Scene& scene, WorkUnit unit, double nanoseconds) {
    constexpr double kNano = 1e-9;
    const double halvings = std::log2(std::max(2., static_cast<double>(scene.triangle_count())));
    const double of_ray = halvings * (scene.cell().periodic() ? kPeriodic : 1);
    return kNano * nanoseconds * static_cast<double>(work_of(*sums, unit)) *
           (unit == WorkUnit::ray ? of_ray : 1);
}

double seconds_of_work(const Sums& sums, const Scene& scene) {
    double sum = 0;
    for (std::size_t i = 0; i < kWorkUnits; ++i) {
        const auto unit = static_cast<WorkUnit>(i);
        sum += seconds_of_unit(sums, scene, unit, nanoseconds_of(unit));
    }
    return sum;
}

}  // namespace quasimc
