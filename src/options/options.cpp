#include "options/options.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <fmt/format.h>

#include "base/text.h"
#include "text/numbers.h"

namespace quasimc {
namespace {

std::string in_quotes(std::string_view text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') {
            result += '\\';
        }
        result += c;
    }
    return result + '"';
}

std::string format_value(const OptionValue& value) {
    const auto* text = std::get_if<std::string>(&value);
    return text ? "'" + *text + "'" : option_toml(value);
}

/// The kind of values in a domain: "a whole number".
std::string domain_kind(const OptionDomain& domain) {
    switch (domain.index()) {
        case 0:
            return "a whole number";
        case 1:
            return "a number";
        case 2:
            return "a text";
        case 3:
            return "a list of texts";
        default:
            return "a list of finite numbers";
    }
}

/// A whole number as people write it: 1000, 2^30, 2^63 - 1.
std::string whole_text(std::int64_t number) {
    constexpr std::uint64_t kLarge = std::uint64_t{1} << 20U;
    const auto n = static_cast<std::uint64_t>(number);
    if (number >= 0 && n + 1 >= kLarge) {
        if (std::has_single_bit(n)) {
            return fmt::format("2^{}", std::countr_zero(n));
        }
        if (std::has_single_bit(n + 1)) {
            return fmt::format("2^{} - 1", std::countr_zero(n + 1));
        }
    }
    return std::to_string(number);
}

bool has_right_type(const OptionDomain& domain, const OptionValue& value) {
    const bool integer_for_real =
        std::holds_alternative<RealDomain>(domain) && std::holds_alternative<std::int64_t>(value);
    const auto* texts = std::get_if<std::vector<std::string>>(&value);
    const bool is_empty_list =
        std::holds_alternative<RealsDomain>(domain) && texts != nullptr && texts->empty();
    return integer_for_real || is_empty_list || domain.index() == value.index();
}

bool in_domain(const OptionDomain& domain, const OptionValue& value) {
    if (const auto* range = std::get_if<IntegerDomain>(&domain)) {
        const std::int64_t n = std::get<std::int64_t>(value);
        return range->low <= n && n <= range->high;
    }
    if (const auto* range = std::get_if<RealDomain>(&domain)) {
        const double x = as_real(value);
        return std::isfinite(x) && range->low <= x && x <= range->high;
    }
    if (std::holds_alternative<RealsDomain>(domain)) {
        const std::vector<double> numbers = as_reals(value);
        return std::all_of(
            numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
    }
    if (const auto* choice = std::get_if<ChoiceDomain>(&domain)) {
        const auto& names = choice->names;
        return std::find(names.begin(), names.end(), std::get<std::string>(value)) != names.end();
    }
    return true;
}

bool is_number(const OptionDomain& domain) {
    return std::holds_alternative<IntegerDomain>(domain) ||
           std::holds_alternative<RealDomain>(domain);
}

}  // namespace

double as_real(const OptionValue& value) {
    const auto* integer = std::get_if<std::int64_t>(&value);
    return integer ? static_cast<double>(*integer) : std::get<double>(value);
}

std::vector<double> as_reals(const OptionValue& value) {
    const auto* numbers = std::get_if<std::vector<double>>(&value);
    return numbers ? *numbers : std::vector<double>{};
}

const Option* find_option(std::string_view key) {
    const std::span<const Option> table = option_table();
    const auto found = std::find_if(
        table.begin(), table.end(), [key](const Option& option) { return option.key == key; });
    return found == table.end() ? nullptr : &*found;
}

std::vector<std::string_view> option_keys() {
    std::vector<std::string_view> keys;
    for (const Option& option : option_table()) {
        keys.push_back(option.key);
    }
    return keys;
}

std::string option_flag(const Option& option) {
    std::string flag = "--" + std::string(option.key);
    std::replace(flag.begin(), flag.end(), '_', '-');
    return flag;
}

std::string domain_text(const Option& option) {
    if (const auto* range = std::get_if<IntegerDomain>(&option.domain)) {
        return fmt::format("{} to {}", whole_text(range->low), whole_text(range->high));
    }
    if (const auto* range = std::get_if<RealDomain>(&option.domain)) {
        return fmt::format("{} to {}", range->low, range->high);
    }
    if (const auto* choice = std::get_if<ChoiceDomain>(&option.domain)) {
        return "one of " + joined(choice->names, ", ");
    }
    if (std::holds_alternative<RealsDomain>(option.domain)) {
        return "list of finite numbers";
    }
    return fmt::format("list of \"{}\"", std::get<ListDomain>(option.domain).form);
}

OptionValue whole_if_integer(const Option& option, OptionValue value) {
    const auto* real = std::get_if<double>(&value);
    if (real != nullptr && std::holds_alternative<IntegerDomain>(option.domain)) {
        if (const auto integer = whole_number(*real)) {
            return *integer;
        }
    }
    return value;
}

