#include "lattice_merit.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/checks.h"

namespace quasimc {
namespace {

constexpr std::size_t kMaxOrder = 8;
constexpr std::uint32_t kMaxLag = 128;
constexpr double kMinPairMerit = 0.2;

using Vector = std::array<std::int64_t, kMaxOrder>;

long double dot(const Vector& a, const Vector& b) {
    long double sum = 0;
    for (std::size_t i = 0; i < kMaxOrder; ++i)
        sum += static_cast<long double>(a[i]) * static_cast<long double>(b[i]);
    return sum;
}

/// A basis of a lattice with its Gram-Schmidt coefficients and the squared lengths of the
/// orthogonal vectors.
class Basis {
  public:
    explicit Basis(std::size_t order) : order_(order) {}

    Vector& operator[](std::size_t i) { return rows_[i]; }

    /// Makes the basis short and nearly orthogonal, with Lovasz' constant 0.99.
    void reduce() {
        orthogonalize(0);
        std::size_t k = 1;
        while (k < order_) {
            shorten(k);
            if (length2_[k] >= (0.99L - mu_[k][k - 1] * mu_[k][k - 1]) * length2_[k - 1]) {
                ++k;
                continue;
            }
            std::swap(rows_[k], rows_[k - 1]);
            orthogonalize(k - 1);
            k = std::max<std::size_t>(k - 1, 1);
        }
    }

    /// Squared length of the shortest nonzero vector; after reduce().
    long double shortest() {
        best_ = dot(rows_[0], rows_[0]);
        for (std::size_t i = 1; i < order_; ++i)
            best_ = std::min(best_, dot(rows_[i], rows_[i]));
        enumerate(order_, 0, false);
        return best_;
    }

  private:
    /// Recomputes the coefficients of rows first, first + 1, ....
    void orthogonalize(std::size_t first) {
        for (std::size_t i = first; i < order_; ++i) {
            length2_[i] = dot(rows_[i], rows_[i]);
            for (std::size_t j = 0; j < i; ++j) {
                long double r = dot(rows_[i], rows_[j]);
                for (std::size_t l = 0; l < j; ++l)
                    r -= mu_[j][l] * mu_[i][l] * length2_[l];
                mu_[i][j] = r / length2_[j];
                length2_[i] -= mu_[i][j] * r;
            }
        }
    }

    /// Subtracts multiples of the earlier rows from row k.
    void shorten(std::size_t k) {
        bool changed = true;
        for (int pass = 0; changed && pass < 8; ++pass) {
            changed = false;
            for (std::size_t j = k; j-- > 0;) {
                const auto factor = static_cast<std::int64_t>(std::llround(mu_[k][j]));
                if (factor == 0)
                    continue;
                changed = true;
                for (std::size_t i = 0; i < order_; ++i)
                    rows_[k][i] -= factor * rows_[j][i];
                for (std::size_t l = 0; l < j; ++l)
                    mu_[k][l] -= static_cast<long double>(factor) * mu_[j][l];
                mu_[k][j] -= static_cast<long double>(factor);
            }
            if (changed)
                orthogonalize(k);
        }
    }

    /// Tries all coefficients of row level - 1 that keep the vector below the best; the
    /// coefficients of later rows are in coefficients_, and contribute `length2`. A vector and its
    /// negative count once.
    void enumerate(std::size_t level, long double length2, bool nonzero) {
        if (level == 0) {
            if (nonzero)
                best_ = std::min(best_, length2);
            return;
        }
        const std::size_t row = level - 1;
        long double centre = 0;
        for (std::size_t i = level; i < order_; ++i)
            centre -= static_cast<long double>(coefficients_[i]) * mu_[i][row];
        const long double radius = std::sqrt(std::max(0.0L, best_ - length2) / length2_[row]);
        const auto from = nonzero ? static_cast<std::int64_t>(std::ceil(centre - radius)) : 0;
        const auto to = static_cast<std::int64_t>(std::floor(centre + radius));
        for (std::int64_t c = from; c <= to; ++c) {
            const long double distance = static_cast<long double>(c) - centre;
            const long double longer = length2 + distance * distance * length2_[row];
            if (longer >= best_ * (1 + 1e-12L))
                continue;
            coefficients_[row] = c;
            enumerate(row, longer, nonzero || c != 0);
        }
    }

    std::size_t order_;
    std::array<Vector, kMaxOrder> rows_{};
    std::array<std::array<long double, kMaxOrder>, kMaxOrder> mu_{};
    std::array<long double, kMaxOrder> length2_{};
    std::array<std::int64_t, kMaxOrder> coefficients_{};
    long double best_ = 0;
};

/// The inverse of an odd number mod 2^64, by Newton's iteration.
std::uint64_t inverse(std::uint64_t odd) {
    std::uint64_t x = odd;
    for (int i = 0; i < 6; ++i)
        x *= 2 - odd * x;
    return x;
}

/// a^exponent mod 2^64.
std::uint64_t power(std::uint64_t a, std::uint32_t exponent) {
    std::uint64_t result = 1;
    for (; exponent != 0; exponent >>= 1, a *= a)
        if ((exponent & 1U) != 0)
            result *= a;
    return result;
}

/// The worst merit so far of a lattice whose coordinates are powers of one number.
class Worst {
  public:
    Worst(std::uint64_t n, std::uint64_t a, std::uint32_t dimensions, double floor)
        : n_(n), dimensions_(dimensions), floor_(floor) {
        powers_[0] = 1;
        for (std::size_t i = 1; i < powers_.size(); ++i)
            powers_[i] = powers_[i - 1] * a;
    }

