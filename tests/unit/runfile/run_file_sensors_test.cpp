// [[sensors]].

#include <cmath>

#include <gtest/gtest.h>

#include "scene/scene.h"
#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

RunText with_sensors(const std::string& keys, const std::string& rest = "") {
    RunText text;
    text.rest = "[[sensors]]\nname = 'bench'\n" + keys + rest;
    return text;
}

SensorSet read_set(const std::string& keys, const std::string& top = "") {
    RunText text = with_sensors(keys);
    text.top += top;
    return read_text(text.text()).scene.sensors().at(0);
}

void expect_faults(const std::string& text, const std::vector<std::string>& problems) {
    const std::vector<std::string> faults = faults_of(text);
    for (const std::string& problem : problems) {
        EXPECT_TRUE(mentions(faults, problem)) << problem << ::testing::PrintToString(faults);
    }
}

void expect_vector(const Vec3& a, const Vec3& b) {
    EXPECT_LT(length(a - b), 1e-12) << a.x << " " << a.y << " " << a.z;
}

TEST(RunFileSensors, AreAnArrayWithLabels) {
    const SensorSet set = read_set(
        "at = { start = [0, 0, 1], along = [4, 0, 0], across = [0, 3, 0], counts = [4, 3] }\n"
        "labels = { row = 'bench' }\nsize = 0.1\naverage = true\n");
    ASSERT_EQ(set.points.size(), 12U);
    EXPECT_EQ(set.counts, (std::array<std::size_t, 2>{4, 3}));
    expect_vector(set.points[5].position, {1.5, 1.5, 1});
    EXPECT_EQ(set.points[5].name, "bench 6");
    EXPECT_EQ(set.points[5].labels, (Labels{{"row", "bench"}, {"i", "2"}, {"j", "2"}}));
    EXPECT_EQ(set.radius, .1);
    EXPECT_EQ(set.rows(), 1U);
    EXPECT_EQ(set.receiver, Receiver::cosine);
}

TEST(RunFileSensors, FaceADirection) {
    const std::string at = "at = [[0, 0, 2]]\n";
    expect_vector(read_set(at).points[0].facing, {0, 0, 1});
    expect_vector(read_set(at + "facing = 'down'\n").points[0].facing, {0, 0, -1});
    expect_vector(read_set(at + "facing = [0, 3, 4]\n").points[0].facing, {0, .6, .8});
    expect_vector(
        read_set(at + "facing = { azimuth_deg = 90, elevation_deg = 30 }\n").points[0].facing,
        {std::sqrt(.75), 0, .5});
    expect_vector(
        read_set("at = [{ x = 0, y = 0, z = 1, tilt_deg = 30, heading_deg = 180 }]\n")
            .points[0]
            .facing,
        {0, -.5, std::sqrt(.75)});
    // y up: z, x and y of the file are x, y and z.
    const SensorSet y_up = read_set("at = [[1, 2, 3]]\nfacing = 'down'\n", "up = 'y'\n");
    expect_vector(y_up.points[0].position, {3, 1, 2});
    expect_vector(y_up.points[0].facing, {0, 0, -1});
}

TEST(RunFileSensors, HaveAReceiverAndAFieldOfView) {
    EXPECT_EQ(read_set("at = [[0, 0, 2]]\nreceiver = 'sphere'\n").receiver, Receiver::sphere);
    EXPECT_EQ(read_set("at = [[0, 0, 2]]\nfield_of_view_deg = 20\n").field_of_view_deg, 20);
}

TEST(RunFileSensors, StandAboveTheGround) {
    const std::string ground =
        "[ground]\nmaterial = 'leaf'\nheight = 5\nx = [-9, 9]\ny = [-9, 9]\n";
    const RunText above = with_sensors(
        "at = { start = [0, 0, 1], along = [2, 0, 0], counts = 2, above_ground = true }\n", ground);
    expect_vector(read_text(above.text()).scene.sensors()[0].points[1].position, {1.5, 0, 6});
    const RunText below = with_sensors(
        "at = { start = [0, 0, 0], along = [0, 0, 20], across = [1, 0, 0], counts = [4, 2] }\n",
        ground);
    expect_faults(
        below.text(),
        {"z is below the ground at 2 of 8 points (first: 1,1); say above_ground = true, or raise "
         "them"});
}

