#include "window/window_organs.h"

#include <utility>

#include "resultio/stored_columns.h"
#include "runfile/table_rows.h"
#include "scene/sensors.h"

namespace quasimc {
namespace {

/// The columns of organs, followed by those of sensors; empty where neither has values.
RowColumns joined(RowColumns organs, const RowColumns& sensors, const WindowOrgans& list) {
    for (std::size_t i = 0; i < organs.size(); ++i) {
        const bool has_sensors = i < sensors.size() && !sensors[i].empty();
        if (organs[i].empty() && !has_sensors) {
            continue;
        }
        organs[i].resize(list.all().size() - list.sensors(), kUnknownEstimate);
        if (has_sensors) {
            organs[i].insert(organs[i].end(), sensors[i].begin(), sensors[i].end());
        }
        organs[i].resize(list.all().size(), kUnknownEstimate);
    }
    return organs;
}

}  // namespace

WindowOrgans::WindowOrgans(const Scene& scene) : spheres_(spheres_of(scene)) {
    if (!scene.sensors().empty()) {
        sensors_ = scene_of_sensors(scene);
    }
    for (const Organ& organ : scene.organs()) {
        all_.push_back(&organ);
    }
    if (sensors_) {
        for (const Organ& sensor : sensors_->organs()) {
            all_.push_back(&sensor);
        }
    }
}

std::string WindowOrgans::id_of(std::size_t index) const {
    const std::string id = std::to_string(all_[index]->id);
    return is_sensor(index) ? "sensor " + id : id;
}

Node read_window_rows(
    std::string_view text,
    const std::string& path,
    const RowsQuery& query,
    const OrgansOfPoints& organs_of,
    const std::function<void(PlacedRows)>& take) {
    RowsQuery own = query;  // spheres have a fluence rate instead of an upper side
    own.lists = {"organs", "sensors"};
    std::vector<std::size_t> upper;
    const std::size_t count = query.columns.size();
    for (std::size_t i = 0; i < count; ++i) {
        if (query.columns[i].front() == "incident_upper") {
            upper.push_back(i);
            own.columns.push_back(query.columns[i]);
            own.columns.back().front() = kFluenceRate;
        }
    }
    return read_light_rows(text, path, own, [&](LightRows rows) {
        const WindowOrgans& organs = organs_of(rows.position.point);
        for (std::size_t i = 0; i < upper.size() && !rows.sensors.empty(); ++i) {
            put_fluence(organs.spheres(), rows.sensors[upper[i]], rows.sensors[count + i]);
        }
        if (!rows.organs.empty()) {
            rows.organs.resize(count);
            take({rows.position, "organs", joined(std::move(rows.organs), rows.sensors, organs)});
        }
    });
}

}  // namespace quasimc
