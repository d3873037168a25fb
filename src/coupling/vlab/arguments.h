#pragma once

#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace quasimc {

/// Which program a specification file was written for.
enum class SpecificationKind { automatic, quasimc, montecarlo };

/// The command line that the plant simulators make of an executable line.
struct Arguments {
    std::optional<std::string> comm_file;  ///< -e
    std::optional<long> key;               ///< -k
    std::string extension;                 ///< -ext
    std::optional<std::string> host;       ///< -host
    SpecificationKind kind = SpecificationKind::automatic;
    std::string specification;  ///< empty: all defaults
    bool view = false;          ///< show steps in a browser
    bool debug = false;         ///< tell on stderr what happens
    bool wants_help = false, wants_version = false;
};

/// Thrown for a command line that can't be understood.
class UsageError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The program that a name stands for, with or without its folder: "MonteCarlo" reads files of
/// MonteCarlo, every other name tells from the file.
[[nodiscard]] SpecificationKind kind_of_program(std::string_view path);

/// Reads the words after the program's name, in any order. @throws UsageError
/// @param kind  of the specification, where no word names it
[[nodiscard]] Arguments parse_arguments(
    std::span<const char* const> words, SpecificationKind kind = SpecificationKind::automatic);

/// How the program is called.
[[nodiscard]] std::string usage_text();

}  // namespace quasimc
