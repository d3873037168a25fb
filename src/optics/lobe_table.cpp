#include "optics/lobe_table.h"

#include <algorithm>
#include <cmath>

#include "base/checks.h"
#include "base/distribution.h"
#include "optics/directions.h"

namespace quasimc {
namespace {

constexpr std::size_t kLanes = 8;

// The additions of long arrays go to eight partial sums, so that they need not wait for each other.
// The order is fixed: the same bits with any compiler and vector unit.

double total_of(const std::array<double, kLanes>& s) {
    return ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]));
}

double sum_of_many(const double* a, std::size_t count) {
    std::array<double, kLanes> s{};
    std::size_t i = 0;
    for (; i + kLanes <= count; i += kLanes) {
        for (std::size_t j = 0; j < kLanes; ++j) {
            s[j] += a[i + j];
        }
    }
    for (std::size_t j = 0; i + j < count; ++j) {
        s[j] += a[i + j];
    }
    return total_of(s);
}

double sum_of_many_products(const double* a, const double* b, std::size_t count) {
    std::array<double, kLanes> s{};
    std::size_t i = 0;
    for (; i + kLanes <= count; i += kLanes) {
        for (std::size_t j = 0; j < kLanes; ++j) {
            s[j] += a[i + j] * b[i + j];
        }
    }
    for (std::size_t j = 0; i + j < count; ++j) {
        s[j] += a[i + j] * b[i + j];
    }
    return total_of(s);
}

inline double sum(const double* a, std::size_t count) {
    if (count >= kLanes) {
        return sum_of_many(a, count);
    }
    double result = 0;
    for (std::size_t i = 0; i < count; ++i) {
        result += a[i];
    }
    return result;
}

inline double sum_of_products(const double* a, const double* b, std::size_t count) {
    if (count >= kLanes) {
        return sum_of_many_products(a, b, count);
    }
    double result = 0;
    for (std::size_t i = 0; i < count; ++i) {
        result += a[i] * b[i];
    }
    return result;
}

}  // namespace

LobeTable::LobeTable(std::span<const Lobe> lobes, std::size_t bands) : bands_(bands) {
    std::vector<double> sums(bands);
    for (const Lobe& lobe : lobes) {
        EXPECT(lobe.albedo.size() == bands);
        const auto is_positive = [](double a) { return a > 0; };
        const auto begin = std::find_if(lobe.albedo.begin(), lobe.albedo.end(), is_positive);
        const auto end = std::find_if(lobe.albedo.rbegin(), lobe.albedo.rend(), is_positive).base();
        EXPECT(begin != lobe.albedo.end());
        rows_.push_back(
            {.shape = lobe.shape,
             .begin = static_cast<std::size_t>(begin - lobe.albedo.begin()),
             .end = static_cast<std::size_t>(end - lobe.albedo.begin()),
             .offset = albedo_.size(),
             .sign = lobe.shape->hemisphere() == Hemisphere::reflected ? 1.0 : -1.0,
             .delta = lobe.shape->is_delta(),
             .lambertian = lobe.shape->is_lambertian(),
             .reciprocal = lobe.shape->is_reciprocal(),
             .narrow = is_narrow(*lobe.shape),
             .peak = peak_brightness(*lobe.shape),
             .alone = true,
             .constant = lobe.shape->has_constant_albedo()});
        EXPECT(rows_.back().constant || !rows_.back().lambertian);
        constant_ = constant_ && rows_.back().constant;
        albedo_.insert(albedo_.end(), lobe.albedo.begin(), lobe.albedo.end());
        std::transform(
            sums.begin(), sums.end(), lobe.albedo.begin(), sums.begin(), std::plus<double>());
    }
    for (Row& row : rows_) {
        row.alone = 1 >= std::count_if(rows_.begin(), rows_.end(), [&](const Row& other) {
                        return row.shares(other);
                    });
    }
    largest_sum_ = sums.empty() ? 0 : *std::max_element(sums.begin(), sums.end());
}

Vec3 LobeTable::Row::sample(const Vec3& n, const Vec3& wi, double u0, double u1) const {
    return lambertian ? cosine_direction(sign * n, u0, u1) : shape->sample(n, wi, u0, u1);
}

double LobeTable::power(const Row& row, std::span<const double> weights) const {
    return sum_of_products(
        &albedo_[row.offset + row.begin], &weights[row.begin], row.end - row.begin);
}

