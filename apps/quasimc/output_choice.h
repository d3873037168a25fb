#pragma once

#include <string>
#include <vector>

#include "command_line.h"
#include "quasimc/run_file.h"

/// What flags say of what is written.
struct OutputChoice {
    std::string quantities, bands;  ///< lists, separated by commas
    bool include_night = false;
};

/// Adds its flags to a command's table. They point into it.
void add_choice_flags(OutputChoice& choice, std::vector<Flag>& flags);

/// Lets the choice go before [output] of a run. @throws quasimc::InputError
void apply_choice(const OutputChoice& choice, quasimc::RunFile& run);
