#include <string>
#include <string_view>

#include "bind.h"
#include "quasimc/version.h"

namespace {

/// Refuses numpy 2 where pybind11 reads its arrays wrongly: it knows their layout from 2.12 on.
void check_numpy() {
    constexpr int kKnowsNumpy2 = 0x020C0000;
    const auto version = pybind11::module_::import("numpy").attr("__version__").cast<std::string>();
    if (PYBIND11_VERSION_HEX < kKnowsNumpy2 && !std::string_view(version).starts_with("1.")) {
        throw pybind11::import_error(
            "this build of quasimc reads arrays of numpy " + version +
            " wrongly (it was made with pybind11 older than 2.12); use numpy 1, or a wheel");
    }
}

}  // namespace

PYBIND11_MODULE(_core, module) {
    using namespace quasimc::python;
    check_numpy();
    module.doc() = "The library behind quasimc: use that package, not this module.";
    module.attr("version") = std::string(quasimc::version());
    bind_errors(module);
    bind_scene(module);
    bind_catalogues(module);
    bind_sun(module);
    bind_gap_fraction(module);
    bind_result(module);
    bind_summable_light(module);
    bind_replicates(module);
    bind_run(module);
    bind_store(module);
    bind_series(module);
    bind_grow(module);
}
