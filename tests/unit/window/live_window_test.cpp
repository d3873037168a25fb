// The data of a run in progress for pages.

#include "window/live_window.h"

#include <cstring>
#include <string>
#include <utility>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "scene/scene.h"
#include "window/window_shape.h"

namespace quasimc::test {
namespace {

using Json = nlohmann::json;

std::shared_ptr<const LiveScene> make_scene(double height = 1) {
    SceneBuilder builder({{"PAR"}, {"NIR"}});
    builder.add_material({"leaf", {{.1, .1}, {.4, .4}}, {{.1, .1}, {.4, .4}}});
    OrganSpec leaf;
    leaf.name = "leaf <&>";
    leaf.parts.push_back(
        {"leaf", std::vector<Triangle>{{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, height}}}});
    builder.add_organ(std::move(leaf));
    LiveScene scene;
    scene.scene = std::make_shared<const Scene>(std::move(builder).build());
    scene.bands = scene.scene->bands();
    scene.title = "A leaf";
    return std::make_shared<const LiveScene>(std::move(scene));
}

/// The light of a quantity in a band is 10 quantity + band; without light there is none.
Result make_result(std::size_t bands, double more = 0) {
    Result result;
    result.bands = bands;
    for (std::size_t i = 0; i < kQuantities * bands; ++i) {
        const double mean = 10.0 * static_cast<double>(i / bands) + static_cast<double>(i % bands);
        result.values.push_back({mean + more, .5, mean + more - 1, mean + more + 1});
    }
    for (std::size_t band = 0; band < bands; ++band) {
        BandBudget budget;
        budget.absorbed_by_organs.mean = 7 + static_cast<double>(band);
        result.budget.push_back(budget);
    }
    return result;
}

LiveFrame make_frame(
    std::string label, const std::shared_ptr<const LiveScene>& scene, std::vector<Result> results) {
    LiveFrame frame;
    frame.label = std::move(label);
    frame.scene = scene;
    frame.sources = {make_directional_source("sun", {0, 0, -1}, {1, 1})};
    frame.results = std::make_shared<const std::vector<Result>>(std::move(results));
    return frame;
}

std::string text_of(LiveWindow& window, const std::string& name) {
    const auto found = window.file(name);
    return found ? std::string(found->body) : "";
}

Json json_of(LiveWindow& window, const std::string& name) {
    return Json::parse(text_of(window, name));
}

float first_number(LiveWindow& window, const std::string& name) {
    const std::string bytes = text_of(window, name);
    float number = -1;
    EXPECT_EQ(bytes.size(), 4 * sizeof number) << name;
    std::memcpy(&number, bytes.data(), std::min(bytes.size(), sizeof number));
    return number;
}

TEST(LiveWindow, TellsOfFramesAsTheyCome) {
    LiveWindow window;
    EXPECT_FALSE(window.is_watched());
    window.send("waiting");
    EXPECT_TRUE(json_of(window, "live")["frames"].empty());
    EXPECT_TRUE(window.is_watched());
    const auto scene = make_scene();
    window.add(make_frame("step 1", scene, {make_result(2)}));
    window.add(make_frame("step 2", scene, {make_result(2)}));
    window.add(make_frame("step 3", make_scene(2), {make_result(2)}));
    window.send("more", .25);
    const Json news = json_of(window, "live");
    EXPECT_EQ(news["words"], "more");
    EXPECT_EQ(news["fraction"], .25);
    EXPECT_EQ(news["ended"], "");
    const Json& frames = news["frames"];
    ASSERT_EQ(frames.size(), 3U);
    EXPECT_EQ(frames[0]["scene"], frames[1]["scene"]);
    EXPECT_NE(frames[1]["scene"], frames[2]["scene"]);
    EXPECT_EQ(frames[2]["label"], "step 3");
    EXPECT_EQ(frames[2]["light"], (Json{{"PAR", 7}, {"NIR", 8}}));
    window.end("over");
    EXPECT_EQ(json_of(window, "live")["ended"], "over");
}

TEST(LiveWindow, GivesWhatAFrameHolds) {
    LiveWindow window;
    window.add(make_frame("now", make_scene(), {make_result(2)}));
    const Json scene = json_of(window, "scene-1");
    EXPECT_EQ(scene["title"], "A leaf");
    EXPECT_EQ(scene["organs"]["name"][0], "leaf <&>");
    EXPECT_EQ(scene["columns"][0]["quantity"], "absorbed_flux_density");
    EXPECT_EQ(scene["columns"][1]["band"], "NIR");
    EXPECT_EQ(text_of(window, "shape-1").size(), 12 + 9 * sizeof(float) + 3);
    const Json light = json_of(window, "light-1-1");
    EXPECT_EQ(light["label"], "now");
    EXPECT_EQ(light["suns"], Json::parse("[[0,0,1]]"));
    EXPECT_EQ(light["values"][3], 3);
    EXPECT_EQ(light["values"][12], -1) << "no sun, no sunlit fraction";
    // Columns: density, then absorbed flux, then the other quantities; two bands each.
    for (const auto& [column, mean] :
         {std::pair(0, 10.F), {1, 11.F}, {2, 0.F}, {3, 1.F}, {4, 20.F}, {11, 51.F}}) {
        EXPECT_EQ(first_number(window, "values-1-1-" + std::to_string(column)), mean) << column;
    }
    for (const char* name :
         {"values-1-1-12", "values-1-1-99", "values-2-1-0", "values-1-1", "values-1-1-0-",
          "scene-2", "scene-", "shape-01x", "light-1", "live-", "data", ""}) {
        EXPECT_FALSE(window.file(name)) << name;
    }
}

TEST(LiveWindow, TellsWhereLightComesFrom) {
    LiveWindow window;
    LiveFrame frame = make_frame("", make_scene(), {make_result(2)});
    window.add(frame);
    EXPECT_EQ(json_of(window, "light-1-1")["lamps"], Json::array());
    EXPECT_EQ(json_of(window, "light-1-1")["sky"], "");
    // Nine times as bright where x is positive: three times the digit.
    SkyShape shape;
    shape.radiance = [](const Vec3& d) { return d.x > 0 ? 9.0 : 1.0; };
    LampSpec lamp;
    lamp.name = "lamp";
    lamp.position = {1, 2, 3};
    lamp.flux = {1, 1};
    frame.sources.push_back(make_sky("sky", shape, {1, 0}));
    frame.sources.push_back(make_lamp(std::move(lamp)));
    window.add(frame);
    const Json light = json_of(window, "light-2-2");
    const Vec3 middle = window_middle(*frame.scene->scene);
    EXPECT_NEAR(light["lamps"][0][0], 1 - middle.x, 1e-9);
    EXPECT_NEAR(light["lamps"][0][1], 2 - middle.y, 1e-9);
    EXPECT_NEAR(light["lamps"][0][2], 3 - middle.z, 1e-9);
    const std::string sky = light["sky"];
    const std::string ring = std::string(9, '/') + std::string(18, 'V') + std::string(9, '/');
    ASSERT_EQ(sky.size(), 9 * 36U);
    EXPECT_EQ(sky.substr(0, 36), ring);
    EXPECT_EQ(sky.substr(8 * std::size_t{36}), ring) << "up to the zenith";
}

TEST(LiveWindow, ShowsBandsThatWereTracedByThemselves) {
    LiveWindow window;
    window.add(make_frame("", make_scene(), {make_result(1), Result()}));
    EXPECT_EQ(first_number(window, "values-1-1-0"), 10.F);
    EXPECT_FALSE(window.file("values-1-1-1")) << "a band without light";
    window.add(make_frame("", make_scene(), {make_result(1), make_result(1, 100)}));
    EXPECT_EQ(first_number(window, "values-2-1-1"), 110.F);
}

TEST(LiveWindow, ReplacesWhatIsKnownBetter) {
    LiveWindow window;
    const auto scene = make_scene();
    window.replace_newest(make_frame("", scene, {make_result(2)}));
    const Json before = json_of(window, "live")["frames"];
    window.replace_newest(make_frame("", scene, {make_result(2, .25)}));
    const Json after = json_of(window, "live")["frames"];
    ASSERT_EQ(after.size(), 1U);
    EXPECT_EQ(after[0]["number"], before[0]["number"]);
    EXPECT_EQ(after[0]["scene"], before[0]["scene"]);
    EXPECT_NE(after[0]["version"], before[0]["version"]);
    // A page that requests an older version gets the current numbers.
    EXPECT_EQ(first_number(window, "values-1-1-0"), 10.25F);
    EXPECT_EQ(first_number(window, "values-1-2-0"), 10.25F);
}

TEST(LiveWindow, KeepsNoMoreThanItMay) {
    LiveWindow few({.frames = 3});
    for (int i = 0; i < 10; ++i) {
        few.add(make_frame(std::to_string(i), make_scene(), {make_result(2)}));
    }
    const Json frames = json_of(few, "live")["frames"];
    ASSERT_EQ(frames.size(), 3U);
    EXPECT_EQ(frames[0]["label"], "7");
    EXPECT_FALSE(few.file("scene-7"));
    EXPECT_TRUE(few.file("scene-8"));
    LiveWindow small({.bytes = 1});
    small.add(make_frame("old", make_scene(), {make_result(2)}));
    const std::size_t one = small.bytes();
    small.add(make_frame("new", make_scene(), {make_result(2)}));
    EXPECT_EQ(json_of(small, "live")["frames"].size(), 1U) << "the newest is kept";
    EXPECT_EQ(small.bytes(), one);
}

TEST(LiveWindow, IsServedUnderTheSameRules) {
    const auto window = std::make_shared<LiveWindow>();
    window->add(make_frame("", make_scene(), {make_result(2)}));
    const std::string token(32, 'a');
    ViewerRoutes site(
        [window](std::string_view name) { return window->file(name); }, token, WindowKind::live);
    site.set_port(8080);
    const auto status = [&](const std::string& name, const std::string& more = "",
                            const std::string& secret = std::string(32, 'a')) {
        return site
            .answer(parse_request(
                "GET /" + secret + "/" + name + " HTTP/1.1\r\nHost: 127.0.0.1:8080\r\n" + more +
                "\r\n"))
            .status;
    };
    for (const char* name :
         {"", "live", "scene-1", "shape-1", "light-1-1", "values-1-1-0", "colors"}) {
        EXPECT_EQ(status(name), 200) << name;
        EXPECT_EQ(status(name, "", std::string(32, 'b')), 403) << name;
        EXPECT_EQ(status(name, "Origin: http://evil.example\r\n"), 403) << name;
        EXPECT_EQ(status(name, "Sec-Fetch-Site: cross-site\r\n"), 403) << name;
        EXPECT_EQ(status(name, "Host: evil.example\r\n"), 400) << name;
        EXPECT_EQ(status(name, "Host: 127.0.0.1:8080\r\n"), 400) << name << " two hosts";
    }
    EXPECT_EQ(status("data"), 404);
}

}  // namespace
}  // namespace quasimc::test
