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

    WindowData read(std::size_t point, std::optional<std::size_t> minus) {
        if (point == 2 && minus) {
            throw InputError({{"run.json", "has no organ of the first result", "", ""}});
        }
        all.push_back(std::to_string(point) + (minus ? "-" + std::to_string(*minus) : ""));
        return {.json = all.back(), .shape = "shape", .values = {"v"}};
    }
};

std::string text_of(const WindowFiles& files, std::string_view name) {
    const auto file = files(name);
    return file ? std::string(file->body) : "none";
}

TEST(WindowSweep, ReadsPointsByTheirNames) {
    Reads reads;
    const WindowFiles files = files_of_sweep(
        3, 1, [&](std::size_t point, auto minus) { return reads.read(point, minus); });
    EXPECT_EQ(text_of(files, "data"), "1");
    EXPECT_EQ(text_of(files, "shape"), "shape");
    EXPECT_EQ(text_of(files, "point-0-data"), "0");
    EXPECT_EQ(text_of(files, "point-0-values-0"), "v");
    EXPECT_EQ(text_of(files, "point-0-minus-2-data"), "0-2");
    EXPECT_EQ(reads.all.size(), 3) << "each is read once";
    for (const char* name :
         {"point-3-data", "point-0-minus-3-data", "point--1-data", "point-0", "point-x-data",
          "point-0-minus-data", "point-0-values-1", "point-99999999999999999999-data",
          "point-2-minus-0-data"}) {
        EXPECT_EQ(text_of(files, name), "none") << name;
    }
}

TEST(WindowSweep, KeepsTheLastPointsOnly) {
    Reads reads;
    const WindowFiles files = files_of_sweep(
        20, 0, [&](std::size_t point, auto minus) { return reads.read(point, minus); });
    const auto ask = [&](int point) {
        return text_of(files, "point-" + std::to_string(point) + "-data");
    };
    for (int point = 0; point < 20; ++point) {
        EXPECT_EQ(ask(point), std::to_string(point));
    }
    EXPECT_EQ(ask(19), "19");
    EXPECT_EQ(reads.all.size(), 20);
    EXPECT_EQ(ask(0), "0");
    EXPECT_EQ(reads.all.size(), 21) << "the first one was forgotten";
}

}  // namespace
}  // namespace quasimc::test
