#include "weather/read_ies.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "base/text.h"
#include "text/line_scanner.h"
#include "text/numbers.h"

namespace quasimc {
namespace {

constexpr double kMaxAngles = 10000;
constexpr std::size_t kMaxIntensities = 1000000;
constexpr double kMaxIntensity = 1e30;
constexpr double kMetresPerFoot = 0.3048;

/// Reads the numbers of the file in sequence, across lines.
class Numbers {
  public:
    Numbers(LineScanner& scanner, Reporter& reporter) : scanner_(scanner), reporter_(reporter) {}

    /// The next number; 0 after a fault.
    double next(std::string_view what) {
        if (failed_) {
            return 0;
        }
        const std::string_view word = rest();
        const std::optional<double> value = parse_real(word);
        if (!value || !std::isfinite(*value)) {
            fail(
                word.empty() ? fmt::format("the file ends before {}", what)
                             : fmt::format("{} is not a number", shown(word)),
                word.empty() ? "" : fmt::format("it is {}", what));
            return 0;
        }
        return *value;
    }
    std::vector<double> list(std::size_t count, std::string_view what) {
        std::vector<double> values;
        for (std::size_t i = 0; i < count && !failed_; ++i) {
            values.push_back(next(what));
        }
        return values;
    }
    /// The first unread word; "" at the end of the file, which DOS marks by a character.
    std::string_view rest() {
        constexpr std::string_view kEndOfFile = "\x1A";
        std::string_view word = take();
        while (word.empty() && scanner_.next()) {
            line_ = scanner_.line();
            word = take();
        }
        return word == kEndOfFile ? std::string_view() : word;
    }
    void warn(const std::string& text) { reporter_.warn(text, scanner_.number()); }
    void fail(const std::string& problem, const std::string& why, const std::string& advice = "") {
        if (!failed_) {
            reporter_.fault(scanner_.number(), problem, why, advice);
        }
        failed_ = true;
    }
    [[nodiscard]] bool failed() const { return failed_; }

  private:
    /// Blanks or commas separate numbers.
    std::string_view take() { return take_word(line_, " \t,\v\f"); }

