#include "capi/guard.h"

#include <cstddef>
#include <limits>
#include <new>

#include "base/text.h"
#include "quasimc/error.h"
#include "quasimc/run.h"
#include "quasimc/version.h"

namespace quasimc::capi {
namespace {

/// The last message of each thread. It is the only state between calls, and no run reads it.
std::string& message_of_thread() {
    thread_local std::string message;
    return message;
}

int failed(int status, const char* words) noexcept {
    try {
        message_of_thread() = words;
    } catch (...) {
        message_of_thread().clear();  // no memory for the message
    }
    return status;
}

}  // namespace

int guarded(const std::function<void()>& work) noexcept {
    try {
        work();
        return QUASIMC_DONE;
    } catch (const InputError& error) {
        return failed(QUASIMC_INPUT_ERROR, error.what());
    } catch (const Misuse& error) {
        return failed(QUASIMC_MISUSE, error.what());
    } catch (const Stopped& error) {
        return failed(QUASIMC_STOPPED, error.what());
    } catch (const std::bad_alloc&) {
        return failed(QUASIMC_INTERNAL_ERROR, "not enough memory");
    } catch (const std::exception& error) {
        return failed(QUASIMC_INTERNAL_ERROR, error.what());
    } catch (...) {
        return failed(QUASIMC_INTERNAL_ERROR, "an unknown error");
    }
}

const char* last_error() noexcept {
    return message_of_thread().c_str();
}

std::span<const double> of_bands(const double* numbers, std::size_t bands, const char* name) {
    const double* first = &deref(numbers, name);
    if (bands == 0) {
        throw Misuse(std::string(name) + ": the scene has no bands yet, add them first");
    }
    return {first, bands};
}

std::string text_of(const char* text, const char* name) {
    std::string copy = &deref(text, name);
    if (!is_utf8(copy)) {
        throw InputError({{name, shown(copy) + " is not UTF-8", "texts must be UTF-8", ""}});
    }
    return copy;
}

std::string optional_text(const char* text) {
    return text == nullptr ? "" : text_of(text, "text");
}

InUse::InUse(bool& flag) : flag_(flag) {
    if (flag) {
        throw Misuse("the handle is in use: its progress function must not use it");
    }
    flag = true;
}

}  // namespace quasimc::capi

int quasimc_abi_version(void) {
    return QUASIMC_ABI_VERSION;
}

const char* quasimc_version(void) {
    return quasimc::version().data();  // a literal, terminated by zero
}

const char* quasimc_last_error(void) {
    return quasimc::capi::last_error();
}
