// [[detector]]: by the keys of its type's row in the catalogue (detectors/catalogue.cpp).

#include <fmt/format.h>

#include "detectors/catalogue.h"
#include "runfile/run_file_sections.h"

namespace quasimc {
namespace {

void read_parameter(
    const DetectorParameter& parameter, TableReader& table, DetectorSpec& detector) {
    const Range range{parameter.low, parameter.high};
    std::optional<double> value;
    if (parameter.kind == NumberKind::real) {
        value = table.real(parameter.name, range);
    } else if (const auto whole = table.integer(parameter.name, range)) {
        value = static_cast<double>(*whole);
    }
    if (!parameter.usual) {
        table.required(parameter.name, value);
    }
    if (value) {
        detector.parameters.emplace(parameter.name, *value);
    }
}

void read_detector(const Node& node, Reporter& reporter, SceneBuilder& builder) {
    TableReader table(node, "detector", reporter);
    const std::optional<std::string> type =
        table.required("type", table.choice("type", names_in(detector_catalogue())));
    const std::string name = table.text("name").value_or(type.value_or("detector"));
    table.rename(fmt::format("detector '{}'", name));
    if (!type) {
        return;  // the type of the keys is unknown
    }
    DetectorSpec detector{.type = *type, .name = name, .parameters = {}, .where = table.where()};
    for (const DetectorParameter& parameter : find_detector(*type)->parameters) {
        read_parameter(parameter, table, detector);
    }
    table.finish();
    if (!table.failed()) {
        builder.add_detector(std::move(detector));
    }
}

}  // namespace

void read_detectors(TableReader& top, SceneBuilder& builder) {
    for (const Node* node : top.tables("detector")) {
        read_detector(*node, top.reporter(), builder);
    }
}

}  // namespace quasimc
