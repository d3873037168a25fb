#pragma once

#include <functional>
#include <map>
#include <string>

namespace quasimc {

/// A detector as a person states it. `quasimc list detectors` tells the types and what they take.
struct DetectorSpec {
    std::string type;       ///< "escaped_by_zenith"
    std::string name = {};  ///< unique among the detectors of a scene; default: the type
    /// By the names of the type's parameters; those left out have their usual values.
    std::map<std::string, double, std::less<>> parameters = {};
    std::string place = {};  ///< where it was stated, for messages; default: its name
};

}  // namespace quasimc
