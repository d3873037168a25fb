// The files of the points of a sweep.

#include "window/window_sweep.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace quasimc::test {
namespace {

std::string text_of(const WindowFiles& files, std::string_view name) {
    const auto file = files(name);
    return file ? std::string(file->body) : "none";
}

TEST(WindowSweep, NamesTheFilesOfPoints) {
    std::vector<WindowData> points;
    for (const char* json : {"0", "1", "2"}) {
        points.push_back({.json = json, .shape = "shape", .values = {"v"}});
    }
    const WindowFiles files = files_of_sweep(std::move(points));
    EXPECT_EQ(text_of(files, "data"), "0");
    EXPECT_EQ(text_of(files, "shape"), "shape");
    EXPECT_EQ(text_of(files, "point-0-data"), "0");
    EXPECT_EQ(text_of(files, "point-0-values-0"), "v");
    EXPECT_EQ(text_of(files, "point-2-data"), "2");
    for (const char* name :
         {"point-3-data", "point--1-data", "point-0", "point-x-data", "point-0-values-1",
          "point-99999999999999999999-data"}) {
        EXPECT_EQ(text_of(files, name), "none") << name;
    }
}

}  // namespace
}  // namespace quasimc::test