    double merit() const { return merit_; }

    /// Includes a projection, given by ascending coordinates; false once the merit is below the
    /// floor.
    bool take(std::span<const std::uint32_t> coordinates) {
        if (coordinates.back() >= dimensions_)
            return true;
        std::array<std::uint64_t, kMaxOrder> z{};
        for (std::size_t i = 0; i < coordinates.size(); ++i)
            z[i] = powers_[coordinates[i]];
        merit_ = std::min(merit_, spectral_merit(n_, std::span(z).first(coordinates.size())));
        return merit_ >= floor_;
    }

  private:
    std::uint64_t n_;
    std::uint32_t dimensions_;
    double floor_;
    std::array<std::uint64_t, 16> powers_{};
    double merit_ = 1;
};

/// The projections of korobov_merit, those of low order and small lags first.
const std::vector<std::vector<std::uint32_t>>& merit_projections() {
    static const auto projections = [] {
        std::vector<std::vector<std::uint32_t>> all;
        for (std::uint32_t i = 1; i < 16; ++i)
            all.push_back({0, i});
        for (std::uint32_t j = 2; j < 12; ++j)
            for (std::uint32_t i = 1; i < j; ++i)
                all.push_back({0, i, j});
        for (std::uint32_t k = 3; k < 8; ++k)
            for (std::uint32_t j = 2; j < k; ++j)
                for (std::uint32_t i = 1; i < j; ++i)
                    all.push_back({0, i, j, k});
        for (std::uint32_t s = 5; s <= kMaxOrder; ++s) {
            all.emplace_back();
            for (std::uint32_t i = 0; i < s; ++i)
                all.back().push_back(i);
        }
        return all;
    }();
    return projections;
}

}  // namespace

double shortest_dual_vector(std::uint64_t n, std::span<const std::uint64_t> z) {
    EXPECT(std::has_single_bit(n) && n <= std::uint64_t{1} << 40);
    EXPECT(!z.empty() && z.size() <= kMaxOrder);
    const auto odd = static_cast<std::size_t>(
        std::find_if(z.begin(), z.end(), [](std::uint64_t x) { return x % 2 == 1; }) - z.begin());
    EXPECT(odd < z.size());
    Basis basis(z.size());
    for (std::size_t i = 0; i < z.size(); ++i) {
        basis[i][odd] = -static_cast<std::int64_t>(z[i] * inverse(z[odd]) % n);
        basis[i][i] = 1;
    }
    basis[odd][odd] = static_cast<std::int64_t>(n);
    basis.reduce();
    return static_cast<double>(std::sqrt(basis.shortest()));
}

double spectral_merit(std::uint64_t n, std::span<const std::uint64_t> z) {
    // Square roots of Hermite's constants: Conway and Sloane, "Sphere packings, lattices and
    // groups", table 1.2.
    static constexpr std::array kHermite{1.0,     1.0,     1.07457, 1.12246, 1.18921,
                                         1.23114, 1.29049, 1.34590, 1.41421};
    const auto order = static_cast<double>(z.size());
    return shortest_dual_vector(n, z) /
           (kHermite[z.size()] * std::pow(static_cast<double>(n), 1 / order));
}

double korobov_pair_merit(std::uint64_t n, std::uint64_t a, std::uint32_t lag) {
    return spectral_merit(n, std::array{std::uint64_t{1}, power(a, lag)});
}

double korobov_serial_merit(std::uint64_t n, std::uint64_t a, std::uint32_t s) {
    EXPECT(s >= 1 && s <= kMaxOrder);
    std::array<std::uint64_t, kMaxOrder> z{};
    for (std::uint32_t i = 0; i < s; ++i)
        z[i] = power(a, i);
    return spectral_merit(n, std::span(z).first(s));
}

double korobov_merit(std::uint64_t n, std::uint64_t a, std::uint32_t dimensions, double floor) {
    Worst worst(n, a, dimensions, floor);
    for (const auto& projection : merit_projections())
        if (!worst.take(projection))
            break;
    return worst.merit();
}

std::uint32_t korobov_dimensions(std::uint64_t n, std::uint64_t a) {
    // A pair with the vector (1, 1) or (1, -1) is bad for any number of points: each coordinate
    // determines the other.
    constexpr double kSame = 1.42;
    std::uint32_t lag = 1;
    for (; lag < kMaxLag; ++lag) {
        const std::array z{std::uint64_t{1}, power(a, lag)};
        if (shortest_dual_vector(n, z) < kSame || spectral_merit(n, z) < kMinPairMerit)
            break;
    }
    return lag;
}

}  // namespace quasimc
