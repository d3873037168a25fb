#pragma once

// The sum over the points of a sweep, for a table.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "quasimc/result.h"
#include "quasimc/run_file.h"
#include "quasimc/series.h"
#include "results/combine.h"
#include "results/replicate_sum.h"
#include "results/sun_shade_replicates.h"

namespace quasimc {

/// The comments of a table on the points and their weights.
[[nodiscard]] std::string sweep_comments(const RunFile& run);

/// Whether all time steps of a run are complete.
[[nodiscard]] bool is_complete(const RunFile& run, const SeriesSummary& series_summary);

/// The light of the rows of a table, each point of a sweep times its weight: with [time] the sum of
/// the light over all times, otherwise the weighted mean of the points.
class SweepSum {
  public:
    /// @param first  first point
    /// @param table  of organs, groups or sensors
    SweepSum(const RunFile& first, const TableSpec& table);

    /// Adds the light of a computation of the point; that of other rows is ignored.
    void add(const SeriesSums& sums);
    /// Ends the point. @param is_complete  whether all of its light was added
    void end_point(bool is_complete);
    void begin_point(const RunFile& run);

    /// Whether all points are complete.
    [[nodiscard]] bool is_complete() const {
        return is_complete_ && points_ == run_->sweep->size();
    }
    /// The sum in the units of its columns, with the groups of the current point.
    [[nodiscard]] SeriesSum sum() const;

  private:
    /// The organs of each row in the scene of some sums, and their area.
    struct Rows {
        std::vector<std::uint32_t> indices;
        std::vector<OrganWeights> organs;
        std::vector<double> areas;
    };
    [[nodiscard]] Rows rows_of(const Scene& scene) const;
    [[nodiscard]] std::size_t index_of(
        std::size_t row, std::size_t quantity, std::size_t band) const {
        return (row * quantities_.size() + quantity) * bands_ + band;
    }
    [[nodiscard]] bool is_of(CsvRows rows) const { return table_.rows == rows; }
    [[nodiscard]] double weight() const { return (*run_->sweep)[run_->point].weight; }
    /// The factor that makes a mean of a sum; 1 with [time].
    [[nodiscard]] bool is_asked(std::string_view quantity) const;
    [[nodiscard]] double all_weights() const;
    [[nodiscard]] double per_weight() const;
    void choose_quantities();
    void add_canopy(const SeriesSums& sums, double weight);
    void choose_parts();
    /// @param light  factor on light
    void add_parts(const SeriesSums& sums, const Rows& rows, double light);
    void put_parts(SeriesSum& sum) const;
    void add_horizontal(const SeriesSums& sums, double weight);
    [[nodiscard]] SeriesSum sum_of_sensors(SeriesSum light) const;
    [[nodiscard]] std::vector<Estimate> values_of(const ReplicateSum& light) const;
    [[nodiscard]] std::vector<Estimate> shares() const;
    [[nodiscard]] std::vector<CanopyFractions> canopy() const;
    [[nodiscard]] SeriesSum sum_of(const ReplicateSum& light) const;

    const RunFile* run_;
    TableSpec table_;
    std::size_t bands_;
    std::vector<Quantity> quantities_;  // that the table needs
    bool has_fractions_ = false;        // whether it needs those of the canopy
    std::size_t rows_ = 0;
    GroupResults groups_;        // of the current point, without light
    std::vector<double> areas_;  // of the rows, after add()
    ReplicateSum light_;
    std::vector<ReplicateSum> origins_;
    bool has_parts_ = false;   // whether it needs light of sunlit and shaded parts
    bool has_sunlit_ = false;  // whether it needs sunlit areas
    SunShadeReplicateSum sun_shade_;
    ReplicateSum sunlit_;    // sunlit area, by row
    ReplicateSum incident_;  // on the horizontal, by band
    ReplicateSum canopy_;    // the flux of each fraction, by band
    bool is_incident_known_ = true;
    bool has_transmittance_ = false;  // whether the table needs that of sensors
    std::vector<double> horizontal_;  // for it: light on the horizontal, by band
    double seconds_ = 0;              // sum over points of weight x time
    std::size_t points_ = 0;
    bool is_complete_ = true;
};

}  // namespace quasimc
