#pragma once

// The light whose errors count (RunSpec::target): which sets of organs, and which quantity.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "quasimc/error.h"
#include "quasimc/result.h"
#include "quasimc/sums.h"
#include "results/bounds/organ_reader.h"
#include "results/quantities.h"
#include "scene/scene.h"

namespace quasimc {

/// Adds a fault for a name that no band of the scene has. @param where  the option
void check_band(
    const Scene& scene, const std::string& where, const std::string& name, Faults& faults);

/// Names that RunSpec::target_quantity may have.
[[nodiscard]] std::vector<std::string_view> target_quantities();

/// The question of a specification that check_target() accepts.
[[nodiscard]] Question question_of(const Scene& scene, const RunSpec& spec);

/// Adds a fault for a target whose organs, groups or sensors the scene does not have, and for
/// unknown quantities and bands.
void check_target(const Scene& scene, const RunSpec& spec, Faults& faults);

/// A quantity of the light of a set of organs.
struct AskedQuantity {
    LightParts parts = {};
    bool is_flux = false;    ///< otherwise per area
    bool is_sunlit = false;  ///< the sunlit fraction of the area instead of light
};

/// Sets of organs with one quantity.
struct AskedLight {
    AskedQuantity quantity;
    std::vector<std::uint32_t> organs;  ///< all sets, one after the other
    std::vector<std::size_t> ends;      ///< ends of the sets in `organs`

    [[nodiscard]] std::size_t sets() const { return ends.size(); }
    [[nodiscard]] std::span<const std::uint32_t> set(std::size_t index) const {
        const std::size_t first = index == 0 ? 0 : ends[index - 1];
        return {organs.data() + first, ends[index] - first};
    }
};

/// The light of a question: that of sets with organs that absorb, and that of sets of sensors
/// alone. Each is left out if it has no sets. Organs that others cover completely receive no light
/// and are left out.
[[nodiscard]] std::vector<AskedLight> asked_light(const Scene& scene, const EvaluationSpec& spec);

/// Reads the light of sets of organs.
class AskedReader {
  public:
    AskedReader(
        const Sums& sums, const Scene& scene, const EvaluationSpec& spec, const AskedLight& asked)
        : sums_(sums), reader_(sums), scene_(scene), spec_(spec), asked_(asked) {}

    /// Bands in which each set has a value: those of the question, or one for the sunlit fraction.
    [[nodiscard]] std::vector<std::size_t> bands() const;
    /// The value of a set, per replicate.
    [[nodiscard]] std::vector<double> values(std::size_t set, std::size_t band) const;
    /// The estimate that these values give, with the size of a contribution.
    [[nodiscard]] Estimate estimate(
        std::size_t set, std::size_t band, std::span<const double> values) const;

  private:
    [[nodiscard]] double area_of(std::size_t set) const;
    [[nodiscard]] double unit_of(std::size_t set) const;
    [[nodiscard]] OrganReader reader_of(std::uint32_t organ) const {
        return {reader_, scene_, spec_, scene_.organs()[organ]};
    }

    const Sums& sums_;
    SumReader reader_;
    const Scene& scene_;
    const EvaluationSpec& spec_;
    const AskedLight& asked_;
};

}  // namespace quasimc
