#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec3.h"
#include "sources/source.h"

namespace quasimc {

/// What a key of a source takes.
enum class SourceKeyType {
    number,
    position,   ///< a point of the scene
    direction,  ///< of any length but 0
    other       ///< whatever the kind's own reader makes of it
};

/// A key that a kind of source takes in a run file, besides its amount of light.
struct SourceKey {
    std::string_view name;
    std::string_view summary;  ///< a few words for the manual
    SourceKeyType type = SourceKeyType::other;
    double low = 0, high = 0;          ///< of a number: its domain, ends included
    std::optional<double> usual = {};  ///< of a number; none: it must be stated
};

/// How a run file states the light of a source, per band.
enum class SourceAmount {
    irradiance_horizontal,  ///< `irradiance_horizontal`, on the horizontal
    irradiance_facing,      ///< `irradiance_facing`, on a plane that faces it
    flux,                   ///< `power`, `photon_flux` or `luminous_flux`: what it emits
    other                   ///< as the kind's own reader says
};

/// A source as it was stated: every key of its row has a value. World coordinates, z up.
struct StatedSource {
    std::string name;
    std::vector<double> spectrum;  ///< per band: the amount
    std::map<std::string_view, double> numbers = {};
    std::map<std::string_view, Vec3> vectors = {};  ///< positions; directions of unit length
};

/// One row of the table of kinds of sources.
struct SourceEntry {
    std::string_view name;     ///< as in `type = "..."`
    std::string_view words;    ///< what the header of a result calls it: "uniform sky"
    std::string_view summary;  ///< one line for the manual
    SourceAmount amount = SourceAmount::other;
    std::span<const SourceKey> keys = {};
    /// Null for a kind whose keys depend on each other (time or angles, a file): io has a reader
    /// of its own for it.
    /// @param stated  values within their domains
    std::shared_ptr<const Source> (*make)(const StatedSource& stated) = nullptr;
};

/// All kinds, in the order of the manual.
[[nodiscard]] std::span<const SourceEntry> source_catalogue();
/// The row of that name, or null.
[[nodiscard]] const SourceEntry* find_source(std::string_view name);

}  // namespace quasimc
