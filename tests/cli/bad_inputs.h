#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace quasimc::test {

/// A change to the good run file, or another text for a file beside it.
struct BadInput {
    std::string name;         ///< of the test
    std::string find;         ///< in the good run file; "": the whole file
    std::string replacement;  ///< text in its stead
    std::string message;      ///< part of what is printed
    std::string file = {};    ///< a file to write besides
    std::string bytes = {};   ///< what is in it

    friend std::ostream& operator<<(std::ostream& out, const BadInput& input) {
        return out << input.name;
    }
};

/// Run files that are no run files, and their run options and outputs.
[[nodiscard]] std::vector<BadInput> bad_documents();
/// What light, materials and organs must not be.
[[nodiscard]] std::vector<BadInput> bad_scenes();
/// Geometry files.
[[nodiscard]] std::vector<BadInput> bad_geometry_files();

}  // namespace quasimc::test
