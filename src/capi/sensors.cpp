#include "scene/sensors.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "capi/columns.h"
#include "capi/guard.h"
#include "capi/handles.h"
#include "quasimc/error.h"
#include "results/sensor_transmittance.h"

namespace quasimc::capi {
namespace {

/// Three numbers of an array. @throws Misuse  if it is NULL
Node point_node(const double* numbers, const char* name) {
    return numbers_node(std::span<const double>(&deref(numbers, name), 3));
}

int add_sensors(quasimc_scene* scene, const char* name, const std::function<Node()>& copies) {
    return change_scene(scene, [&](SceneDescription& description) {
        const std::string of_set = text_of(name, "name");
        description.add_table("sensors", {{"name", 0, {of_set}}, {"at", 0, copies()}});
    });
}

/// The value of a key from its text, in which words need no quotes.
Node value_node(const std::string& text, const std::string& where) {
    const bool is_word = text != "true" && text != "false" && !text.empty() &&
                         std::ranges::all_of(text, [](unsigned char c) { return std::isalpha(c); });
    if (is_word) {
        return {text};
    }
    const Node document = read_toml("value = " + text, where);
    const auto* keys = document.as<Node::Table>();
    if (keys->size() != 1) {
        throw InputError({{where, "the value has several lines", "", "give one value"}});
    }
    return keys->front().node;
}

const Result& sensors_of(const quasimc_result* result) {
    const auto& sensors = deref(result, "result").result.sensors;
    if (!sensors) {
        throw Misuse(
            "the result has no sensors: the scene has none, or the run was stopped before their "
            "light was computed");
    }
    return *sensors;
}

/// A set of sensors, and the index of its first result among those of all sets.
struct SetRows {
    const SensorSet& set;
    std::size_t first;
};

SetRows set_of(const quasimc_result* result, const char* name) {
    const std::string wanted = text_of(name, "set");
    std::size_t first = 0;
    for (const SensorSet& set : deref(result, "result").scene->sensors()) {
        if (set.name == wanted) {
            return {set, first};
        }
        first += set.rows();
    }
    throw Misuse(fmt::format("there are no sensors '{}'", wanted));
}

/// The name that a quantity of a set has in results, where the light on a sphere is on its upper
/// side. @throws Misuse  if the set has no such quantity
std::string stored_quantity(const SensorSet& set, std::string name) {
    constexpr std::string_view kFluenceRate = "fluence_rate", kUpper = "incident_upper";
    const bool is_sphere = set.receiver == Receiver::sphere;
    if (is_sphere && (name.starts_with(kUpper) || name.starts_with("incident_lower"))) {
        throw Misuse(
            fmt::format("'{}' are spheres, which have no sides: use {}", set.name, kFluenceRate));
    }
    if (is_sphere && name.starts_with(kFluenceRate)) {
        name.replace(0, kFluenceRate.size(), kUpper);
    }
    return name;
}

/// An estimate of a sensor, by its index in a set or among those of all sets.
using EstimateOfSensor = std::function<Estimate(std::size_t)>;

/// A quantity of the results of all sets.
EstimateOfSensor quantity_of(
    const quasimc_result* result, const std::string& name, const char* band) {
    const Result& sensors = sensors_of(result);
    if (name != kTransmittance) {
        return column_of(*result, sensors, rows_of_organs, name.c_str(), band);
    }
    return [&light = result->result, fraction = SensorTransmittance(*result->scene),
            b = band_of(*result, band)](std::size_t row) { return fraction.at(light, row, b); };
}

/// A quantity of the results of a set.
EstimateOfSensor quantity_of_set(
    const quasimc_result* result, const SetRows& rows, const char* quantity, const char* band) {
    const std::string name = stored_quantity(rows.set, text_of(quantity, "quantity"));
    return [of_all = quantity_of(result, name, band), first = rows.first](std::size_t index) {
        return of_all(first + index);
    };
}

}  // namespace
}  // namespace quasimc::capi

using namespace quasimc::capi;  // NOLINT(google-build-using-namespace): this file defines its own
using quasimc::Node;

int quasimc_scene_add_sensors(
    quasimc_scene* scene, const char* name, const double* positions, int64_t count) {
    return add_sensors(scene, name, [&] {
        if (count < 1) {
            throw Misuse(fmt::format("count is {}: a set has at least one sensor", count));
        }
        Node::List rows;
        for (int64_t i = 0; i < count; ++i) {
            rows.push_back(point_node(&deref(positions, "positions") + 3 * i, "positions"));
        }
        return Node{std::move(rows)};
    });
}

