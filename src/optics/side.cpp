#include "optics/side.h"

#include <algorithm>

#include "base/checks.h"

namespace quasimc {
namespace {

bool same_shape(const Bsdf& a, const Bsdf& b) {
    return a.hemisphere() == b.hemisphere() && a.has_constant_albedo() && b.has_constant_albedo() &&
           ((a.is_delta() && b.is_delta()) || (a.is_lambertian() && b.is_lambertian()));
}

std::vector<Lobe> merged(const std::vector<Lobe>& lobes) {
    std::vector<Lobe> result;
    for (const Lobe& lobe : lobes) {
        const bool is_black = std::all_of(
            lobe.albedo.begin(), lobe.albedo.end(), [](double albedo) { return albedo == 0; });
        if (is_black) {
            continue;
        }
        const auto same = std::find_if(result.begin(), result.end(), [&](const Lobe& other) {
            return same_shape(*other.shape, *lobe.shape);
        });
        if (same == result.end()) {
            result.push_back(lobe);
            continue;
        }
        for (std::size_t b = 0; b < lobe.albedo.size(); ++b) {
            same->albedo[b] += lobe.albedo[b];
        }
    }
    return result;
}

}  // namespace

Side::Side(const std::vector<Lobe>& lobes, std::size_t bands)
    : lobes_(merged(lobes)), table_(lobes_, bands), albedo_(bands), absorptance_(bands) {
    for (const Lobe& lobe : lobes_) {
        has_delta_ = has_delta_ || lobe.shape->is_delta();
        largest_peak_ = std::max(largest_peak_, peak_brightness(*lobe.shape));
        for (std::size_t b = 0; b < bands; ++b) {
            albedo_[b] += lobe.albedo[b];
        }
    }
    for (std::size_t b = 0; b < bands; ++b) {
        absorptance_[b] = 1 - albedo_[b];
    }
}

double Side::albedo(std::size_t band, double cosine) const {
    if (has_constant_albedo()) {
        return albedo_[band];
    }
    double sum = 0;
    for (const Lobe& lobe : lobes_) {
        sum += lobe.shape->relative_albedo(cosine) * lobe.albedo[band];
    }
    return sum;
}

std::optional<Side::Scattered> Side::scatter(
    const Vec3& n, const Vec3& wi, const Draw& draw, std::span<double> weights) const {
    const LobeTable::Choice choice = table_.choose(n, wi, draw, weights);
    if (choice.row == nullptr) {
        return std::nullopt;
    }
    return scatter_by(choice, n, wi, draw.u1, weights);
}

Side::Scattered Side::scatter_by(
    const LobeTable::Choice& choice,
    const Vec3& n,
    const Vec3& wi,
    double u1,
    std::span<double> weights) const {
    const LobeTable::Row& row = *choice.row;
    const Scattered scattered{row.sample(n, wi, choice.u, u1), row.delta};
    if (weights.size() == 1) {
        weights[0] *= choice.total;  // 1 after Russian roulette
        return scattered;
    }
    if (!row.alone) {
        LobeMix mix(table_, weights);
        for (const LobeTable::Row& other : table_.rows()) {
            if (other.shares(row)) {
                const double density =
                    other.relative_albedo(n, wi) * other.shape->pdf(n, wi, scattered.wo);
                mix.add(other, density, density);
            }
        }
        if (mix.apply(choice.total)) {
            return scattered;
        }
    }
    table_.follow(row, choice.scale * row.relative_albedo(n, wi), weights);
    return scattered;
}

Side::Scattered Side::scatter_by_alone(
    const LobeTable::Choice& choice,
    const Vec3& n,
    const Vec3& wi,
    double u1,
    std::span<double> weights) const {
    const LobeTable::Row& row = *choice.row;
    table_.follow(row, choice.scale * row.relative_albedo(n, wi), weights);
    return {row.sample(n, wi, choice.u, u1), row.delta};
}

void Side::add_scattered(
    const Vec3& n,
    const Vec3& wi,
    const Vec3& wo,
    double narrow_from,
    std::span<const double> weights,
    std::span<double> out) const {
    for (const LobeTable::Row& row : table_.rows()) {
        if (row.peak < narrow_from) {
            table_.add(row, row.relative_albedo(n, wi) * row.shape->pdf(n, wi, wo), weights, out);
        }
    }
}

}  // namespace quasimc
