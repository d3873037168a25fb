#include <cstdint>
#include <filesystem>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "cli/program.h"
#include "quasimc/capi.h"

namespace quasimc::test {
namespace {

struct FreeScene {
    void operator()(quasimc_scene* scene) const { quasimc_scene_free(scene); }
};
struct FreeResult {
    void operator()(quasimc_result* result) const { quasimc_result_free(result); }
};

std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) {
        cells.push_back(cell);
    }
    return cells;
}

/// A column of a CSV table; "" is NaN in no column that we ask for.
std::vector<double> csv_column(const std::string& table, const std::string& name) {
    std::istringstream stream(table);
    std::vector<double> values;
    std::size_t column = std::string::npos;
    for (std::string line; std::getline(stream, line);) {
        if (line.starts_with('#')) {
            continue;
        }
        const std::vector<std::string> cells = cells_of(line);
        if (column == std::string::npos) {
            for (std::size_t i = 0; i < cells.size(); ++i) {
                column = cells[i] == name ? i : column;
            }
            continue;
        }
        values.push_back(std::stod(cells.at(column)));
    }
    return values;
}

TEST(SharedLibrary, GivesTheNumbersOfTheProgram) {
    const TemporaryFolder folder;
    for (const char* file : {"leaves.toml", "leaves.tri"}) {
        std::filesystem::copy(
            std::filesystem::path(QUASIMC_SOURCE_DIR) / "examples" / "01-leaves" / file,
            folder.path() / file);
    }
    const std::string example = (folder.path() / "leaves.toml").string();
    const Outcome said = run_program(folder.path(), {"run", "-q", "--csv", "-", example});
    ASSERT_EQ(said.status, 0) << said.err;

    quasimc_scene* scene = nullptr;
    ASSERT_EQ(quasimc_scene_load(example.c_str(), &scene), QUASIMC_DONE) << quasimc_last_error();
    const std::unique_ptr<quasimc_scene, FreeScene> scene_owner(scene);
    quasimc_result* result = nullptr;
    ASSERT_EQ(quasimc_scene_run(scene, nullptr, nullptr, &result), QUASIMC_DONE)
        << quasimc_last_error();
    const std::unique_ptr<quasimc_result, FreeResult> result_owner(result);

    const std::int64_t count = quasimc_result_organ_count(result);
    ASSERT_EQ(count, 500);
    for (const std::string quantity : {"absorbed_flux", "incident_upper", "incident_direct"}) {
        std::vector<double> values(static_cast<std::size_t>(count));
        ASSERT_EQ(
            quasimc_result_get(result, quantity.c_str(), "PAR", "mean", values.data(), count),
            QUASIMC_DONE);
        EXPECT_EQ(values, csv_column(said.out, quantity + "_PAR")) << quantity;
    }
}

}  // namespace
}  // namespace quasimc::test
