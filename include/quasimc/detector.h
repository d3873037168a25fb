#pragma once

// Detectors: what light is sorted by beside the organs.

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace quasimc {

/// A detector as a person states it. `quasimc list detectors` tells the types and what they take.
struct DetectorSpec {
    std::string type;       ///< "escaped_by_zenith"
    std::string name = {};  ///< unique among the detectors of a scene; default: the type
    /// By the names of the type's parameters; those left out have their usual values.
    std::map<std::string, double, std::less<>> parameters = {};
    std::string place = {};  ///< where it was stated, for messages; default: its name
};

/// What numbers a parameter takes.
enum class NumberKind { real, whole };

/// A number that a type of detector takes: a key in `[[detector]]`.
struct DetectorParameter {
    std::string_view name;
    std::string_view summary;  ///< a few words for the manual
    NumberKind kind = NumberKind::real;
    double low = 0, high = 0;          ///< its domain, ends included
    std::optional<double> usual = {};  ///< its value where none is stated; none: it must be stated
};

}  // namespace quasimc
