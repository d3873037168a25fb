#include "coupling/protocol/messages.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "base/notices.h"
#include "base/number_text.h"
#include "base/text.h"
#include "text/line_scanner.h"
#include "text/numbers.h"

namespace quasimc {
namespace {

constexpr std::string_view kControl = "Control";
constexpr double kUnset = std::numeric_limits<double>::quiet_NaN();

[[noreturn]] void fail(std::uint32_t line, std::string problem, std::string why) {
    throw InputError(
        {{fmt::format("message of the plant simulator, line {}", line), std::move(problem),
          std::move(why), ""}});
}

/// The value of an unsigned number beyond double precision: 0 or infinity.
double beyond_range(std::string_view digits) {
    const std::size_t exponent = std::min(digits.find_first_of("eEpP"), digits.size());
    const std::size_t sign = exponent + 1;
    if (sign < digits.size()) {
        return digits[sign] == '-' ? 0 : HUGE_VAL;
    }
    // Without an exponent only digits before the point make a number so large.
    return digits.find_first_of("123456789") < digits.find('.') ? HUGE_VAL : 0;
}

/// A number as scanf takes it: blanks before it, a sign, decimal or hexadecimal digits with or
/// without a point and an exponent, or a word for infinity or not-a-number. Moves `text` past it.
bool take_number(std::string_view& text, double& value) {
    std::string_view rest = text;
    rest.remove_prefix(std::min(rest.find_first_not_of(kBlanks), rest.size()));
    const bool is_negative = rest.starts_with('-');
    if (is_negative || rest.starts_with('+')) {
        rest.remove_prefix(1);
    }
    const bool is_hexadecimal = rest.starts_with("0x") || rest.starts_with("0X");
    rest.remove_prefix(is_hexadecimal ? 2 : 0);
    if (rest.empty() || rest.front() == '-' || rest.front() == '+') {
        return false;
    }
    const auto [stop, error] = std::from_chars(
        rest.data(), rest.data() + rest.size(), value,
        is_hexadecimal ? std::chars_format::hex : std::chars_format::general);
    if (error == std::errc::invalid_argument) {
        return false;
    }
    const auto length = static_cast<std::size_t>(stop - rest.data());
    if (error == std::errc::result_out_of_range) {
        value = beyond_range(rest.substr(0, length));
    }
    value = is_negative ? -value : value;
    rest.remove_prefix(length);
    text = rest;
    return true;
}

/// Whether a line consists of numbers alone, as turtle lines without a prefix do.
bool is_all_numbers(std::string_view line) {
    double ignored = 0;
    std::size_t count = 0;
    while (take_number(line, ignored)) {
        ++count;
    }
    return count > 0 && trimmed(line).empty();
}

std::int64_t integer_in(std::string_view word) {
    std::int64_t value = 0;
    std::from_chars(word.data(), word.data() + word.size(), value);
    return value;
}

}  // namespace

void Pass::clear() {
    queries.clear();
    parameters.clear();
    polygons.clear();
    polygon_lines.clear();
    vertices.clear();
    other_graphics.clear();
}

NumberStyle style_of(std::string_view number) {
    const std::size_t point = number.find('.');
    const bool is_finite = number.find_first_not_of("+-.0123456789eE") == std::string_view::npos;
    if (number.empty() || !is_finite) {
        return NumberStyle::unknown;  // nan and inf have one form
    }
    constexpr std::size_t kDecimals = 6;  // %f writes as many; %g has as many digits, at most
    if (point == std::string_view::npos || number.size() - point - 1 != kDecimals ||
        number.find_first_of("eE") != std::string_view::npos) {
        return NumberStyle::general;
    }
    const std::size_t digits = number.find_first_of("123456789");
    const bool has_more_digits = digits < point;
    return number.back() == '0' || has_more_digits ? NumberStyle::fixed : NumberStyle::unknown;
}

/// Reads one message, line by line.
class MessageParser::Reader {
  public:
    Reader(MessageParser& parser, std::string_view message, Pass& pass)
        : parser_(parser), lines_(message), pass_(pass) {}

    Control read() {
        while (next()) {
            if (line().starts_with(kControl)) {
                return control();
            }
            read_query();
        }
        fail(
            lines_.number(), "the message is incomplete", "it must end with a line 'Control: ...'");
    }

