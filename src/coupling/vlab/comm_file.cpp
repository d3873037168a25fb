#include "coupling/vlab/comm_file.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "base/text.h"
#include "coupling/vlab/directive.h"
#include "text/line_scanner.h"
#include "text/numbers.h"

namespace quasimc {
namespace {

/// A line "name: value" of the file.
struct CommLine {
    std::string where;
    std::string_view name, value;
};

struct Reading {
    Notices& notices;
    CommFile file = {};
    Faults faults = {};
};

/// The printf format of a turtle line: how many characters other than blanks it prints before the
/// first number, and how many numbers. Blanks are not counted, as a line may begin with one or not.
TurtleLine parse_format(const CommLine& of_file) {
    const std::string_view format = of_file.value;
    TurtleLine line{
        true, trimmed(format.substr(0, format.find('%'))).size(), 0, std::string(format),
        of_file.where};
    for (std::size_t i = 0; i + 1 < format.size(); ++i) {
        if (format[i] == '%') {
            line.values += format[i + 1] == '%' ? 0 : 1;
            ++i;
        }
    }
    line.values = std::min<std::size_t>(line.values, 3);
    line.is_sent = line.values > 0;
    return line;
}

/// The plant simulator ignores an unknown type (also one in capitals) and uses pipes; an invalid
/// number of queries means the default. Both sides must agree.
void read_transport(const CommLine& line, Reading& reading) {
    constexpr std::array<std::string_view, 4> kNames{"pipes", "files", "memory", "sockets"};
    std::string_view rest = line.value;
    const std::string_view name = take_word(rest);
    const auto* found = std::find(kNames.begin(), kNames.end(), name);
    if (found == kNames.end()) {
        if (lower_case(name) != kNames.front()) {
            reading.notices.once(fmt::format(
                "{}: {} is not a communication type and is ignored, as in the plant simulator; "
                "pipes are used; {}",
                line.where, shown(name), did_you_mean(name, kNames)));
        }
        return;
    }
    reading.file.transport = static_cast<Transport>(found - kNames.begin());
    const std::string_view chunk = take_word(rest);
    if (chunk.empty()) {
        return;
    }
    const auto count = parse_integer(chunk);
    if (!count || *count < 1) {
        reading.notices.once(fmt::format(
            "{}: {} queries in a chunk; the default is used, as in the plant simulator", line.where,
            shown(chunk)));
        return;
    }
    reading.file.chunk = static_cast<std::size_t>(*count);
}

void read_following(const CommLine& line, Reading& reading) {
    // cpfg accepts yes and no, lpfg on and off; other values leave the default.
    const std::string_view value = trimmed(line.value);
    reading.file.following_module = value != "no" && value != "off";
}

void read_binary(const CommLine& line, Reading& reading) {
    if (trimmed(line.value) == "on") {
        reading.faults.add(
            {line.where, "binary data is on", "messages must be text", "write 'binary data: off'"});
    }
}

template <TurtleField Field>
void read_turtle(const CommLine& line, Reading& reading) {
    reading.file.turtle[static_cast<std::size_t>(Field)] = parse_format(line);
}

void read_interpreted(const CommLine& line, Reading& reading) {
    constexpr Separators kBetweenModules(" \t,;");
    reading.file.interprets_modules = !trimmed(line.value).empty();
    std::string_view rest = line.value;
    for (auto word = take_word(rest, kBetweenModules); !word.empty();
         word = take_word(rest, kBetweenModules)) {
        const std::size_t open = std::min(word.find('('), word.size());
        const std::string_view name = word.substr(0, open);
        std::string_view count = word.substr(open);
        const auto parameters = parse_integer(take_word(count, "()"));
        InterpretedModules modules{std::string(name == "all" ? "" : name), {}};
        if (parameters && *parameters >= 0) {
            modules.parameters = static_cast<std::size_t>(*parameters);
        }
        reading.file.interpreted.push_back(std::move(modules));
    }
}

/// The old form: numbers of parameters, -1 for any.
void read_when_interpret(const CommLine& line, Reading& reading) {
    reading.file.interprets_modules = !trimmed(line.value).empty();
    std::string_view rest = line.value;
    while (const auto count = parse_integer(take_word(rest, " \t,;"))) {
        reading.file.interpreted.push_back({"", {}});
        if (*count >= 0) {
            reading.file.interpreted.back().parameters = static_cast<std::size_t>(*count);
        }
    }
}

template <std::string CommFile::*Text>
void read_text(const CommLine& line, Reading& reading) {
    reading.file.*Text = trimmed(line.value);
}

void ignore(const CommLine& /*line*/, Reading& /*reading*/) {}

/// One row of the table of names.
struct CommEntry {
    std::string_view name;
    void (*read)(const CommLine& line, Reading& reading);
};

constexpr std::array kCommEntries{
    CommEntry{"communication type", read_transport},
    CommEntry{"executable", read_text<&CommFile::executable>},
    CommEntry{"turtle position", read_turtle<TurtleField::position>},
    CommEntry{"turtle heading", read_turtle<TurtleField::heading>},
    CommEntry{"turtle left", read_turtle<TurtleField::left>},
    CommEntry{"turtle up", read_turtle<TurtleField::up>},
    CommEntry{"turtle line width", read_turtle<TurtleField::line_width>},
    CommEntry{"turtle scale factor", read_turtle<TurtleField::scale_factor>},
    CommEntry{"following module", read_following},
    CommEntry{"interpreted modules", read_interpreted},  // strings are always read
    CommEntry{"when interpret", read_when_interpret},
    CommEntry{
        "verbose", [](const CommLine& line,
                      Reading& reading) { reading.file.verbose = trimmed(line.value) == "on"; }},
    CommEntry{"strings only", ignore},
    CommEntry{"binary data", read_binary},
    CommEntry{"remote host", read_text<&CommFile::remote_host>},
};

void read_line(const CommLine& line, Reading& reading) {
    const auto* entry = std::find_if(
        kCommEntries.begin(), kCommEntries.end(),
        [&](const CommEntry& e) { return e.name == line.name; });
    if (entry != kCommEntries.end()) {
        entry->read(line, reading);
        return;
    }
    std::array<std::string_view, kCommEntries.size()> names;
    std::transform(kCommEntries.begin(), kCommEntries.end(), names.begin(), [](const CommEntry& e) {
        return e.name;
    });
    reading.notices.once(fmt::format(
        "{}: {} is unknown and ignored; {}", line.where, shown(line.name),
        did_you_mean(line.name, names)));
}

}  // namespace

bool CommFile::interprets(std::string_view module, std::size_t parameters) const {
    return std::any_of(
        interpreted.begin(), interpreted.end(), [&](const InterpretedModules& modules) {
            return (modules.name.empty() || modules.name == module) &&
                   modules.parameters.value_or(parameters) == parameters;
        });
}

CommFile read_comm_text(std::string_view text, const std::string& name, Notices& notices) {
    Reading reading{notices};
    LineScanner lines(text);
    while (lines.next()) {
        const std::size_t end = lines.line().find_first_of(":\t");
        if (trimmed(lines.line()).empty()) {
            continue;
        }
        const std::string where = fmt::format("{}:{}", name, lines.number());
        if (end == std::string_view::npos) {
            notices.once(
                fmt::format("{}: {} is ignored; write 'name: value'", where, shown(lines.line())));
            continue;
        }
        read_line({where, lines.line().substr(0, end), lines.line().substr(end + 1)}, reading);
    }
    reading.faults.throw_if_any();
    return reading.file;
}

}  // namespace quasimc