/// Avoids branches on the outcome, which no processor could predict.
template <typename Power>
LobeTable::Choice LobeTable::choose_among(double u0, double total, const Power& power_of) const {
    if (rows_.empty()) {
        return {};
    }
    const double target = u0 * total;
    std::size_t chosen = 0;
    double share = power_of(rows_[0]);
    double start = 0;
    double end = share;
    for (std::size_t k = 1; k < rows_.size(); ++k) {
        const double power = power_of(rows_[k]);
        const bool beyond = target >= end;
        chosen = beyond ? k : chosen;
        share = beyond ? power : share;
        start = beyond ? end : start;
        end += power;
    }
    const double rest = target - start;
    const bool is_certain = total <= end && share > 0;  // for any rounding of `target`
    if (!(rest < share || is_certain)) {
        return {};
    }
    return {&rows_[chosen], std::min(rest / share, kBelowOne), total, total / share};
}

/// @param share_of  gives the fraction of its given albedo that a lobe scatters
/// @param largest_sum  largest sum of the albedos of all lobes over the bands
template <typename Share>
LobeTable::Choice LobeTable::choose_by(
    const Draw& draw,
    std::span<const double> weights,
    const Share& share_of,
    double largest_sum) const {
    EXPECT(weights.size() == bands_);
    if (bands_ == 1) {
        if (!(weights[0] > 0)) {
            return {};
        }
        // Relative to the weight. Most light is below the threshold and needs no division.
        const double whole =
            weights[0] <= draw.roulette_threshold ? 1 : draw.roulette_threshold / weights[0];
        const double total = std::max(largest_sum, whole);
        return choose_among(draw.u0, total, [this, &share_of](const Row& row) {
            return share_of(row) * albedo_[row.offset];
        });
    }
    const auto power_of = [this, weights, &share_of](const Row& row) {
        return share_of(row) *
               sum_of_products(
                   &albedo_[row.offset + row.begin], &weights[row.begin], row.end - row.begin);
    };
    double total = sum(weights.data(), bands_);
    if (largest_sum > 1 || draw.roulette_threshold < total) {
        double powers = 0;
        for (const Row& row : rows_) {
            powers += power_of(row);
        }
        total = std::max(std::min(total, draw.roulette_threshold), powers);
    }
    return choose_among(draw.u0, total, power_of);
}

LobeTable::Choice LobeTable::choose(const Draw& draw, std::span<const double> weights) const {
    return choose_by(
        draw, weights, [](const Row&) { return 1.0; }, largest_sum_);
}

LobeTable::Choice LobeTable::choose(
    const Vec3& n, const Vec3& wi, const Draw& draw, std::span<const double> weights) const {
    if (constant_) {
        return choose(draw, weights);
    }
    const auto share_of = [&n, &wi](const Row& row) { return row.relative_albedo(n, wi); };
    double largest_sum = largest_sum_;
    if (bands_ == 1) {
        largest_sum = 0;
        for (const Row& row : rows_) {
            largest_sum += share_of(row) * albedo_[row.offset];
        }
    }
    return choose_by(draw, weights, share_of, largest_sum);
}

void LobeTable::follow(const Row& row, double factor, std::span<double> weights) const {
    const double* albedo = albedo_.data() + row.offset;
    for (std::size_t b = 0; b < bands_; ++b) {
        weights[b] *= factor * albedo[b];
    }
}

void LobeTable::add(
    const Row& row, double factor, std::span<const double> weights, std::span<double> out) const {
    const double* albedo = albedo_.data() + row.offset;
    for (std::size_t b = row.begin; b < row.end; ++b) {
        out[b] += factor * albedo[b] * weights[b];
    }
}

LobeMix::LobeMix(const LobeTable& table, std::span<double> weights)
    : table_(table), weights_(weights) {
    if (weights.size() > kInline) {
        large_.resize(weights.size());
        sums_ = large_.data();
    } else {
        std::fill_n(small_.begin(), weights.size(), 0.0);
        sums_ = small_.data();
    }
}

void LobeMix::add(const LobeTable::Row& row, double value, double density) {
    density_ += density * table_.power(row, weights_);
    const double* albedo = table_.albedo(row).data();
    for (std::size_t b = row.begin; b < row.end; ++b) {
        sums_[b] += value * albedo[b];
    }
}

bool LobeMix::apply(double total) {
    const double factor = total / density_;
    if (!(density_ > 0) || !std::isfinite(factor)) {
        return false;
    }
    for (std::size_t b = 0; b < weights_.size(); ++b) {
        weights_[b] *= factor * sums_[b];
    }
    return true;
}

}  // namespace quasimc
