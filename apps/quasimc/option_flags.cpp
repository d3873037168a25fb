#include "option_flags.h"

#include <cstdio>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "io/runfile/options.h"

void OptionFlags::add_to(CLI::App& command) {
    for (const quasimc::Option& option : quasimc::option_table()) {
        Flag& flag = flags_.emplace_back();
        flag.key = option.key;
        flag.name = quasimc::option_flag(option);
        const std::string words =
            fmt::format("{} ({})", option.summary, quasimc::domain_text(option));
        flag.option =
            command.add_option(flag.name, flag.text, words)
                ->group("Options of the run, before those of the file")
                ->default_str(quasimc::option_toml(option.get(quasimc::default_run_spec())))
                ->type_name("");
    }
}

std::vector<quasimc::Override> OptionFlags::overrides() const {
    std::vector<quasimc::Override> given;
    for (const Flag& flag : flags_) {
        if (flag.option->count() > 0) {
            given.push_back({flag.key, flag.text, flag.name});
        }
    }
    return given;
}

void print_warnings(const std::vector<quasimc::Warning>& warnings) {
    for (const quasimc::Warning& warning : warnings) {
        const std::string place = warning.place.empty() ? "" : warning.place + ": ";
        std::fprintf(stderr, "warning: %s%s\n", place.c_str(), warning.text.c_str());
    }
}