std::optional<Fault> check_option(const Option& option, const OptionValue& value) {
    const bool has_type = has_right_type(option.domain, value);
    if (has_type && in_domain(option.domain, value)) {
        return std::nullopt;
    }
    if (const auto* choice = std::get_if<ChoiceDomain>(&option.domain)) {
        const auto* word = std::get_if<std::string>(&value);
        return Fault{
            "", fmt::format("{} is not {}", format_value(value), domain_text(option)), "",
            word != nullptr ? near_word_text(*word, choice->names) : ""};
    }
    if (has_type && is_number(option.domain)) {
        return Fault{
            "", fmt::format("{} is out of range", format_value(value)), domain_text(option), ""};
    }
    return Fault{
        "", fmt::format("{} is not {}", format_value(value), domain_kind(option.domain)),
        std::holds_alternative<RealsDomain>(option.domain) ? "" : domain_text(option), ""};
}

std::string method_name(Method from) {
    RunSpec spec;
    spec.method = from;
    return std::get<std::string>(find_option("method")->get(spec));
}

namespace {

/// The end of the first item of a list: its comma, outside quotes and brackets.
std::size_t end_of_item(std::string_view text) {
    char quote = '\0';
    int depth = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quote != '\0') {
            quote = c == quote ? '\0' : quote;
        } else if (c == '\'' || c == '"') {
            quote = c;
        } else if (c == '[' || c == ']') {
            depth += c == '[' ? 1 : -1;
        } else if (c == ',' && depth <= 0) {
            return i;
        }
    }
    return text.size();
}

/// The items between commas.
std::vector<std::string> split_list(std::string_view text) {
    std::vector<std::string> words;
    while (!text.empty()) {
        const std::size_t end = end_of_item(text);
        words.emplace_back(trimmed(text.substr(0, end)));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return words;
}

/// The numbers between commas, or the words if one of them is none.
OptionValue listed_numbers(std::string_view text) {
    const std::vector<std::string> words = split_list(text);
    std::vector<double> numbers;
    for (const std::string& word : words) {
        if (const auto number = parse_real(word)) {
            numbers.push_back(*number);
        }
    }
    return numbers.size() == words.size() ? OptionValue(numbers) : OptionValue(words);
}

}  // namespace

OptionValue parse_option(const Option& option, std::string_view text) {
    if (std::holds_alternative<IntegerDomain>(option.domain)) {
        if (const auto integer = parse_integer(text)) {
            return *integer;
        }
    }
    if (is_number(option.domain)) {
        if (const auto real = parse_real(text)) {
            return whole_if_integer(option, *real);
        }
    }
    if (std::holds_alternative<ListDomain>(option.domain)) {
        return split_list(text);
    }
    if (std::holds_alternative<RealsDomain>(option.domain)) {
        return listed_numbers(text);
    }
    return std::string(text);
}

std::string option_toml(const OptionValue& value) {
    if (const auto* integer = std::get_if<std::int64_t>(&value)) {
        return std::to_string(*integer);
    }
    if (const auto* real = std::get_if<double>(&value)) {
        return shortest(*real);
    }
    if (const auto* text = std::get_if<std::string>(&value)) {
        return in_quotes(*text);
    }
    std::string list;
    for (const double number : as_reals(value)) {
        list += (list.empty() ? "" : ", ") + shortest(number);
    }
    if (std::holds_alternative<std::vector<double>>(value)) {
        return "[" + list + "]";
    }
    for (const std::string& word : std::get<std::vector<std::string>>(value)) {
        list += (list.empty() ? "" : ", ") + in_quotes(word);
    }
    return "[" + list + "]";
}

std::string default_run_section() {
    std::string text = "[run]\n";
    for (const Option& option : option_table()) {
        const std::string unit = option.unit.empty() ? "" : fmt::format(" [{}]", option.unit);
        text += fmt::format("# {}{}: {}\n", option.summary, unit, domain_text(option));
        text += fmt::format("{} = {}\n", option.key, option_toml(option.get(RunSpec{})));
    }
    return text;
}

std::string options_markdown() {
    std::string text =
        "| Key in `[run]` | Flag | Default | Takes | Meaning |\n|---|---|---|---|---|\n";
    for (const Option& option : option_table()) {
        const std::string unit = option.unit.empty() ? "" : fmt::format(" {}", option.unit);
        text += fmt::format(
            "| `{}` | `{}` | `{}`{} | {} | {} |\n", option.key, option_flag(option),
            option_toml(option.get(RunSpec{})), unit, domain_text(option), option.summary);
    }
    return text;
}

}  // namespace quasimc
