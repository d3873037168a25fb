#include "window/window_organs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "scene/sensors.h"

namespace quasimc {
namespace {

using PositionKey = std::tuple<std::size_t, std::string, std::size_t>;

PositionKey key_of(const RowsPosition& position) {
    return {position.point, position.part, position.index};
}

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

/// The query for sensors: those that are spheres have a fluence rate instead of an upper side.
RowsQuery sensor_query(const RowsQuery& query) {
    RowsQuery own = query;
    own.lists = {"sensors"};
    own.rest = RowsQuery::Rest::labels;
    for (const std::vector<std::string>& column : query.columns) {
        own.columns.push_back(column);
        own.columns.back().front() = column.front() == "incident_upper" ? "fluence_rate" : "";
    }
    return own;
}

/// The answer to sensor_query() with as many columns as the query for organs.
RowColumns sensor_columns(RowColumns both) {
    const std::size_t count = both.size() / 2;
    for (std::size_t i = 0; i < count; ++i) {
        const std::vector<Estimate>& rates = both[count + i];
        both[i].resize(std::max(both[i].size(), rates.size()), kUnknownEstimate);
        for (std::size_t row = 0; row < rates.size(); ++row) {
            both[i][row] = std::isnan(rates[row].mean) ? both[i][row] : rates[row];
        }
    }
    both.resize(count);
    return both;
}

}  // namespace

WindowOrgans::WindowOrgans(const Scene& scene) {
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
    const WindowOrgans& organs,
    const std::function<void(PlacedRows)>& take) {
    std::map<PositionKey, RowColumns> sensors;
    if (organs.sensors() > 0) {
        read_rows(text, path, sensor_query(query), [&](PlacedRows rows) {
            sensors[key_of(rows.position)] = sensor_columns(std::move(rows.columns));
        });
    }
    return read_rows(text, path, query, [&](PlacedRows rows) {
        rows.columns = joined(std::move(rows.columns), sensors[key_of(rows.position)], organs);
        take(std::move(rows));
    });
}

}  // namespace quasimc
