#include "option_flags.h"

#include <string>

#include <fmt/format.h>

#include "options/options.h"
#include "terminal.h"
#include "usage_errors.h"

namespace {

/// The placeholder of its value in the help.
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

/// Its values; "" if the name of their type says enough.
std::string takes_of(const quasimc::Option& option) {
    if (const auto* range = std::get_if<quasimc::IntegerDomain>(&option.domain)) {
        return number_text(
            true, {static_cast<double>(range->low), static_cast<double>(range->high)});
    }
    if (const auto* range = std::get_if<quasimc::RealDomain>(&option.domain)) {
        return number_text(false, {range->low, range->high});
    }
    const bool is_choice = std::holds_alternative<quasimc::ChoiceDomain>(option.domain);
    return is_choice ? quasimc::domain_text(option) : "";
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