// NOLINTNEXTLINE(readability-function-size): the arrays of the C interface
int quasimc_scene_add_sensor_grid(
    quasimc_scene* scene,
    const char* name,
    const double* start,
    const double* along,
    const double* across,
    int64_t count_along,
    int64_t count_across) {
    return add_sensors(scene, name, [&] {
        Node::List counts{{count_along}};
        Node::Table array{
            {"start", 0, point_node(start, "start")}, {"along", 0, point_node(along, "along")}};
        if (across != nullptr) {
            array.push_back({"across", 0, point_node(across, "across")});
            counts.push_back({count_across});
        }
        array.push_back({"counts", 0, {std::move(counts)}});
        return Node{std::move(array)};
    });
}

int quasimc_scene_set_sensors(
    quasimc_scene* scene, const char* name, const char* key, const char* value) {
    return change_scene(scene, [&](SceneDescription& description) {
        const std::string set = text_of(name, "name"), of_key = text_of(key, "key");
        const std::string where = fmt::format("sensors '{}': {}", set, of_key);
        description.set_key("sensors", set, of_key, value_node(text_of(value, "value"), where));
    });
}

int64_t quasimc_result_sensor_count(const quasimc_result* result) {
    return guarded_or<int64_t>(-1, [&] {
        const auto& sensors = deref(result, "result").result.sensors;
        return sensors ? static_cast<int64_t>(sensors->organs()) : 0;
    });
}

const char* quasimc_result_sensor_name(const quasimc_result* result, int64_t sensor) {
    return guarded_or(kNoText, [&] {
        return item_at(sensors_of(result).names->organs(), sensor, "sensor").name.c_str();
    });
}

const char* quasimc_result_sensor_label(
    const quasimc_result* result, int64_t sensor, const char* key) {
    return guarded_or(kNoText, [&] {
        const auto& organ = item_at(sensors_of(result).names->organs(), sensor, "sensor");
        return label_by_key(organ, text_of(key, "key"));
    });
}

int quasimc_result_sensor_positions(
    const quasimc_result* result, double* positions, int64_t count) {
    return guarded([&] {
        const auto& sensors = deref(result, "result").result.sensors;
        check_count(count, sensors ? sensors->organs() : 0);
        if (count == 0) {
            return;
        }
        double* out = &deref(positions, "positions");
        const quasimc::Scene& scene = *result->scene;
        for (const quasimc::Vec3& position : quasimc::sensor_positions(scene)) {
            const quasimc::Vec3 p = scene.orientation().outward(position);
            for (const double x : {p.x, p.y, p.z}) {
                *out++ = x;
            }
        }
    });
}

int quasimc_result_get_sensors(
    const quasimc_result* result,
    const char* quantity,
    const char* band,
    const char* statistic,
    double* values,
    int64_t count) {
    return guarded([&] {
        copy_rows(
            quantity_of(result, text_of(quantity, "quantity"), band), sensors_of(result).organs(),
            statistic, values, count);
    });
}

int64_t quasimc_result_sensor_set_count(const quasimc_result* result) {
    return guarded_or<int64_t>(
        -1, [&] { return static_cast<int64_t>(deref(result, "result").scene->sensors().size()); });
}

const char* quasimc_result_sensor_set_name(const quasimc_result* result, int64_t set) {
    return guarded_or(kNoText, [&] {
        return item_at(deref(result, "result").scene->sensors(), set, "set of sensors")
            .name.c_str();
    });
}

int64_t quasimc_result_sensor_set_size(const quasimc_result* result, const char* set) {
    return guarded_or<int64_t>(
        -1, [&] { return static_cast<int64_t>(set_of(result, set).set.rows()); });
}

const char* quasimc_result_sensor_set_receiver(const quasimc_result* result, const char* set) {
    return guarded_or(kNoText, [&] {
        const bool is_sphere = set_of(result, set).set.receiver == quasimc::Receiver::sphere;
        return is_sphere ? "sphere" : "cosine";
    });
}

// NOLINTNEXTLINE(readability-function-size): names and an array, which C has no type to join
int quasimc_result_get_sensor_set(
    const quasimc_result* result,
    const char* set,
    const char* quantity,
    const char* band,
    const char* statistic,
    double* values,
    int64_t count) {
    return guarded([&] {
        const SetRows rows = set_of(result, set);
        copy_rows(
            quantity_of_set(result, rows, quantity, band), rows.set.rows(), statistic, values,
            count);
    });
}

int quasimc_result_get_sensor(
    const quasimc_result* result,
    const char* set,
    int64_t index,
    const char* quantity,
    const char* band,
    double* values) {
    return guarded([&] {
        const SetRows rows = set_of(result, set);
        if (index < 0 || index >= static_cast<int64_t>(rows.set.rows())) {
            throw Misuse(fmt::format(
                "there is no sensor {} of '{}': there are {}", index, rows.set.name,
                rows.set.rows()));
        }
        const auto estimate_of = quantity_of_set(result, rows, quantity, band);
        copy_estimate(estimate_of(static_cast<std::size_t>(index)), values);
    });
}
