#pragma once

#include <array>
#include <string>
#include <vector>

#include "quasimc/result.h"
#include "quasimc/series.h"
#include "results/fraction_table.h"
#include "series/sun_shade_sum.h"
#include "series/time_sums.h"

namespace quasimc {

/// Sums results with independent errors.
class SeriesAdder {
  public:
    /// @param origins  of the results
    explicit SeriesAdder(const std::vector<std::string>& origins = {}) {
        for (const std::string& origin : origins) {
            origins_.push_back({origin});
        }
    }
    /// Sums light of sunlit and shaded parts too, and the sunlit hours of sensors.
    /// @param organs, groups, sensors  their numbers
    void add_parts(std::size_t organs, std::size_t groups, std::size_t sensors, std::size_t bands) {
        has_parts_ = true;
        organ_parts_ = {organs, bands};
        group_parts_ = {groups, bands};
        sensor_hours_ = {sensors, 0};
    }

    /// Adds `weight` times a result. Results of one trace are added once, with the sum of their
    /// weights: their errors are equal.
    /// @param seconds  the time of the result, for sunlit hours
    void add(const Result& result, double weight, double seconds = 0);
    void add_seconds(double seconds) { seconds_ += seconds; }
    /// @param values  number of values, in case nothing was added
    /// @param groups  gets the values
    /// @param of_sensors  number of values of sensors, which are summed if all results have them
    [[nodiscard]] SeriesSum sum(
        std::size_t bands,
        std::size_t values,
        const GroupResults& groups = {},
        std::size_t of_sensors = 0) const;

  private:
    /// The sums of all light, or of an origin.
    struct Part {
        std::string name;
        std::vector<TimeSum> organs = {}, groups = {}, sensors = {};
    };
    struct CanopyOfBand {
        double incident = 0;
        std::array<TimeQuotient, fraction_table().size()> fractions;
    };
    /// @param sensors  or null
    static void add_part(const Result& result, const Result* sensors, double weight, Part& part);
    void add_shares(const Result& result, double weight, double freedom);
    void add_canopy(const Result& result, double weight, double freedom);
    [[nodiscard]] std::vector<CanopyFractions> canopy() const;
    void put_parts(SeriesSum& sum) const;

    Part all_;
    std::vector<Part> origins_;
    std::vector<TimeQuotient> shares_;  // as GroupResults::shares
    std::vector<CanopyOfBand> canopy_;
    bool lacks_sensors_ = false;  // whether a result lacks its sensors
    bool has_parts_ = false;
    SunShadeAdder organ_parts_, group_parts_;
    SunShadeAdder sensor_hours_;  // without light
    double seconds_ = 0;
};

}  // namespace quasimc
