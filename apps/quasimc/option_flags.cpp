#include "option_flags.h"

#include <string>

#include <fmt/format.h>

#include "options/options.h"
#include "terminal.h"

namespace {

/// What stands for its value in the help.
std::string type_name_of(const quasimc::Option& option) {
    switch (option.domain.index()) {
        case 0:
            return "N";
        case 1:
            return "X";
        case 2:
            return "NAME";
        case 3:
            return fmt::format("{},...", std::get<quasimc::ListDomain>(option.domain).form);
        default:
            return "X,...";
    }
}

/// Its default without the quotation marks of TOML; "" for an empty list.
std::string default_of(const quasimc::Option& option) {
    std::string text = quasimc::option_toml(option.get(quasimc::RunSpec{}));
    std::erase(text, '"');
    return text == "[]" ? "" : text;
}

/// Its values; bounds that are very large are left out.
std::string takes_of(const quasimc::Option& option) {
    constexpr double kHigh = 1e5;
    const auto* whole = std::get_if<quasimc::IntegerDomain>(&option.domain);
    const auto* real = std::get_if<quasimc::RealDomain>(&option.domain);
    if (whole == nullptr && real == nullptr) {
        return option.domain.index() == 2 ? quasimc::domain_text(option) : "";
    }
    const std::string kind = whole != nullptr ? "whole number" : "number";
    const double high = whole != nullptr ? static_cast<double>(whole->high) : real->high;
    const double low = whole != nullptr ? static_cast<double>(whole->low) : real->low;
    return high >= kHigh ? fmt::format("{} >= {}", kind, low)
                         : fmt::format("{}, {} to {}", kind, low, high);
}

}  // namespace

OptionFlags::OptionFlags() {
    for (const quasimc::Option& option : quasimc::option_table()) {
        given_.push_back({&option, {}});
    }
}

void OptionFlags::add_to(std::vector<Flag>& flags) {
    for (Given& given : given_) {
        const quasimc::Option& option = *given.option;
        flags.push_back(
            {.name = quasimc::option_flag(option),
             .target = &given.text,
             .summary = std::string(option.summary),
             .type_name = type_name_of(option),
             .group = fmt::format("{} (overrides the run file)", option.group),
             .default_text = default_of(option),
             .takes = takes_of(option)});
    }
}

std::vector<quasimc::Override> OptionFlags::overrides() const {
    std::vector<quasimc::Override> overrides;
    for (const Given& given : given_) {
        if (given.text) {
            const quasimc::Option& option = *given.option;
            overrides.push_back(
                {std::string(option.key), *given.text, quasimc::option_flag(option)});
        }
    }
    return overrides;
}

void print_warnings(const std::vector<quasimc::Warning>& warnings) {
    for (const quasimc::Warning& warning : warnings) {
        const std::string where = warning.where.empty() ? "" : warning.where + ": ";
        print_warning(where + warning.text);
    }
}
