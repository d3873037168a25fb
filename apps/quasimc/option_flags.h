#pragma once

#include <list>
#include <string>
#include <vector>

#include "io/runfile/run_file.h"

namespace CLI {  // NOLINT(readability-identifier-naming): theirs
class App;
class Option;
}  // namespace CLI

/// The flags of the run options (--paths, --sampler, ...), one for each row of the table of
/// options.
class OptionFlags {
  public:
    void add_to(CLI::App& command);
    /// Those that were given.
    [[nodiscard]] std::vector<quasimc::Override> overrides() const;

  private:
    struct Flag {
        std::string key, name, text;
        const CLI::Option* option = nullptr;
    };
    std::list<Flag> flags_;  // CLI11 keeps references
};

/// Prints the warnings of a run file to stderr.
void print_warnings(const std::vector<quasimc::Warning>& warnings);
