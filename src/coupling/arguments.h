#pragma once

#include <optional>
#include <span>
#include <stdexcept>
#include <string>

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
    bool debug = false;         ///< tell on stderr what happens
    bool wants_help = false, wants_version = false;
};

/// Thrown for a command line that can't be understood.
class UsageError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Reads the words after the program's name, in any order. @throws UsageError
[[nodiscard]] Arguments parse_arguments(std::span<const char* const> words);

/// How the program is called.
[[nodiscard]] std::string usage_text();

}  // namespace quasimc
