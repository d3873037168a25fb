#pragma once

#include <cstddef>
#include <functional>

#include "quasimc/series.h"

namespace quasimc::test {

/// A listener made of functions; each may be left out.
class Listening final : public RunListener {
  public:
    std::function<void(const Progress& progress)> progress;
    /// @param computed  as TimeStepResult
    std::function<void(std::size_t time_step, const Result& result, std::size_t computed)>
        time_step;
    std::function<void(std::size_t day, const SeriesSum& sum)> day;
    bool total = true;  ///< whether it is wanted

    void on_progress(const Progress& now) override {
        if (progress) {
            progress(now);
        }
    }
    void on_time_step(const TimeStepResult& step) override {
        if (time_step) {
            time_step(step.time_step, step.result, step.computed);
        }
    }
    void on_day(std::size_t number, const SeriesSum& sum) override { day(number, sum); }
    [[nodiscard]] bool wants(SeriesPart part) const override {
        return part == SeriesPart::time_steps ? time_step != nullptr
               : part == SeriesPart::days     ? day != nullptr
                                              : total;
    }
};

}  // namespace quasimc::test
