#include "io/results/json_parts.h"
#include "io/runfile/units.h"

namespace quasimc {
namespace {

void write_units(JsonStream& json, const Scene& scene, JsonLayout layout) {
    json.key("unit");
    json.begin_object(layout);
    for (const Band& band : scene.bands()) {
        json.text(band.name, flux_unit(band.unit, scene.length_unit()));
    }
    json.end_object();
}

void write_bin(
    JsonStream& json,
    const Scene& scene,
    const DetectorResult& detector,
    std::size_t bin,
    JsonLayout layout) {
    json.begin_object(layout);
    json.text("bin", detector.bins[bin]);
    json.key("flux");
    json.begin_object(layout);
    for (std::size_t b = 0; b < scene.bands().size(); ++b) {
        json_estimate(json, scene.bands()[b].name, detector.at(bin, b), layout);
    }
    json.end_object();
    json.end_object();
}

}  // namespace

void json_detectors(JsonStream& json, const RunFile& run, const Result& result, JsonLayout layout) {
    if (result.detectors.empty()) {
        return;
    }
    json.key("detectors");
    json.begin_list(layout);
    for (const DetectorResult& detector : result.detectors) {
        json.begin_object(layout);
        json.text("name", detector.name);
        json.text("type", detector.type);
        json.text("quantity", detector.quantity);
        write_units(json, run.scene, layout);
        json.key("bins");
        json.begin_list(layout);
        for (std::size_t i = 0; i < detector.bins.size(); ++i) {
            write_bin(json, run.scene, detector, i, layout);
        }
        json.end_list();
        json.end_object();
    }
    json.end_list();
}

}  // namespace quasimc
