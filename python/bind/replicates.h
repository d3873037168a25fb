#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "bind.h"
#include "quasimc/run.h"
#include "results/summable_light.h"

namespace quasimc::python {

/// A quantity (its index, or that behind all: sunlit area) and a band.
using LightKey = std::pair<std::size_t, std::size_t>;

/// The sums of a run, from which weighted sums of its light are estimated, with the scene and the
/// options of their evaluation.
struct ReplicateSums {
    std::shared_ptr<const Scene> scene;
    Sums sums;
    EvaluationSpec spec;
    /// Light that was summed, the latest last, by its quantity and band. They take at most as much
    /// memory as the sums.
    std::vector<std::pair<LightKey, std::shared_ptr<SummableLight>>> lights = {};
};

/// Keeps a copy of the sums of a run when its last round is complete.
class SumsKeeper final : public RunListener {
  public:
    /// @param max_bytes  larger sums are not kept
    explicit SumsKeeper(double max_bytes) : max_bytes_(max_bytes) {}

    void on_last_round(const RunSoFar& run) override;
    [[nodiscard]] bool wants(SeriesPart /*part*/) const override { return false; }

    /// @returns null, if there are no sums. @param spec  of the run
    [[nodiscard]] std::shared_ptr<ReplicateSums> take(
        std::shared_ptr<const Scene> scene, const Sources& sources, const RunSpec& spec);

  private:
    double max_bytes_;
    std::unique_ptr<Sums> sums_;
};

/// A result, and its sums if they were kept.
using ResultWithSums = std::pair<std::shared_ptr<Result>, std::shared_ptr<ReplicateSums>>;

}  // namespace quasimc::python
