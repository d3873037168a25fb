#pragma once

#include <cstddef>
#include <type_traits>
#include <vector>

#include "quasimc/quasimc.h"
#include "resultio/field_formats.h"
#include "show_values.h"

/// The light of each organ in a quantity and a band. @param light  a Result or a SeriesSum
template <typename Light>
ShownValues light_values(
    const quasimc::RunFile& run,
    const Light& light,
    const quasimc::QuantityEntry& entry,
    std::size_t band) {
    constexpr bool kIsSum = std::is_same_v<Light, quasimc::SeriesSum>;
    ShownValues values = named_values(run, entry, run.scene.bands()[band], kIsSum);
    values.when = kIsSum ? "sum of all times" : "";
    for (std::size_t organ = 0; organ < run.scene.organs().size(); ++organ) {
        values.estimates.push_back(quasimc::reported(light.at(organ, entry.quantity, band)));
    }
    return values;
}

/// The scene with the numbers that `quasimc run` writes for other programs: all that [output]
/// chooses, each with its standard error. Of a run with [time] the sum, of a sweep the last point.
class RunFields {
  public:
    explicit RunFields(const quasimc::RunFile& run) : run_(&run) {}

    void next_run(const quasimc::RunFile& run) { run_ = &run; }
    void add_moment(const quasimc::Result& result);
    /// @param summary  of the run
    [[nodiscard]] quasimc::FieldScene shown(const quasimc::SeriesSummary& summary) const;

  private:
    const quasimc::RunFile* run_;
    std::vector<ShownValues> last_;
};
