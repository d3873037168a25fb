#include "solvers/ray_bundles/bundle_exchange.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/checks.h"
#include "base/parallel.h"
#include "samplers/hash.h"
#include "solvers/ray_bundles/for_bands.h"
#include "solvers/ray_bundles/line_exchange.h"

namespace quasimc {
namespace {

/// Lines that are kept take so many numbers of 4 bytes.
constexpr std::size_t kMostKept = std::size_t{1} << 21U;
/// Directions nearer to the horizon would follow lines through an endless canopy for ever; light
/// that goes so flat is 1e-10 of what falls on the horizontal.
constexpr double kFlattest = 1e-5;

/// The number of a direction that has this purpose, in [0, 1).
double number_of(const BundleGroup& group, std::uint64_t direction, std::uint64_t purpose) {
    return unit_number(mix64(group.key ^ mix64(4 * direction + purpose + 1)));
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
    kept_.clear();
    beams_.clear();
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
    const bool is_kept = light.packs().size() > 1;
    const auto exchange = [&](std::uint64_t block, unsigned thread) {
        const Columns& lines = *columns_[thread];
        stretches += lines.size();
        // Each of the directions stands for 2 pi / n, which goes with 1 / pi of the cosine law.
        const Beam beam{
            bundle_direction(group, static_cast<std::uint32_t>(block)),
            2 * lines.line_area() / group.directions};
        light.count_lines(lines.counts(), beam.weight);
        if (!is_kept) {
            exchange_along(lines, beam, light, tell);
            return;
        }
        if (kept_.size() + lines.size() > kMostKept) {
            exchange_kept(threads, light, tell);
        }
        kept_.add(lines);
        beams_.push_back(beam);
    };
    ordered_blocks(group.directions, threads, draw, exchange);
    if (is_kept) {
        exchange_kept(threads, light, tell);
    }
    return stretches;
}

/// In bands of one pack.
void BundleExchange::exchange_along(
    const Columns& lines, const Beam& beam, PatchLight& light, const Tell& tell) {
    const bool finds_ends = static_cast<bool>(tell.on_ends);
    found_.begin(light.columns(), finds_ends ? lines.size() : 0);
    exchange_pack(lines, beam, {0, finds_ends}, light, found_);
    tell_found(beam, found_, tell);
}

/// Lets light go along all lines that were kept, pack by pack. The first one finds their ends, if
/// somebody asks for them.
void BundleExchange::exchange_kept(unsigned threads, PatchLight& light, const Tell& tell) {
    std::vector<std::size_t> packs;
    for (std::size_t pack = 0; pack < light.packs().size(); ++pack) {
        if (!light.rests(pack)) {
            packs.push_back(pack);
        }
    }
    const bool finds_ends = static_cast<bool>(tell.on_ends);
    std::vector<Found> found(beams_.size());
    for (std::size_t i = 0; i < beams_.size(); ++i) {
        found[i].begin(light.columns(), finds_ends ? kept_.beam(i).size() : 0);
    }
    parallel_blocks(packs.size(), threads, [&](std::uint64_t block, unsigned) {
        for (std::size_t i = 0; i < beams_.size(); ++i) {
            const Pack pack{packs[block], finds_ends && block == 0};
            exchange_pack(kept_.beam(i), beams_[i], pack, light, found[i]);
        }
    });
    for (std::size_t i = 0; i < beams_.size(); ++i) {
        tell_found(beams_[i], found[i], tell);
    }
    kept_.clear();
    beams_.clear();
}

template <typename Lines>
void BundleExchange::exchange_pack(
    const Lines& lines, const Beam& beam, const Pack& pack, PatchLight& light, Found& found) {
    const PatchSides<0> sides = light.sides(pack.index);
    const std::size_t bands = light.packs()[pack.index].bands;
    std::array<double, 2 * kMostInPack> forwards{}, backwards{};
    std::uint32_t* const ends = pack.finds_ends ? found.ends.data() : nullptr;
    const bool has_sensors = patches_.prepared.optics().has_transparent;
    for_bands(bands, [&]<std::size_t kBands>() {
        LineExchange<2 * kBands> along(sides, beam.weight, forwards, backwards, ends);
        lines.for_each_line([&](std::span<const Columns::Passed> line) {
            has_sensors ? along.exchange_through_sensors(line) : along.exchange(line);
        });
        if (pack.finds_ends) {
            found.end_count = static_cast<std::size_t>(along.ends() - ends);
        }
    });
    for (std::size_t i = 0; i < 2 * bands; ++i) {
        found.forwards[light.column(pack.index, i)] = forwards[i];
        found.backwards[light.column(pack.index, i)] = backwards[i];
    }
}

void BundleExchange::tell_found(const Beam& beam, const Found& found, const Tell& tell) {
    if (tell.on_escape) {
        tell.on_escape(beam.direction, found.forwards);
        tell.on_escape(-1 * beam.direction, found.backwards);
    }
    if (tell.on_ends) {
        tell.on_ends(std::span(found.ends).first(found.end_count), beam.direction, beam.weight);
    }
}

}  // namespace quasimc
