#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "program.h"

namespace quasimc::test {

/// Tests of what runs do to their outputs.
class OutputsTest : public ProgramTest {
  protected:
    /// The good run file without [output].
    void SetUp() override {
        ProgramTest::SetUp();
        folder_.write(
            "bare.toml",
            replaced(good_run_file(), "[output]\ncsv = \"out.csv\"\njson = \"out.json\"\n", ""));
    }
    void make_links() const {
        std::filesystem::create_symlink("bare.toml", folder_.path() / "soft.csv");
        std::filesystem::create_hard_link(
            folder_.path() / "bare.toml", folder_.path() / "hard.csv");
        std::filesystem::create_symlink(".", folder_.path() / "here");
    }
    void write_old() {
        folder_.write("out.csv", "old");
        folder_.write("out.json", "old");
    }
    [[nodiscard]] bool has_new_csv() const {
        return folder_.read("out.csv").find("\n1,third,") != std::string::npos;
    }
    [[nodiscard]] bool has_new_json() const {
        const std::string json = folder_.read("out.json");
        return json.find("\"organs_sha256\"") != std::string::npos && json.ends_with("}\n");
    }
    [[nodiscard]] std::vector<std::string> hidden_files() const {
        std::vector<std::string> hidden;
        for (const std::string& name : new_files()) {
            if (name.starts_with(".")) {
                hidden.push_back(name);
            }
        }
        return hidden;
    }
};

}  // namespace quasimc::test