  private:
    [[nodiscard]] std::string_view line() const { return lines_.line(); }

    /// Goes to the next line that is not blank, or stays at a line that was put back.
    bool next() {
        if (put_back_) {
            put_back_ = false;
            return true;
        }
        while (lines_.next()) {
            if (line().find_first_not_of(kBlanks) != std::string_view::npos) {
                return true;
            }
        }
        return false;
    }

    Control control() const {
        constexpr std::int64_t kLast = 4, kExit = 8;
        std::string_view rest = line().substr(kControl.size());
        rest.remove_prefix(std::min(rest.find_first_of("-0123456789"), rest.size()));
        const std::string_view flags_word = take_word(rest);
        const std::int64_t flags = integer_in(flags_word);
        if (flags_word.empty()) {
            fail(lines_.number(), shown(line()), "a line 'Control: flags step' is expected");
        }
        return {(flags & kLast) != 0, (flags & kExit) != 0, integer_in(take_word(rest))};
    }

    /// "<id> E(...)F(...)", the turtle's lines, and the graphics if there are any.
    void read_query() {
        Query query;
        std::string_view rest = line();
        const std::string_view id = take_word(rest);
        const auto number = parse_integer(id);
        rest.remove_prefix(std::min(rest.find_first_not_of(kBlanks), rest.size()));
        if (!number || rest.empty() || rest.front() != 'E') {
            fail(
                lines_.number(), shown(line()),
                "a query '<id> E(...)' is expected here: do both programs read the same turtle "
                "lines in the environment file?");
        }
        query.id = *number;
        rest.remove_prefix(1);
        read_question(rest, query);
        read_organ(rest, query);
        read_turtle(query);
        read_graphics(query);
        pass_.queries.push_back(std::move(query));
    }

    /// Reads the parameters of E: their count, and whether the first one requests light.
    void read_question(std::string_view& rest, Query& query) {
        const auto first = static_cast<std::uint32_t>(pass_.parameters.size());
        query.slots = take_parameters(rest);
        const bool is_set = query.slots > 0 && first_text_set_;
        const double value = query.slots > 0 ? pass_.parameters[first] : kUnset;
        query.asks = query.slots > 0 && (!is_set || value >= 0);
        pass_.parameters.resize(first);
    }

    void read_organ(std::string_view rest, Query& query) {
        const std::size_t end = std::min(rest.find('('), rest.size());
        query.organ = trimmed(rest.substr(0, end));
        rest.remove_prefix(end);
        query.parameters.first = static_cast<std::uint32_t>(pass_.parameters.size());
        query.parameters.count = take_parameters(rest);
        if (!trimmed(rest).empty()) {
            fail(lines_.number(), shown(line()), "nothing may follow the second module");
        }
    }

    /// Reads an optional "(v,v,...)" to the pass's parameters; returns their number.
    std::uint32_t take_parameters(std::string_view& rest) {
        if (rest.empty() || rest.front() != '(') {
            return 0;
        }
        const std::size_t close = rest.find(')');
        if (close == std::string_view::npos) {
            fail(lines_.number(), shown(line()), "a parenthesis is not closed");
        }
        std::string_view list = rest.substr(1, close - 1);
        rest.remove_prefix(close + 1);
        std::uint32_t count = 0;
        while (true) {
            const std::size_t comma = std::min(list.find(','), list.size());
            const std::string_view word = trimmed(list.substr(0, comma));
            first_text_set_ = count == 0 ? !word.empty() : first_text_set_;
            pass_.parameters.push_back(parameter(word));
            if (++count > kMaxParameters) {
                fail(
                    lines_.number(), "a module has too many parameters",
                    fmt::format("{} are read", kMaxParameters));
            }
            if (comma == list.size()) {
                return count;
            }
            list.remove_prefix(comma + 1);
        }
    }

    double parameter(std::string_view word) {
        if (parser_.style_ == NumberStyle::unknown) {
            parser_.style_ = style_of(word);
        }
        double value = kUnset;
        std::string_view rest = word;
        if (!word.empty() && (!take_number(rest, value) || !rest.empty())) {
            fail(lines_.number(), shown(word), "a parameter must be a number");
        }
        return value;
    }

