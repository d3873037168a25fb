#pragma once

#include <cstdint>
#include <span>

#include "results/organ_reader.h"
#include "sums/statistics.h"

namespace quasimc {

/// By how much one find more, or one less, would change what is known of an organ in a band: see
/// docs/theory/statistics.md.
class OrganFinds {
  public:
    OrganFinds(const OrganReader& reader, std::size_t band);

    /// The estimate of a quantity.
    /// @param per_area  1 / area of the organ
    /// @param values  of the quantity, per replicate
    [[nodiscard]] Estimate estimate(
        const QuantityEntry& entry, double per_area, std::span<const double> values) const;

    /// A find of a quantity, as flux. To be asked where it is known what could have been found
    /// (OrganReader::knows_unoccluded).
    [[nodiscard]] SingleFind find(Quantity quantity) const;

  private:
    /// One kind of light.
    struct Kind {
        SingleFind upper, lower;
    };

    bool knows_unoccluded_;
    double absorptance_;
    double bound_;  ///< where unoccluded light is not known: a find, in one replicate
    Kind direct_, scattered_;
    SingleFind on_either_;  ///< scattered light, whichever side
};

}  // namespace quasimc
