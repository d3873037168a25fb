#include "run/round_tracer.h"

#include <utility>

#include "solvers/catalogue.h"

namespace quasimc {

void RoundTracer::trace(const Round& round) {
    if (round.first == 0) {
        spec_.paths = round.count;
        solver_ = make_solver({prepared_, sampler_, spec_, executor_.stop()});
    }
    Sums sums = round.first == 0  ? empty_sums(prepared_, spec_)
                : may_be_stopped_ ? *done_
                                  : std::move(*done_);
    solver_->solve(round, executor_, sums);
    done_ = std::move(sums);
}

}  // namespace quasimc
