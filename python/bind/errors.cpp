#include <exception>
#include <string>

#include "bind.h"
#include "quasimc/error.h"
#include "quasimc/run.h"

namespace quasimc::python {
namespace {

py::object fault_dict(const Fault& fault) {
    py::dict result;
    result["where"] = fault.where;
    result["problem"] = fault.problem;
    result["why"] = fault.why;
    result["suggestion"] = fault.suggestion;
    return result;
}

/// Raises quasimc.errors.<type>(text, detail).
void raise(const char* type, const std::string& text, const py::object& detail) {
    const py::object error = py::module_::import("quasimc.errors").attr(type);
    PyErr_SetObject(error.ptr(), error(text, detail).ptr());
}

void translate(std::exception_ptr thrown) {
    try {
        if (thrown) {
            std::rethrow_exception(thrown);
        }
    } catch (const InputError& error) {
        py::list faults;
        for (const Fault& fault : error.faults()) {
            faults.append(fault_dict(fault));
        }
        raise("InputError", error.what(), faults);
    } catch (const Stopped& error) {
        const bool is_late = error.why() == StopReason::time_limit;
        raise("Stopped", error.what(), py::str(is_late ? "time_limit" : "interrupted"));
    }
}

}  // namespace

void bind_errors(py::module_& /*module*/) {
    py::register_exception_translator(&translate);
}

}  // namespace quasimc::python
