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
    bool debug = false;         ///< describe every step on stderr
    bool wants_help = false, wants_version = false;
};

/// Thrown for an invalid command line.
class UsageError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The kind of specification that a program reads, by its name with or without folder: "MonteCarlo"
/// reads files of MonteCarlo, every other name recognizes the kind from the file.
[[nodiscard]] SpecificationKind kind_of_program(std::string_view path);

/// Reads the words after the program's name, in any order. @throws UsageError
/// @param kind  of the specification, if no argument names it
[[nodiscard]] Arguments parse_arguments(
    std::span<const char* const> words, SpecificationKind kind = SpecificationKind::automatic);

/// The usage of the program.
[[nodiscard]] std::string usage_text();

}  // namespace quasimc
