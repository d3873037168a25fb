#include "io/results/window_head.h"

#include "io/results/json_parts.h"
#include "io/results/window_scene.h"
#include "io/runfile/options.h"

namespace quasimc {
namespace {

/// The members that write() adds, as an object.
template <typename Write>
std::string json_object(const Write& write) {
    JsonStream json;
    json.begin_object(kWindowLayout);
    write(json);
    json.end_object();
    return json.take();
}

}  // namespace

std::string window_run_head(const RunFile& run) {
    return json_object([&](JsonStream& json) {
        json_head(json, run);
        json_warnings(json, run);
    });
}

std::string window_light_head(const RunFile& run, const Result& result) {
    return json_object([&](JsonStream& json) {
        json_method(json, run, result, kWindowLayout);
        json_done(json, result, kWindowLayout);
        json_rounds(json, result, kWindowLayout);
        json_energy(json, run, result, kWindowLayout);
        json_groups(json, run, result.groups);
        json.boolean("escaped_is_remainder", result.escaped_is_remainder);
    });
}

std::string window_light_head(
    std::span<const Band> bands, const std::string& length_unit, const Result& result) {
    return json_object([&](JsonStream& json) {
        json.key("method");
        json.begin_object(kWindowLayout);
        json.text("used", method_name(result.chosen.method));
        json.text("reason", result.chosen.reason);
        json.end_object();
        json_done(json, result, kWindowLayout);
        json_energy(json, bands, length_unit, result, kWindowLayout);
        json.boolean("escaped_is_remainder", result.escaped_is_remainder);
    });
}

}  // namespace quasimc
