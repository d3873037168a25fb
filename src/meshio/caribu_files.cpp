#include "meshio/caribu_files.h"

#include <algorithm>

#include <fmt/format.h>

#include "meshio/number_line.h"
#include "text/line_scanner.h"
#include "text/numbers.h"

namespace quasimc {
namespace {

/// The numbers of a line of optics, in which "d" marks diffuse surfaces; empty after a fault.
std::optional<std::vector<double>> fractions_of_line(
    std::string_view line, std::uint32_t number, Reporter& reporter) {
    std::vector<double> fractions;
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
        if (word == "d") {
            continue;
        }
        const std::optional<double> fraction = parse_real(word);
        if (!fraction || !(*fraction >= 0 && *fraction <= 1)) {
            reporter.fault(number, shown(word) + " is not a number from 0 to 1", "");
            return std::nullopt;
        }
        fractions.push_back(*fraction);
    }
    return fractions;
}

void read_species(
    const std::vector<double>& f, std::uint32_t line, CaribuOptics& optics, Reporter& reporter) {
    constexpr std::size_t kNumbers = 5;
    if (f.size() != kNumbers) {
        reporter.fault(
            line, fmt::format("a species has {} numbers", f.size()),
            "write e d STEM d UPPER_R UPPER_T d LOWER_R LOWER_T");
    } else if (f[1] + f[2] > 1 || f[3] + f[4] > 1) {
        reporter.fault(line, "reflectance + transmittance of a leaf exceeds 1", "");
    } else {
        optics.species.push_back({{f[0], 0}, {f[1], f[2]}, {f[3], f[4]}});
    }
}

}  // namespace

CaribuOptics read_caribu_optics(std::string_view bytes, Reporter& reporter) {
    CaribuOptics optics;
    std::optional<std::int64_t> given;
    LineScanner scanner(bytes);
    while (scanner.next() && !reporter.is_full()) {
        std::string_view line = scanner.line().substr(0, scanner.line().find('#'));
        const std::string_view word = take_word(line);
        if (word == "n") {
            given = parse_integer(take_word(line));
        } else if (word == "s" || word == "e") {
            const auto fractions = fractions_of_line(line, scanner.number(), reporter);
            if (fractions && word == "e") {
                read_species(*fractions, scanner.number(), optics, reporter);
            } else if (fractions && fractions->size() != 1) {
                reporter.fault(scanner.number(), "a soil needs one number", "write s d SOIL");
            } else if (fractions) {
                optics.soil = fractions->front();
            }
        } else if (!word.empty()) {
            reporter.fault(
                scanner.number(), shown(word) + " is not the beginning of a line of optics",
                "lines must begin with n (number of species), s (soil) or e (a species)");
        }
    }
    const auto count = static_cast<std::int64_t>(optics.species.size());
    if (reporter.faults.empty() && given.value_or(count) != count) {
        reporter.faults.add(
            {reporter.file, fmt::format("says {} species and has {}", *given, count), "", ""});
    }
    return optics;
}

std::vector<CaribuLight> read_caribu_light(std::string_view bytes, Reporter& reporter) {
    const std::string rule = "a line contains the irradiance on the horizontal and a direction";
    std::vector<CaribuLight> lights;
    const auto add = [&](const std::vector<double>& numbers, std::uint32_t line) {
        if (numbers[0] < 0) {
            reporter.fault(line, "the irradiance is negative", rule);
        } else {
            lights.push_back({numbers[0], point_at(numbers, 1)});
        }
    };
    take_number_lines(bytes, 4, rule, reporter, add);
    if (lights.empty() && reporter.faults.empty()) {
        reporter.faults.add({reporter.file, "contains no light", rule, ""});
    }
    return lights;
}

std::optional<std::array<double, 4>> read_caribu_pattern(
    std::string_view bytes, Reporter& reporter) {
    const std::string rule = "it must contain x y of two corners";
    std::vector<double> all;
    LineScanner scanner(bytes);
    while (scanner.next() && !reporter.is_full()) {
        const std::string_view line = scanner.line().substr(0, scanner.line().find('#'));
        const auto numbers = numbers_of_line(line, scanner.number(), rule, reporter);
        for (const double x : numbers.value_or(std::vector<double>())) {
            all.push_back(x);
        }
    }
    if (!reporter.faults.empty()) {
        return std::nullopt;
    }
    if (all.size() != 4 || all[0] == all[2] || all[1] == all[3]) {
        reporter.faults.add({reporter.file, "is not a rectangle", rule, ""});
        return std::nullopt;
    }
    return std::array{
        std::min(all[0], all[2]), std::min(all[1], all[3]), std::max(all[0], all[2]),
        std::max(all[1], all[3])};
}

}  // namespace quasimc