    void read_turtle(Query& query) {
        settle_position();
        std::array<Vec3, kTurtleFields> values{};
        for (std::size_t i = 0; i < kTurtleFields; ++i) {
            if (parser_.format_.turtle[i].is_sent) {
                values[i] = turtle_line(parser_.format_.turtle[i]);
            }
        }
        query.turtle = {values[0], values[1], values[2], values[3]};
    }

    /// lpfg sends the position even if the environment file doesn't mention it: the first query
    /// then is followed by one line of numbers more than the file promises.
    void settle_position() {
        if (parser_.position_settled_) {
            return;
        }
        parser_.position_settled_ = true;
        TurtleLine& position = parser_.format_.turtle[0];
        if (position.is_sent) {
            return;
        }
        LineScanner ahead = lines_;
        std::size_t numbers = 0;
        while (ahead.next() && is_all_numbers(ahead.line())) {
            ++numbers;
        }
        const auto promised = static_cast<std::size_t>(std::count_if(
            parser_.format_.turtle.begin(), parser_.format_.turtle.end(),
            [](const TurtleLine& l) { return l.is_sent; }));
        if (numbers == promised + 1) {
            position = {true, 0, 3};
        }
    }

    Vec3 turtle_line(const TurtleLine& format) {
        if (!next()) {
            fail(
                lines_.number(), "the message is incomplete", "lines about the turtle are missing");
        }
        std::string_view rest = trimmed(line());
        rest.remove_prefix(std::min(format.skip, rest.size()));
        std::array<double, 3> values{};
        for (std::size_t i = 0; i < format.values; ++i) {
            if (!take_number(rest, values[i])) {
                fail(
                    lines_.number(), shown(line()),
                    fmt::format(
                        "{} of the turtle {} expected: do both programs read the same "
                        "environment file?",
                        counted(format.values, "number"), format.values == 1 ? "is" : "are"));
            }
        }
        return {values[0], values[1], values[2]};
    }

    /// Graphics between "Dbegin" and "Dend"; polygons are kept.
    void read_graphics(Query& query) {
        query.polygons.first = static_cast<std::uint32_t>(pass_.polygons.size());
        if (!next()) {
            return;
        }
        if (!line().starts_with("Dbegin")) {
            put_back_ = true;
            return;
        }
        bool in_polygon = false;
        bool more = next();
        for (; more && !line().starts_with("Dend"); more = next()) {
            in_polygon = read_graphics_line(in_polygon);
        }
        if (!more) {
            fail(
                lines_.number(), "the message is incomplete",
                "graphics must end with a line 'Dend'");
        }
        query.polygons.count =
            static_cast<std::uint32_t>(pass_.polygons.size()) - query.polygons.first;
    }

    /// Reads a line of graphics. Returns whether the next line may be a vertex of a polygon.
    bool read_graphics_line(bool in_polygon) {
        std::string_view rest = line();
        Vec3 vertex;
        if (in_polygon && take_number(rest, vertex.x) && take_number(rest, vertex.y) &&
            take_number(rest, vertex.z)) {
            pass_.vertices.push_back(vertex);
            ++pass_.polygons.back().count;
            return true;
        }
        rest = line();
        const std::string_view word = take_word(rest);
        if (word == "polygon") {
            pass_.polygons.push_back({static_cast<std::uint32_t>(pass_.vertices.size()), 0});
            pass_.polygon_lines.push_back(lines_.number());
            return true;
        }
        note_graphics(word);
        return false;
    }

    void note_graphics(std::string_view word) {
        constexpr std::array<std::string_view, 5> kSilent{
            "material", "pushmatrix", "popmatrix", "translate", "rotate"};
        constexpr std::size_t kMaxNoted = 16;
        const bool is_word = word.find_first_not_of("0123456789+-.eE") != std::string_view::npos;
        auto& others = pass_.other_graphics;
        if (is_word && std::find(kSilent.begin(), kSilent.end(), word) == kSilent.end() &&
            others.size() < kMaxNoted &&
            std::find(others.begin(), others.end(), word) == others.end()) {
            others.emplace_back(word);
        }
    }

    MessageParser& parser_;
    LineScanner lines_;
    Pass& pass_;
    bool put_back_ = false;
    bool first_text_set_ = false;
};

Control MessageParser::parse(std::string_view message, Pass& pass) {
    return Reader(*this, message, pass).read();
}

}  // namespace quasimc
