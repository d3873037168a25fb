#pragma once

#include <map>
#include <string>
#include <vector>

namespace quasimc::test {

/// A recorded session of cpfg or lpfg with the original program.
struct Capture {
    std::vector<std::string> messages;  ///< messages of the simulator, each with its Control line
    std::vector<std::string>
        replies;  ///< messages of the original program, each with its Control line
};

/// Reads a capture of tests/protocol/captures: a pair of .to and .from files, or a trace of files.
[[nodiscard]] Capture read_pipe_capture(const std::string& to, const std::string& from);
[[nodiscard]] Capture read_file_capture(const std::string& name);

/// A reply with '#' for every value, to be compared byte for byte.
[[nodiscard]] std::string structure_of(const std::string& reply);

/// The lines other than Control lines.
[[nodiscard]] std::string without_controls(const std::string& reply);

/// The first value of each answer, by id.
[[nodiscard]] std::map<long, double> values_of(const std::string& reply);

}  // namespace quasimc::test
