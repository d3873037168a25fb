#include <string>

#include "bind.h"
#include "quasimc/version.h"

PYBIND11_MODULE(_core, module) {
    using namespace quasimc::python;
    module.doc() = "The library behind quasimc: use that package, not this module.";
    module.attr("version") = std::string(quasimc::version());
    bind_errors(module);
    bind_scene(module);
    bind_catalogues(module);
    bind_sun(module);
    bind_gap_fraction(module);
    bind_result(module);
    bind_replicates(module);
    bind_run(module);
    bind_store(module);
    bind_series(module);
    bind_growth(module);
    bind_grow(module);
}
