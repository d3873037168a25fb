#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "command_line.h"
#include "show_view.h"

/// The command line of `quasimc grow`.
struct GrowArguments {
    std::string model, view_file;     ///< "": without
    std::string light, environment;   ///< a specification, or an environment file; "": without
    int steps = -1;                   ///< negative: those of the model
    std::optional<double> seed;       ///< seed of stochastic productions
    std::size_t string_limit = 1024;  ///< MiB
    bool view = false;
    std::size_t port = 0;
    std::string output, series;
    std::string string, binary_string, box, drawing;
    bool homomorphism = false, quiet = false, verbose = false;
    bool is_batch = false;  ///< this and the following flags of cpfg have no effect
    std::string color_map, material_map;
    std::size_t string_bytes = 0;
    ViewArguments picture;
};

/// The arguments with the view file and the specification that have the model's name, if they exist
/// and no others are given.
[[nodiscard]] GrowArguments with_default_files(GrowArguments arguments);

[[nodiscard]] std::vector<Flag> flags_of_grow(GrowArguments& arguments);
/// Flags of cpfg with one dash and several letters.
[[nodiscard]] std::vector<OldFlag> cpfg_flags();
/// @throws UsageError  for contradictory flags
void check_usage(const GrowArguments& arguments);
