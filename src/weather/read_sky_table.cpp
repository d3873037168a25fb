#include "weather/read_sky_table.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "text/line_scanner.h"
#include "text/numbers.h"

namespace quasimc {
namespace {

constexpr std::int64_t kMaxCells = 1 << 20;

/// Reads the numbers of a sky line by line.
class SkyFile {
  public:
    SkyFile(std::string_view text, const std::string& name) : scanner_(text), name_(name) {}

    SkyTable read(SkyFileFormat format) {
        SkyTable table;
        if (read_size(table)) {
            table.radiance.assign(table.azimuths * table.elevations, 0.0);
            format == SkyFileFormat::cells ? read_rings(table) : read_cells(table);
            if (next_line()) {
                fault("is one line too many", "the cells are complete before it");
            }
            check_light(table);
        }
        faults_.throw_if_any();
        return table;
    }

  private:
    void fault(std::string problem, std::string why, std::string suggestion = {}) {
        const bool is_known = scanner_.number() > 0;
        faults_.add(
            {is_known ? fmt::format("{}:{}", name_, scanner_.number()) : name_, std::move(problem),
             std::move(why), std::move(suggestion)});
    }

    static constexpr std::size_t kMaxFaults = 100;

    /// Goes to the next line with content; "#" begins a comment.
    bool next_line() {
        while (scanner_.next()) {
            line_ = scanner_.line();
            line_ = line_.substr(0, line_.find('#'));
            if (line_.find_first_not_of(" \t\r\v\f") != std::string_view::npos) {
                return true;
            }
        }
        return false;
    }

    bool read_size(SkyTable& table) {
        if (!next_line()) {
            fault("is empty", "it must begin with the numbers of azimuths and elevations");
            return false;
        }
        const auto azimuths = parse_integer(take_word(line_));
        const auto elevations = parse_integer(take_word(line_));
        const bool is_good = azimuths && elevations && *azimuths >= 1 && *elevations >= 1 &&
                             *azimuths <= kMaxCells && *elevations <= kMaxCells &&
                             *azimuths * *elevations <= kMaxCells;
        if (!is_good || !take_word(line_).empty()) {
            fault(
                "does not give the size of the table",
                fmt::format(
                    "the first line must contain the numbers of azimuths and elevations, at most "
                    "{} cells",
                    kMaxCells));
            return false;
        }
        table.azimuths = static_cast<std::size_t>(*azimuths);
        table.elevations = static_cast<std::size_t>(*elevations);
        return true;
    }

    /// A number of at least 0; 0 after a fault.
    double value(std::string_view word) {
        const auto number = parse_real(word);
        if (!number || !std::isfinite(*number) || *number < 0) {
            fault(
                word.empty() ? "a value is missing" : shown(word) + " is not a value of a sky",
                "it must be a finite number, 0 or more");
            return 0;
        }
        return *number;
    }

    /// Goes to the line of `what`; false after a fault.
    bool advance(std::string_view what, std::size_t index, std::size_t count) {
        if (faults_.size() >= kMaxFaults) {
            return false;
        }
        if (!next_line()) {
            fault(
                fmt::format("ends after {} of {} {}", index, count, what),
                "the first line gives their number");
            return false;
        }
        return true;
    }

    void read_rings(SkyTable& table) {
        for (std::size_t e = 0; e < table.elevations; ++e) {
            if (!advance("rings", e, table.elevations)) {
                return;
            }
            for (std::size_t a = 0; a < table.azimuths && faults_.size() < kMaxFaults; ++a) {
                table.radiance[e * table.azimuths + a] = value(take_word(line_));
            }
            if (!take_word(line_).empty()) {
                fault("has too many values", fmt::format("a ring has {}", table.azimuths));
            }
        }
    }

    void read_cells(SkyTable& table) {
        const std::size_t count = table.azimuths * table.elevations;
        for (std::size_t i = 0; i < count; ++i) {
            if (!advance("cells", i, count)) {
                return;
            }
            const bool has_angles = parse_real(take_word(line_)).has_value() &&
                                    parse_real(take_word(line_)).has_value();
            const double radiance = value(take_word(line_));
            if (!has_angles || !take_word(line_).empty()) {
                fault("is not a cell", "a cell is three numbers: azimuth elevation value");
            }
            table.radiance[i % table.elevations * table.azimuths + i / table.elevations] = radiance;
        }
    }

    void check_light(const SkyTable& table) {
        double sum = 0;
        for (const double radiance : table.radiance) {
            sum += radiance;
        }
        if (faults_.empty() && !(sum > 0 && std::isfinite(sum))) {
            faults_.add(
                {name_, "its values add up to " + fmt::format("{}", sum),
                 "a sky must have light somewhere", ""});
        }
    }

    LineScanner scanner_;
    std::string name_;
    std::string_view line_;
    Faults faults_;
};

/// Divides by the solid angle of each cell, up to a common factor.
void divide_by_solid_angle(SkyTable& table) {
    const auto sine = [&](std::size_t e) {
        return std::sin(
            std::numbers::pi / 2 * static_cast<double>(e) / static_cast<double>(table.elevations));
    };
    for (std::size_t e = 0; e < table.elevations; ++e) {
        for (std::size_t a = 0; a < table.azimuths; ++a) {
            table.radiance[e * table.azimuths + a] /= sine(e + 1) - sine(e);
        }
    }
}

}  // namespace

SkyTable read_sky_table(
    std::string_view text, const std::string& name, SkyFileFormat format, SkyValues values) {
    SkyTable table = SkyFile(text, name).read(format);
    if (values == SkyValues::flux) {
        divide_by_solid_angle(table);
    }
    table.turn = format == SkyFileFormat::cells ? -1 : 1;
    return table;
}

}  // namespace quasimc
