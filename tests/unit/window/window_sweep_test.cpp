// The files of the points of a sweep.

#include "window/window_sweep.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "quasimc/error.h"

namespace quasimc::test {
namespace {

/// Records what is read, and gives data that say it.
struct Reads {
    std::vector<std::string> all;

    WindowData read(std::size_t point) {
        if (point == 2) {
            throw InputError({{"run.json", "has changed", "", ""}});
        }
        all.push_back(std::to_string(point));
        return {.json = all.back(), .shape = "shape", .values = {"v"}};
    }
};

std::string text_of(const WindowFiles& files, std::string_view name) {
    const auto file = files(name);
    return file ? std::string(file->body) : "none";
}

TEST(WindowSweep, ReadsPointsByTheirNames) {
    Reads reads;
    const WindowFiles files =
        files_of_sweep(4, 1, [&](std::size_t point) { return reads.read(point); });
    EXPECT_EQ(text_of(files, "data"), "1");
    EXPECT_EQ(text_of(files, "shape"), "shape");
    EXPECT_EQ(text_of(files, "point-0-data"), "0");
    EXPECT_EQ(text_of(files, "point-0-values-0"), "v");
    EXPECT_EQ(text_of(files, "point-3-data"), "3");
    EXPECT_EQ(reads.all.size(), 3) << "each is read once";
    for (const char* name :
         {"point-4-data", "point--1-data", "point-0", "point-x-data", "point-0-values-1",
          "point-99999999999999999999-data", "point-2-data"}) {
        EXPECT_EQ(text_of(files, name), "none") << name;
    }
}

TEST(WindowSweep, KeepsTheLastPointsOnly) {
    Reads reads;
    const WindowFiles files =
        files_of_sweep(23, 3, [&](std::size_t point) { return reads.read(point); });
    const auto ask = [&](int point) {
        return text_of(files, "point-" + std::to_string(point) + "-data");
    };
    for (int point = 3; point < 23; ++point) {
        EXPECT_EQ(ask(point), std::to_string(point));
    }
    EXPECT_EQ(ask(22), "22");
    EXPECT_EQ(reads.all.size(), 20);
    EXPECT_EQ(ask(3), "3");
    EXPECT_EQ(reads.all.size(), 21) << "the first one was forgotten";
}

}  // namespace
}  // namespace quasimc::test
