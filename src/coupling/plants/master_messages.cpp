#include "coupling/plants/master_messages.h"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "base/text.h"
#include "text/line_scanner.h"
#include "text/numbers.h"

namespace quasimc {
namespace {

void append_parameters(std::string& text, std::span<const float> parameters) {
    const char* separator = "(";
    for (const float parameter : parameters) {
        text += separator;
        append_six_digits(text, static_cast<double>(parameter));
        separator = ",";
    }
    text += parameters.empty() ? "" : ")";
}

std::array<NumberLine, kTurtleFields> turtle_lines(const CommFile& format) {
    constexpr std::size_t kVector = 3, kNumber = 1;
    Faults faults;
    const auto line = [&](TurtleField field, std::size_t numbers) {
        return NumberLine(format.line(field), numbers, faults);
    };
    std::array<NumberLine, kTurtleFields> lines{
        line(TurtleField::position, kVector),   line(TurtleField::heading, kVector),
        line(TurtleField::left, kVector),       line(TurtleField::up, kVector),
        line(TurtleField::line_width, kNumber), line(TurtleField::scale_factor, kNumber)};
    faults.throw_if_any();
    return lines;
}

[[noreturn]] void refuse_answer(std::string_view line, const std::string& program) {
    throw InputError(
        {{program, fmt::format("{} is no answer", shown(line)),
          "'id E(value,...)' is expected, or 'Control: 5' at the end",
          "the program must write nothing else to its standard output"}});
}

}  // namespace

QueryWriter::QueryWriter(const CommFile& format)
    : following_module_(format.following_module), turtle_(turtle_lines(format)) {}

void QueryWriter::append(std::string& text, const PlantQuery& query) const {
    fmt::format_to(std::back_inserter(text), "{} E", query.id);
    append_parameters(text, query.parameters);
    if (following_module_) {
        text += query.following;
        append_parameters(text, query.following_parameters);
    }
    text += '\n';
    const TurtleFrame& f = query.frame;
    const std::array<Vec3, kTurtleFields> values{
        f.position, f.heading, f.left, f.up, Vec3{query.line_width}, Vec3{query.scale}};
    for (std::size_t i = 0; i < kTurtleFields; ++i) {
        if (turtle_[i].is_sent()) {
            turtle_[i].append(text, std::array{values[i].x, values[i].y, values[i].z});
        }
    }
}

PlantAnswer read_answer(std::string_view line, const std::string& program) {
    std::string_view rest = line;
    const auto id = parse_integer(take_word(rest));
    rest = trimmed(rest);
    if (!id || !rest.starts_with('E')) {
        refuse_answer(line, program);
    }
    PlantAnswer answer{*id, {}};
    rest.remove_prefix(1);
    if (!rest.starts_with('(')) {
        return answer;
    }
    const std::size_t close = rest.find(')');
    if (close == std::string_view::npos) {
        refuse_answer(line, program);
    }
    rest = rest.substr(1, close - 1);
    while (true) {
        const std::size_t comma = std::min(rest.find(','), rest.size());
        const std::string_view word = trimmed(rest.substr(0, comma));
        const auto value = parse_real(word);
        if (!value && !word.empty()) {
            refuse_answer(line, program);
        }
        answer.values.push_back(value ? std::optional(static_cast<float>(*value)) : std::nullopt);
        if (comma == rest.size()) {
            return answer;
        }
        rest.remove_prefix(comma + 1);
    }
}

bool ends_reply(std::string_view control) {
    constexpr std::int64_t kLast = 4;
    control.remove_prefix(std::min(control.find_first_of("0123456789"), control.size()));
    const auto flags = parse_integer(take_word(control));
    return !flags || (*flags & kLast) != 0;
}

void append_master_control(std::string& text, ChunkPosition position, std::int64_t step) {
    constexpr std::array kFlags{5, 1, 0, 4};
    fmt::format_to(
        std::back_inserter(text), "Control: {} {}\n", kFlags[static_cast<std::size_t>(position)],
        step);
}

}  // namespace quasimc
