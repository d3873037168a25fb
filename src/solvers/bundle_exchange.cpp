#include "solvers/bundle_exchange.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/checks.h"
#include "base/parallel.h"
#include "samplers/hash.h"
#include "solvers/for_bands.h"

namespace quasimc {
namespace {

/// Directions nearer to the horizon would follow lines through an endless canopy for ever; light
/// that goes so flat is 1e-10 of what falls on the horizontal.
constexpr double kFlattest = 1e-5;

/// The number of a direction that has this purpose, in [0, 1).
double number_of(const BundleGroup& group, std::uint64_t direction, std::uint64_t purpose) {
    return unit_number(mix64(group.key ^ mix64(4 * direction + purpose + 1)));
}

/// Exchanges along one line. `kColumns` 0: as many as the light has.
template <std::size_t kColumns>
class LineExchange {
  public:
    LineExchange(
        const PatchSides<0>& sides,
        double weight,
        std::span<double> forwards,
        std::span<double> backwards,
        std::uint32_t* ends)
        : sides_(sides),
          weight_(weight),
          forwards_(forwards.data()),
          backwards_(backwards.data()),
          next_end_(ends) {}

    /// @param line  without sensors
    void exchange(std::span<const Columns::Passed> line) {
        fetch_ahead(line[0]);
        add(backwards_, sides_.exitance(line[0]));
        for (std::size_t i = 1; i < line.size(); ++i) {
            fetch_ahead(line[i]);
            const std::size_t left = line[i - 1] ^ 1U;
            const std::size_t right = line[i];
            add(sides_.incident(right), sides_.exitance(left));
            add(sides_.incident(left), sides_.exitance(right));
        }
        end(line.back() ^ 1U);
    }

    /// Light passes sensors, which count it.
    void exchange_through_sensors(std::span<const Columns::Passed> line) {
        std::uint32_t last = 0;        // side that light leaves forwards
        const double* from = nullptr;  // its exitance
        double* to = backwards_;       // where light goes that travels backwards
        std::size_t first = 0;         // sensor since then
        for (std::size_t i = 0; i < line.size(); ++i) {
            fetch_ahead(line[i]);
            if ((line[i] & Columns::kSensor) != 0) {
                continue;
            }
            const std::size_t at = line[i];
            pass_sensors(line.subspan(first, i - first), from, sides_.exitance(at));
            add(to, sides_.exitance(at));
            if (from != nullptr) {
                add(sides_.incident(at), from);
            }
            last = line[i] ^ 1U;
            from = sides_.exitance(last);
            to = sides_.incident(last);
            first = i + 1;
        }
        pass_sensors(line.subspan(first), from, nullptr);
        if (from != nullptr) {
            end(last);
        }
    }

    /// Behind the sides from which lines left the scene.
    [[nodiscard]] const std::uint32_t* ends() const { return next_end_; }

  private:
    /// A line leaves the scene.
    void end(std::uint32_t side) {
        add(forwards_, sides_.exitance(side));
        *next_end_++ = side;
    }
    /// What leaves a side and what comes to one never overlap: several columns are added at once.
    void add(double* __restrict to, const double* __restrict from) {
        const double weight = weight_;
        for (std::size_t c = 0; c < sides_.columns(); ++c) {
            to[c] += weight * from[c];
        }
    }
    /// Asks for the patch that is passed some steps later: each step would wait for it else.
    void fetch_ahead(const Columns::Passed& passed) const {
        const Columns::Passed later = *(&passed + Columns::kReadAhead) & ~Columns::kSensor;
        sides_.fetch(later / 2);
    }
    void pass_sensors(
        std::span<const Columns::Passed> sensors, const double* forwards, const double* backwards) {
        for (const Columns::Passed passed : sensors) {
            const std::size_t front = passed & ~Columns::kSensor;
            if (forwards != nullptr) {
                add(sides_.incident(front), forwards);
            }
            if (backwards != nullptr) {
                add(sides_.incident(front ^ 1U), backwards);
            }
        }
    }

    PatchSides<kColumns> sides_;
    double weight_;
    double *forwards_, *backwards_;
    std::uint32_t* next_end_;
};

/// @returns behind the sides from which lines left the scene
template <std::size_t kColumns>
const std::uint32_t* exchange_lines(
    const Columns& lines, bool has_sensors, LineExchange<kColumns> along) {
    lines.for_each_line([&](std::span<const Columns::Passed> line) {
        has_sensors ? along.exchange_through_sensors(line) : along.exchange(line);
    });
    return along.ends();
}

}  // namespace

Vec3 bundle_direction(const BundleGroup& group, std::uint32_t i) {
    EXPECT(group.directions % 2 == 0);
    const double up = number_of(group, ~std::uint64_t{0}, 0);
    const double turn = number_of(group, ~std::uint64_t{0}, 1);
    const double height = std::max(kFlattest, (i + (i % 2 == 0 ? up : 1 - up)) / group.directions);
    const double turns = i * (std::numbers::phi - 1) + turn;
    const double angle = 2 * std::numbers::pi * (turns - std::floor(turns));
    const double flat = std::sqrt(std::max(0.0, 1 - height * height));
    return {flat * std::cos(angle), flat * std::sin(angle), height};
}

std::uint64_t BundleExchange::exchange(
    const BundleGroup& group, unsigned threads, PatchLight& light, const Tell& tell) {
    while (columns_.size() < std::max(threads, 1U)) {
        columns_.push_back(std::make_unique<Columns>());
    }
    std::uint64_t stretches = 0;
    const auto draw = [&](std::uint64_t block, unsigned thread) {
        const auto i = static_cast<std::uint32_t>(block);
        columns_[thread]->draw(
            seen_, patches_.drawn,
            {.direction = bundle_direction(group, i),
             .rotation = number_of(group, i, 0),
             .shift_s = number_of(group, i, 1),
             .shift_t = number_of(group, i, 2),
             .line_area = group.line_area});
    };
    const auto exchange = [&](std::uint64_t block, unsigned thread) {
        const Columns& lines = *columns_[thread];
        // Each of the directions stands for 2 pi / n, which goes with 1 / pi of the cosine law.
        const double weight = 2 * lines.line_area() / group.directions;
        exchange_along(
            lines, bundle_direction(group, static_cast<std::uint32_t>(block)), weight, light, tell);
        stretches += lines.size();
    };
    ordered_blocks(group.directions, threads, draw, exchange);
    return stretches;
}

void BundleExchange::exchange_along(
    const Columns& lines,
    const Vec3& direction,
    double weight,
    PatchLight& light,
    const Tell& tell) {
    light.count_lines(lines.counts(), weight);
    forwards_.assign(light.columns(), 0);
    backwards_.assign(light.columns(), 0);
    ends_.resize(std::max(ends_.size(), lines.size()));  // more than enough
    const std::uint32_t* behind_ends = nullptr;
    const bool has_sensors = patches_.prepared.has_transparent();
    for_bands(light.columns() / 2, [&]<std::size_t kBands>() {
        behind_ends = exchange_lines(
            lines, has_sensors,
            LineExchange<2 * kBands>(light.sides(), weight, forwards_, backwards_, ends_.data()));
    });
    if (tell.on_escape) {
        tell.on_escape(direction, forwards_);
        tell.on_escape(-1 * direction, backwards_);
    }
    if (tell.on_ends) {
        tell.on_ends({ends_.data(), behind_ends}, direction, weight);
    }
}

}  // namespace quasimc