    LineScanner& scanner_;
    Reporter& reporter_;
    std::string_view line_;
    bool failed_ = false;
};

/// The value of the line TILT=, after the label and the keywords; empty if there is none.
std::optional<std::string> find_tilt(LineScanner& scanner) {
    while (scanner.next()) {
        const std::string_view line = trimmed(scanner.line());
        if (line.starts_with("TILT=")) {
            return std::string(trimmed(line.substr(5)));
        }
    }
    return std::nullopt;
}

/// Skips TILT=INCLUDE, the factors of a tilted lamp. The flux of a lamp is given in the run file,
/// so these factors (here, or in the file that TILT names) are ignored.
void skip_tilt(Numbers& numbers) {
    numbers.next("the lamp's position in the luminaire");
    const double pairs = numbers.next("the number of tilt angles");
    if (!(pairs >= 1 && pairs <= kMaxAngles) || pairs != std::floor(pairs)) {
        numbers.fail(fmt::format("{} tilt angles", shortest(pairs)), "a whole number, from 1");
        return;
    }
    numbers.list(static_cast<std::size_t>(2 * pairs), "tilt angles and factors");
}

/// Sets the opening from sizes in metres; negative numbers mark round ones (LM-63-2002, table 1).
void set_opening(double width, double length, IesFile& file) {
    if (width < 0) {
        file.radius_m = -0.5 * width;
        return;
    }
    file.width_m = width;
    file.length_m = std::max(0.0, length);
}

bool ascends(const std::vector<double>& angles) {
    return std::adjacent_find(angles.begin(), angles.end(), std::greater_equal<>()) == angles.end();
}

void check_angles(const PhotometricWeb& web, Numbers& numbers) {
    const auto& vertical = web.vertical_deg;
    const auto& horizontal = web.horizontal_deg;
    if (vertical.size() < 2 || !ascends(vertical) || vertical.front() < 0 ||
        vertical.back() > 180) {
        numbers.fail(
            "the vertical angles are not in order", "at least two, ascending from 0 to 180");
    } else if (
        horizontal.front() != 0 || !ascends(horizontal) ||
        (horizontal.back() != 0 && horizontal.back() != 90 && horizontal.back() != 180 &&
         horizontal.back() != 360)) {
        numbers.fail(
            fmt::format(
                "the horizontal angles go from {} to {}", shortest(horizontal.front()),
                shortest(horizontal.back())),
            "they ascend from 0 to 0, 90, 180 or 360");
    } else if (std::any_of(web.candela.begin(), web.candela.end(), [](double x) {
                   return !(x >= 0 && x <= kMaxIntensity);
               })) {
        numbers.fail(
            "an intensity is negative or too large",
            fmt::format("with its multipliers it is 0 to {} cd", kMaxIntensity));
    } else if (std::all_of(
                   web.candela.begin(), web.candela.end(), [](double x) { return x == 0; })) {
        numbers.fail("all intensities are 0", "the luminaire is dark");
    }
}

/// Metres per unit of length, by the number of the unit.
double unit_of_length(double number, Numbers& numbers) {
    constexpr double kFeet = 1, kMetres = 2;
    if (number != kFeet && number != kMetres) {
        numbers.fail(fmt::format("unit of length {}", shortest(number)), "1 is feet, 2 is metres");
    }
    return number == kFeet ? kMetresPerFoot : 1;
}

/// Converts a number to a count of angles.
std::size_t count_of(double value, std::string_view what, Numbers& numbers) {
    if (!(value >= 1 && value <= kMaxAngles) || value != std::floor(value)) {
        numbers.fail(
            fmt::format("{} {}", shortest(value), what),
            fmt::format("a whole number, 1 to {}", shortest(kMaxAngles)));
        return 0;
    }
    return static_cast<std::size_t>(value);
}

/// Skips to the number of lamps. @returns false  after a fault
bool pass_head(LineScanner& scanner, Numbers& numbers) {
    const std::optional<std::string> tilt = find_tilt(scanner);
    if (!tilt) {
        numbers.fail(
            "there is no line TILT=", "every IES file (LM-63) has one before its numbers",
            "convert a EULUMDAT file (.ldt) to IES, of photometric type C");
        return false;
    }
    if (*tilt == "INCLUDE") {
        skip_tilt(numbers);
    } else if (*tilt != "NONE") {
        numbers.warn(fmt::format(
            "TILT refers to {}, which is not read; its factors for tilted lamps are ignored",
            shown(*tilt)));
    }
    return true;
}

void warn_of_rest(Numbers& numbers) {
    if (const std::string_view word = numbers.rest(); !word.empty()) {
        numbers.warn(fmt::format(
            "{} follows the last intensity and is not read: are the numbers of angles right?",
            shown(word)));
    }
}

}  // namespace

IesFile read_ies(std::string_view text, Reporter& reporter) {
    IesFile file;
    LineScanner scanner(text);
    Numbers numbers(scanner, reporter);
    if (!pass_head(scanner, numbers)) {
        return file;
    }
    numbers.next("the number of lamps");
    numbers.next("the lumens of a lamp");
    const double multiplier = numbers.next("the multiplier of the intensities");
    const std::size_t rows =
        count_of(numbers.next("the number of vertical angles"), "vertical angles", numbers);
    const std::size_t columns =
        count_of(numbers.next("the number of horizontal angles"), "horizontal angles", numbers);
    if (rows * columns > kMaxIntensities) {
        numbers.fail(
            fmt::format("{} intensities", rows * columns),
            fmt::format("at most {}", kMaxIntensities));
    }
    const double type = numbers.next("the photometric type");
    if (type != 1) {
        numbers.fail(
            fmt::format("photometric type {}", shortest(type)),
            "only type C (1) is read; 2 and 3 are types B and A, of floodlights and headlamps",
            "convert the file to type C");
    }
    const double unit = unit_of_length(numbers.next("the unit of length"), numbers);
    const double width = numbers.next("the width of the opening");
    const double length = numbers.next("the length of the opening");
    numbers.next("the height of the opening");
    set_opening(unit * width, unit * length, file);
    const double ballast = numbers.next("the ballast factor");
    numbers.next("the ballast-lamp factor");
    numbers.next("the input watts");
    file.web.vertical_deg = numbers.list(rows, "the vertical angles");
    file.web.horizontal_deg = numbers.list(columns, "the horizontal angles");
    file.web.candela = numbers.list(rows * columns, "the intensities");
    for (double& candela : file.web.candela) {
        candela *= multiplier * ballast;
    }
    if (!numbers.failed()) {
        check_angles(file.web, numbers);
        warn_of_rest(numbers);
    }
    return file;
}

}  // namespace quasimc
