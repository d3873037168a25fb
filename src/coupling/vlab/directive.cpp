#include "coupling/vlab/directive.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "base/text.h"
#include "text/line_scanner.h"
#include "text/numbers.h"

namespace quasimc {
namespace {

constexpr std::string_view kSeparators = " ,;:\t";

/// A value without the comment that may follow it.
std::string_view without_comment(std::string_view value) {
    for (std::size_t at = value.find("//"); at != std::string_view::npos;
         at = value.find("//", at + 1)) {
        if (at == 0 || value[at - 1] == ' ' || value[at - 1] == '\t') {
            return trimmed(value.substr(0, at));
        }
    }
    return trimmed(value);
}

std::string range_text(Range range) {
    if (range.low <= kAnyNumber.low && range.high >= kAnyNumber.high) {
        return "it must be a number";
    }
    return range.high >= kAnyNumber.high
               ? fmt::format("it must be a number, {} or more", shortest(range.low))
               : fmt::format(
                     "it must be a number from {} to {}", shortest(range.low),
                     shortest(range.high));
}

}  // namespace

std::vector<DirectiveLine> split_directives(
    std::string_view text, const std::string& where, Notices& notices) {
    std::vector<DirectiveLine> directives;
    LineScanner lines(text);
    while (lines.next()) {
        const std::string_view line = trimmed(lines.line());
        if (line.empty() || line.starts_with("//")) {
            continue;
        }
        const std::size_t end = line.find_first_of(":\t");
        const std::string_view value =
            without_comment(line.substr(end == std::string_view::npos ? line.size() : end + 1));
        if (end == 0 && !directives.empty()) {
            directives.back().block.emplace_back(lines.number(), value);
        } else if (end == 0 || end == std::string_view::npos) {
            notices.once(fmt::format(
                "{}:{}: {} is not a directive and is ignored; write 'name: values', or ': values' "
                "to continue the line above",
                where, lines.number(), shown(line)));
        } else {
            directives.push_back(
                {lines.number(), lower_case(trimmed(line.substr(0, end))), value, {}});
        }
    }
    return directives;
}

Values::Values(
    std::string where, std::string what, std::string_view text, Faults& faults, Notices& notices)
    : where_(std::move(where)),
      what_(std::move(what)),
      text_(text),
      faults_(&faults),
      notices_(&notices) {}

bool Values::at_end() const {
    return text_.find_first_not_of(kSeparators) == std::string_view::npos;
}

std::size_t Values::words_left() const {
    std::string_view text = text_;
    std::size_t count = 0;
    while (!take_word(text, kSeparators).empty()) {
        ++count;
    }
    return count;
}

std::string_view Values::word() {
    return take_word(text_, kSeparators);
}

std::optional<double> Values::number(std::string_view name, Range range) {
    const std::string_view text = word();
    const std::optional<double> value = parse_real(text);
    if (text.empty()) {
        fault(fmt::format("{} is missing", name));
        return std::nullopt;
    }
    if (!value || !(*value >= range.low && *value <= range.high)) {
        fault(fmt::format("{} is {}", name, shown(text)), range_text(range));
        return std::nullopt;
    }
    return value;
}

std::optional<double> Values::number_or(double otherwise, std::string_view name, Range range) {
    return at_end() ? otherwise : number(name, range);
}

std::optional<std::int64_t> Values::integer(std::string_view name, Range range) {
    const std::optional<double> value = number(name, range);
    if (value && *value != static_cast<double>(static_cast<std::int64_t>(*value))) {
        fault(fmt::format("{} is {}", name, shortest(*value)), "it must be a whole number");
        return std::nullopt;
    }
    return value ? std::optional(static_cast<std::int64_t>(*value)) : std::nullopt;
}

std::optional<std::size_t> Values::choice(std::span<const std::string_view> names) {
    const std::string_view given = word();
    const std::string lower = lower_case(given);
    const auto found = std::find_if(names.begin(), names.end(), [&](std::string_view name) {
        return lower_case(name) == lower;
    });
    if (found == names.end()) {
        fault(
            given.empty() ? std::string("the value is missing")
                          : fmt::format("{} is unknown", shown(given)),
            "", did_you_mean(given, names));
        return std::nullopt;
    }
    return static_cast<std::size_t>(found - names.begin());
}

std::optional<bool> Values::yes_no() {
    constexpr std::array<std::string_view, 2> kWords{"no", "yes"};
    const std::optional<std::size_t> chosen = choice(kWords);
    return chosen ? std::optional(*chosen == 1) : std::nullopt;
}

std::string Values::rest() {
    text_.remove_prefix(std::min(text_.find_first_not_of(kSeparators), text_.size()));
    return std::string(trimmed(std::exchange(text_, {})));
}

void Values::fault(std::string problem, std::string why, std::string suggestion) {
    if (!failed_) {
        faults_->add(
            {where_, fmt::format("{}: {}", what_, problem), std::move(why), std::move(suggestion)});
    }
    failed_ = true;
}

void Values::notice(const std::string& text) {
    notices_->once(fmt::format("{}: {}: {}", where_, what_, text));
}

void Values::finish() {
    if (!failed_ && !at_end()) {
        notice(fmt::format("{} is not read", shown(trimmed(text_))));
    }
}

}  // namespace quasimc
