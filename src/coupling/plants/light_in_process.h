#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/notices.h"
#include "coupling/environment.h"
#include "coupling/plant_light.h"
#include "coupling/plants/query_graphics.h"
#include "coupling/step_error_log.h"
#include "growth/environment.h"

namespace quasimc {

/// Light for a plant in the same process, by a specification. Its answers are those of the program
/// QuasiMC with turtle lines in the format %g, to the last bit: all numbers are rounded to six
/// digits, as their text would be.
class LightInProcess final : public PlantEnvironment {
  public:
    /// Parts that may be missing.
    struct Options {
        /// Says which modules are interpreted; its turtle lines and its program are not used.
        CommFile format = {};
        /// Called repeatedly while light is computed; an exception of it ends answers().
        std::function<void()> check = [] {};
    };

    /// @param notices  outlives the object
    /// @param send  receives the errors of steps
    LightInProcess(
        Specification specification,
        Notices& notices,
        std::function<void(const std::string&)> send,
        Options options);

    Drawing* query(const PlantQuery& query) override;
    /// Computes the light of a pass. The error of a step is reported as by the program, and the
    /// plant continues with the answers so far, usually none.
    [[nodiscard]] std::vector<PlantAnswer> answers(std::int64_t step) override;

    /// The last pass, for a viewer; before the first one its light is empty.
    [[nodiscard]] StepSnapshot snapshot() const;
    /// Its queries, in the order of StepLight::organs.
    [[nodiscard]] const Pass& pass() const { return pass_; }
    [[nodiscard]] const Specification& specification() const { return light_.specification(); }
    /// The worst outcome of a pass so far.
    [[nodiscard]] SessionOutcome worst() const { return errors_.worst(); }

  private:
    /// The answers as the plant reads them from their text.
    [[nodiscard]] std::vector<PlantAnswer> answers_from(const Answers& computed) const;

    Options options_;
    std::function<void(const std::string&)> send_;
    StepErrorLog errors_{send_};
    PlantLight light_;
    Pass pass_;
    PassGraphics graphics_{pass_};
    std::vector<bool> is_answered_;  // of the queries
    bool is_new_pass_ = true;
    std::uint64_t steps_ = 0;
};

}  // namespace quasimc