TEST(RunFileSensors, RefuseWhatTheyAreNot) {
    expect_faults(with_sensors("").text(), {"at is missing"});
    expect_faults(
        with_sensors("at = [[0, 0, 1]]\nfacing = 'north'\n").text(),
        {"facing is not a direction (it must be \"up\", \"down\", [x, y, z] or"});
    expect_faults(
        with_sensors("at = [[0, 0, 1]]\nreceiver = 'ball'\nsize = -1\n").text(),
        {"receiver", "size is -1"});
    expect_faults(
        with_sensors("at = [[0, 0, 1]]\nreceiver = 'sphere'\nfield_of_view_deg = 20\n").text(),
        {"field_of_view_deg of a sphere (it receives light from all directions)"});
    expect_faults(
        with_sensors("at = [[0, 0, 1, 0, 2]]\n").text(),
        {"at: the scale of copy 1 is 2 (a sensor has a size of its own); give size"});
    expect_faults(
        with_sensors("at = [[0, 0, 1]]\nmaterial = 'leaf'\n").text(), {"unknown key 'material'"});
    RunText nameless;
    nameless.rest = "[[sensors]]\nname = ''\nat = [[0, 0, 1]]\n";
    expect_faults(nameless.text(), {"its name is empty"});
    expect_faults(
        with_sensors("at = [[0, 0, 1]]\n[[sensors]]\nname = 'bench'\nat = [[0, 0, 2]]\n").text(),
        {"sensors 'bench': other sensors have this name"});
}

TEST(RunFileSensors, AreRepeatedAtHeights) {
    const std::string at = "at = [[1, 2, 0.5], [3, 4, 0.5]]\n";
    const auto sets =
        read_text(with_sensors(at + "average = true\nheights = [0, 1.5]\n").text()).scene.sensors();
    ASSERT_EQ(sets.size(), 2U);
    EXPECT_EQ(sets[0].name, "bench at 0");
    EXPECT_EQ(sets[1].name, "bench at 1.5");
    EXPECT_TRUE(sets[1].is_averaged);
    expect_vector(sets[1].points[1].position, {3, 4, 2});
    EXPECT_EQ(sets[1].points[1].name, "bench 2 at 1.5");
    const std::string y_up = "up = 'y'\n";
    RunText text = with_sensors("at = [[1, 0, 2]]\nheights = [3]\n");
    text.top += y_up;
    expect_vector(read_text(text.text()).scene.sensors().at(0).points[0].position, {2, 1, 3});
    expect_faults(
        with_sensors(at + "heights = []\n").text(),
        {"heights is empty; give [0.2, 0.5, 1], or leave it out for the points alone"});
    expect_faults(with_sensors(at + "heights = [1, 1]\n").text(), {"heights has 1 twice"});
    expect_faults(
        with_sensors(at + "heights = [1, -1]\n", "[ground]\nmaterial = 'leaf'\n").text(),
        {"z is below the ground at 2 of 2 points"});
}

/// An angle that is left out is 0.
TEST(RunFileSensors, FaceTheHorizonWithoutAnElevation) {
    const SensorSet set = read_set("at = [[0, 0, 2]]\nfacing = { azimuth_deg = 180 }\n");
    expect_vector(set.points[0].facing, {0, -1, 0});
}

TEST(RunFileSensors, HaveTheQuantitiesOfTheirReceiversInTables) {
    const std::string table = "[[table]]\nfile = 'b.csv'\nrows = 'sensors'\nquantities = ";
    const std::string flat = "at = [[0, 0, 1]]\n";
    const std::string sphere = flat + "receiver = 'sphere'\n";
    expect_faults(
        with_sensors(flat, table + "['incident_upper', 'fluence_rate']\n").text(),
        {"quantities: no sensor has a fluence_rate (it is the light on a sphere); give sensors "
         "receiver = \"sphere\""});
    expect_faults(
        with_sensors(sphere, table + "['incident_lower']\n").text(),
        {"quantities: no sensor has an incident_lower (all are spheres, which have no sides); "
         "give \"fluence_rate\""});
    const std::string both = "[[sensors]]\nname = 'ball'\n" + sphere;
    EXPECT_NO_THROW(static_cast<void>(read_text(
        with_sensors(flat, both + table + "['incident_upper', 'fluence_rate']\n").text())));
}

TEST(RunFileSensors, AreNeededByTheirTables) {
    RunText text;
    text.rest = "[output]\nsensors_csv = 'a.csv'\n[[table]]\nfile = 'b.csv'\nrows = 'sensors'\n";
    expect_faults(
        text.text(), {"sensors_csv without [[sensors]]", "rows = \"sensors\" without [[sensors]]"});
    expect_faults(
        with_sensors(
            "at = [[0, 0, 1]]\n",
            "[[table]]\nfile = 'b.csv'\nrows = 'sensors'\n"
            "quantities = ['absorbed_flux']\n")
            .text(),
        {"quantities: there is no 'absorbed_flux' in such a table"});
    expect_faults(
        with_sensors(
            "at = [[0, 0, 1]]\n",
            "[[table]]\nfile = 'b.csv'\nrows = 'sensors'\n"
            "where = \"sensor == 'bench'\"\n")
            .text(),
        {"where: unknown label 'sensor'"});
}

}  // namespace
}  // namespace quasimc::test
