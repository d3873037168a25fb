#pragma once

#include <optional>
#include <string>
#include <vector>

#include "command_line.h"
#include "options/options.h"
#include "runfile/run_file.h"

/// The flags of the run options (--paths, --sampler, ...), one for each row of the table of
/// options. Flags point into it.
class OptionFlags {
  public:
    OptionFlags();
    ~OptionFlags() = default;
    OptionFlags(const OptionFlags&) = delete;
    OptionFlags& operator=(const OptionFlags&) = delete;

    /// Their rows, at the end of a command's table.
    void add_to(std::vector<Flag>& flags);
    /// The options that were given.
    [[nodiscard]] std::vector<quasimc::Override> overrides() const;

  private:
    struct Given {
        const quasimc::Option* option;
        std::optional<std::string> text;
    };
    std::vector<Given> given_;  // for every option
};

/// Prints the warnings of a run file to stderr.
void print_warnings(const std::vector<quasimc::Warning>& warnings);
