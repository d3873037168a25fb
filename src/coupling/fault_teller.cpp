#include "coupling/fault_teller.h"

#include <algorithm>
#include <new>

#include <fmt/format.h>

#include "quasimc/error.h"

namespace quasimc {

void FaultTeller::tell_step(std::uint64_t step, const std::exception_ptr& fault) {
    const std::string text = fault ? words_of(fault) : "";
    if (text == last_) {
        return;
    }
    tell_(
        fault ? fmt::format(
                    "step {}: {}\nThe simulator goes on; modules without an answer keep the "
                    "values they have.",
                    step, text)
              : fmt::format("step {}: it is answered again", step));
    last_ = text;
}

void FaultTeller::tell_refusal(const std::exception_ptr& fault) {
    tell_(words_of(fault) + "\nThere will be no light.");
}

std::string FaultTeller::words_of(const std::exception_ptr& fault) {
    worst_ = std::max(worst_, Conversation::faulty);
    try {
        std::rethrow_exception(fault);
    } catch (const InputError& error) {
        return error.what();
    } catch (const std::bad_alloc&) {
        worst_ = Conversation::failed;
        return "not enough memory";
    } catch (const std::exception& error) {
        worst_ = Conversation::failed;
        return fmt::format(
            "internal error: {}\nThis is a fault of the program; please report it.", error.what());
    }
}

}  // namespace quasimc
