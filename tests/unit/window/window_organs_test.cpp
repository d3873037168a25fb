// Organs and sensors as one list.

#include "window/window_organs.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace quasimc::test {
namespace {

/// Two leaves and sets of sensors.
Scene two_leaves_and(const std::vector<SensorSet>& sets) {
    SceneBuilder builder({{"PAR"}, {"NIR"}});
    builder.add_material({"leaf", {{0.1, 0.1}, {0.1, 0.1}}, {{0.1, 0.1}, {0.1, 0.1}}});
    for (const std::int64_t id : {7, 9}) {
        OrganSpec leaf;
        leaf.id = id;
        const double z = static_cast<double>(id);
        leaf.parts.push_back({"leaf", {{{{0, 0, z}, {1, 0, z}, {0, 1, z}}}}});
        builder.add_organ(std::move(leaf));
    }
    for (const SensorSet& set : sets) {
        builder.add_sensors(set);
    }
    return std::move(builder).build();
}

std::string estimate_json(int mean) {
    return R"({"PAR":{"mean":)" + std::to_string(mean) + R"(,"standard_error":1}})";
}

TEST(WindowOrgans, ListsSensorsLast) {
    SensorSet set{.name = "floor"};
    set.points = {{.position = {0, 0, 0}}, {.position = {1, 0, 0}}};
    const Scene scene = two_leaves_and({set});
    const WindowOrgans organs(scene);
    ASSERT_EQ(organs.all().size(), 4);
    EXPECT_EQ(organs.sensors(), 2);
    EXPECT_EQ(organs.id_of(1), "9");
    EXPECT_FALSE(organs.is_sensor(1));
    EXPECT_TRUE(organs.is_sensor(2));
    EXPECT_EQ(organs.id_of(3), "sensor 2") << "distinct from the ids of organs";
    EXPECT_EQ(organs.all()[3]->name, "floor 2");
}

/// Rationale: sensors have other quantities than organs. Expected behaviour: each number is in the
/// row of its own sensor, the fluence rate of a sphere as its upper side.
TEST(WindowOrgans, ReadsBothAsOneList) {
    SensorSet flat{.name = "floor"}, sphere{.name = "ball", .receiver = Receiver::sphere};
    flat.points = {{.position = {0, 0, 0}}};
    sphere.points = {{.position = {1, 0, 0}}};
    const Scene scene = two_leaves_and({flat, sphere});
    const WindowOrgans organs(scene);
    const std::string text = R"({"title":"t","organs":[{"absorbed_flux":)" + estimate_json(1) +
                             R"(,"incident_upper":)" + estimate_json(2) + R"(},{"absorbed_flux":)" +
                             estimate_json(3) + R"(}],"sensors":[{"incident_upper":)" +
                             estimate_json(4) + R"(},{"fluence_rate":)" + estimate_json(5) + "}]}";
    const RowsQuery query{
        .columns = {{"absorbed_flux", "PAR"}, {"incident_upper", "PAR"}, {"sunlit_fraction"}},
        .rest = RowsQuery::Rest::all};
    std::vector<PlacedRows> found;
    const Node rest = read_window_rows(
        text, "r.json", query, organs, [&](PlacedRows rows) { found.push_back(std::move(rows)); });
    ASSERT_EQ(found.size(), 1);
    const RowColumns& columns = found[0].columns;
    const auto means = [&columns](std::size_t column) {
        std::vector<double> all;
        for (const Estimate& estimate : columns[column]) {
            all.push_back(std::isnan(estimate.mean) ? -1 : estimate.mean);
        }
        return all;
    };
    EXPECT_EQ(means(0), (std::vector<double>{1, 3, -1, -1}));
    EXPECT_EQ(means(1), (std::vector<double>{2, -1, 4, 5}));
    EXPECT_TRUE(columns[2].empty());
    EXPECT_EQ(rest.find("sensors"), nullptr) << "read twice";
    EXPECT_NE(rest.find("title"), nullptr);
}

}  // namespace
}  // namespace quasimc::test
