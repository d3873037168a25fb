#include "coupling/step_error_log.h"

#include <algorithm>
#include <new>

#include <fmt/format.h>

#include "quasimc/error.h"

namespace quasimc {

void StepErrorLog::report_step(std::uint64_t step, const std::exception_ptr& fault) {
    const std::string text = fault ? describe(fault) : "";
    if (text == last_) {
        return;
    }
    send_(
        fault ? fmt::format(
                    "step {}: {}\nThe simulator continues; modules without an answer keep their "
                    "values.",
                    step, text)
              : fmt::format("step {}: answers continue", step));
    last_ = text;
}

void StepErrorLog::report_rejection(const std::exception_ptr& fault) {
    send_(describe(fault) + "\nNo light is computed any more.");
}

std::string StepErrorLog::describe(const std::exception_ptr& fault) {
    worst_ = std::max(worst_, SessionOutcome::rejected);
    try {
        std::rethrow_exception(fault);
    } catch (const InputError& error) {
        return error.what();
    } catch (const std::bad_alloc&) {
        worst_ = SessionOutcome::failed;
        return "not enough memory";
    } catch (const std::exception& error) {
        worst_ = SessionOutcome::failed;
        return fmt::format(
            "internal error: {}\nThis is an error in the program; please report it.", error.what());
    }
}

}  // namespace quasimc
