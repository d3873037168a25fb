#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solvers/ray_bundles/solved_bands.h"

namespace quasimc {

/// Light of one replicate in all bands, from that in the solved ones; fixed point.
class AllBands {
  public:
    /// @param deviations  of the replicate, see SolvedBands::interpolate()
    AllBands(const SolvedBands& bands, std::span<const double> deviations)
        : bands_(bands),
          deviations_(deviations),
          flux_(bands.origins() * bands.all()),
          quanta_(bands.origins() * bands.all()) {}

    /// @param flux  may be negative, [column]
    /// @returns [origin][band], until the next call
    const std::vector<std::int64_t>& of(std::span<const double> flux) {
        if (!bands_.are_all()) {
            const std::size_t columns = flux.size() / bands_.origins();
            for (std::size_t origin = 0; origin < bands_.origins(); ++origin) {
                bands_.interpolate(
                    flux.subspan(origin * columns, columns), deviations_,
                    std::span(flux_).subspan(origin * bands_.all(), bands_.all()));
            }
            flux = flux_;
        }
        for (std::size_t b = 0; b < flux.size(); ++b) {
            quanta_[b] = signed_fixed(flux[b]);
        }
        return quanta_;
    }
    const std::vector<std::int64_t>& of(const std::vector<std::int64_t>& quanta) {
        if (bands_.are_all()) {
            return quanta;
        }
        std::vector<double> flux;
        flux.reserve(quanta.size());
        for (const std::int64_t amount : quanta) {
            flux.push_back(from_fixed(amount));
        }
        return of(flux);
    }

    static std::int64_t signed_fixed(double amount) {
        return amount < 0 ? -to_fixed(-amount) : to_fixed(amount);
    }

  private:
    const SolvedBands& bands_;
    std::span<const double> deviations_;
    std::vector<double> flux_;
    std::vector<std::int64_t> quanta_;
};

}  // namespace quasimc
