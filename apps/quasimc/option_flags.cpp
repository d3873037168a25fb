#include "option_flags.h"

#include <cstdio>

#include <fmt/format.h>

#include "base/text.h"
#include "options/options.h"

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
             .summary = fmt::format("{} ({})", option.summary, quasimc::domain_text(option)),
             .type_name = "",
             .group = "Options of the run, before those of the file",
             .default_text = quasimc::option_toml(option.get(quasimc::RunSpec{}))});
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
        const std::string place = warning.where.empty() ? "" : warning.where + ": ";
        std::fprintf(
            stderr, "warning: %s\n",
            quasimc::one_line(quasimc::printable(place + warning.text)).c_str());
    }
}
