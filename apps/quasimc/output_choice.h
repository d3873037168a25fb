#pragma once

#include <string>
#include <vector>

#include "command_line.h"
#include "quasimc/run_file.h"

/// Quantities, bands and times to write, from flags.
struct OutputChoice {
    std::string quantities, bands;  ///< lists, separated by commas
    bool include_night = false;
};

/// Adds its flags to a command's table. They point into it.
void add_choice_flags(OutputChoice& choice, std::vector<Flag>& flags);

/// The options of a run that the choice requires.
[[nodiscard]] std::vector<quasimc::Override> overrides_of(const OutputChoice& choice);

/// Overrides [output] of a run by the choice. @throws quasimc::InputError
void apply_choice(const OutputChoice& choice, quasimc::RunFile& run);
