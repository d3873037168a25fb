#include "runfile/sweep_rows.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/number_text.h"
#include "base/text.h"
#include "scene/sensors.h"

namespace quasimc {
namespace {

/// The identity of a row, and its area.
struct Row {
    std::string name;
    double area = 0;
};

std::vector<Row> rows_of_organs(const Scene& scene) {
    std::vector<Row> rows;
    for (const Organ& organ : scene.organs()) {
        rows.push_back({fmt::format("organ {} '{}'", organ.id, organ.name), organ.area});
    }
    return rows;
}

std::vector<Row> rows_of(const RunFile& run, CsvRows rows) {
    if (rows == CsvRows::sensors) {
        return run.scene.sensors().empty() ? std::vector<Row>()
                                           : rows_of_organs(scene_of_sensors(run.scene));
    }
    if (rows == CsvRows::organs) {
        return rows_of_organs(run.scene);
    }
    std::vector<Row> all;
    for (const OrganGroup& group : make_groups(run.scene, group_spec(run.spec))) {
        all.push_back({fmt::format("group {} '{}'", group.by, group.value), group.area});
    }
    return all;
}

/// Whether areas are equal to the rounding of single precision.
bool are_close(double a, double b) {
    constexpr double kRounding = 1e-5;
    return std::abs(a - b) <= kRounding * std::max(a, b);
}

}  // namespace

std::optional<Fault> difference_of_rows(
    const RunFile& first, const RunFile& other, const TableSpec& table) {
    if (first.spec.replicates != other.spec.replicates) {
        return Fault{
            table.location,
            fmt::format(
                "has {}, the first has {}", counted(other.spec.replicates, "replicate"),
                first.spec.replicates),
            "replicates are added in pairs, for the error of the sum", "set replicates in [run]"};
    }
    const std::vector<Row> before = rows_of(first, table.rows), rows = rows_of(other, table.rows);
    const char* why = "light is added row by row";
    const char* suggestion = "write a table per = \"time\", or sweep values that keep the rows";
    if (before.size() != rows.size()) {
        return Fault{
            table.location,
            fmt::format("has {}, the first has {}", counted(rows.size(), "row"), before.size()),
            why, suggestion};
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (rows[i].name != before[i].name || !are_close(rows[i].area, before[i].area)) {
            return Fault{
                table.location,
                fmt::format(
                    "has {} of area {}, the first has {} of area {}", rows[i].name,
                    shortest(rows[i].area), before[i].name, shortest(before[i].area)),
                why, suggestion};
        }
    }
    return std::nullopt;
}

}  // namespace quasimc
