#include "coupling/sky_file.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "base/text.h"
#include "coupling/lighting.h"
#include "text/line_scanner.h"

namespace quasimc {
namespace {

constexpr double kMaxAlongAnAxis = 1e4, kMaxCells = 1e6;

/// Reads cells azimuth by azimuth, from the horizon up: azimuth, elevation and radiance of each.
std::optional<SkyTable> read_cells(Values& numbers, std::size_t azimuths, std::size_t elevations) {
    SkyTable table = plant_sky_table(azimuths, elevations);
    const std::size_t cells = table.radiance.size();
    for (std::size_t i = 0; i < cells; ++i) {
        const std::string cell = fmt::format("cell {} of {}", i + 1, cells);
        static_cast<void>(numbers.number("the azimuth of " + cell));
        static_cast<void>(numbers.number("the elevation of " + cell));
        const auto radiance = numbers.number("the radiance of " + cell, kNotNegativeNumber);
        if (!radiance) {
            return std::nullopt;
        }
        const std::size_t azimuth = i / elevations, elevation = i % elevations;
        table.radiance[elevation * azimuths + azimuth] = *radiance;
    }
    return table;
}

/// Reads samples of a distribution function, zenith angle by zenith angle. @param each  numbers per
/// sample, of which the first is used
std::optional<std::vector<double>> read_samples(
    Values& numbers, std::size_t samples, std::size_t each) {
    std::vector<double> values;
    for (std::size_t i = 0; i < samples; ++i) {
        const std::string sample = fmt::format("sample {} of {}", i + 1, samples);
        const auto value = numbers.number("the distribution function at " + sample);
        if (!value || (each == 2 && !numbers.number("the intensity of " + sample))) {
            return std::nullopt;
        }
        values.push_back(*value);
    }
    return values;
}

/// Reads a distribution function of zenith angle (fastest, 0 to 90 degrees) and azimuth (a full
/// turn, from north (z) to east (x)). Its increment over a cell of equal angles is the radiance
/// there.
std::optional<SkyTable> read_distribution(
    Values& numbers, std::size_t zeniths, std::size_t azimuths, std::size_t each) {
    const auto samples = read_samples(numbers, zeniths * azimuths, each);
    if (!samples) {
        return std::nullopt;
    }
    numbers.notice(
        "this is a distribution function as in MonteCarlo: its increase over a cell is used as the "
        "radiance of the cell, and the first angle as the zenith angle");
    const auto value = [&](std::size_t z, std::size_t a) { return (*samples)[a * zeniths + z]; };
    // Plant axes z and x are x and y here.
    SkyTable table{azimuths - 1, zeniths - 1, {}, 0, 1};
    constexpr double kRounding = 4e-6;  // of four numbers with six digits
    const double least = -kRounding * *std::max_element(samples->begin(), samples->end());
    for (std::size_t e = 0; e < table.elevations; ++e) {
        const std::size_t z = table.elevations - 1 - e;
        for (std::size_t a = 0; a < table.azimuths; ++a) {
            const double growth =
                value(z + 1, a + 1) - value(z, a + 1) - value(z + 1, a) + value(z, a);
            if (!(growth >= least)) {
                numbers.fault(
                    fmt::format(
                        "the distribution function falls by {:.3g} between samples {} and {}",
                        -growth, a * zeniths + z + 1, (a + 1) * zeniths + z + 2),
                    "radiances must not be negative");
                return std::nullopt;
            }
            table.radiance.push_back(std::max(0.0, growth));
        }
    }
    return table;
}

std::optional<SkyTable> read_counted(Values& numbers, std::size_t first, std::size_t second) {
    const std::size_t cells = first * second, count = numbers.words_left();
    const bool is_grid = first > 1 && second > 1;
    if (is_grid && (count == cells || count == 2 * cells)) {
        return read_distribution(numbers, first, second, count / cells);
    }
    if (count < 3 * cells) {
        numbers.fault(
            fmt::format("{} x {} cells, but {} numbers", first, second, count),
            fmt::format(
                "a sky has {} (azimuth, elevation and radiance of each cell), a distribution "
                "function {}",
                3 * cells, cells));
        return std::nullopt;
    }
    return read_cells(numbers, first, second);
}

}  // namespace

std::string sky_file_numbers(std::string_view text) {
    std::string joined;
    LineScanner lines(text);
    while (lines.next()) {
        const std::string_view line = trimmed(lines.line());
        if (!line.starts_with("//") && !line.starts_with('#')) {
            joined.append(line).append(" ");
        }
    }
    return joined;
}

std::optional<SkyTable> read_sky_table(Values& numbers) {
    const auto first = numbers.integer("the number of azimuths", {1, kMaxAlongAnAxis});
    const auto second = numbers.integer("the number of elevations", {1, kMaxAlongAnAxis});
    if (!first || !second) {
        return std::nullopt;
    }
    const double cells = static_cast<double>(*first) * static_cast<double>(*second);
    if (cells > kMaxCells) {
        numbers.fault(fmt::format("{} cells", cells), "at most a million are read");
        return std::nullopt;
    }
    std::optional<SkyTable> table =
        read_counted(numbers, static_cast<std::size_t>(*first), static_cast<std::size_t>(*second));
    const auto is_lit = [](double radiance) { return radiance > 0; };
    if (table && std::none_of(table->radiance.begin(), table->radiance.end(), is_lit)) {
        numbers.fault("all radiances are 0", "the sky is black");
        return std::nullopt;
    }
    return table;
}

}  // namespace quasimc
