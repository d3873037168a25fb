#include "option_flags.h"

#include <cstdio>

#include <fmt/format.h>

#include "base/text.h"
#include "io/runfile/options.h"

OptionFlags::OptionFlags() {
    for (const auto table : {quasimc::option_table(), quasimc::former_option_table()}) {
        for (const quasimc::Option& option : table) {
            given_.push_back({&option, {}});
        }
    }
}

void OptionFlags::add_to(std::vector<Flag>& flags) {
    std::vector<Flag> shown;
    for (Given& given : given_) {
        const quasimc::Option& option = *given.option;
        const bool is_former = !option.replaced_by.empty();
        (is_former ? flags : shown)
            .push_back(
                {.name = quasimc::option_flag(option),
                 .target = &given.text,
                 .summary = fmt::format("{} ({})", option.summary, quasimc::domain_text(option)),
                 .type_name = "",
                 .group = is_former ? "" : "Options of the run, before those of the file",
                 .default_text = quasimc::option_toml(option.get(quasimc::default_run_spec()))});
    }
    flags.insert(flags.end(), shown.begin(), shown.end());
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
        const std::string place = warning.place.empty() ? "" : warning.place + ": ";
        std::fprintf(
            stderr, "warning: %s\n",
            quasimc::one_line(quasimc::printable(place + warning.text)).c_str());
    }
}
