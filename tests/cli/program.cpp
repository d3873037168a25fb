#include "program.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <set>

#include <sys/wait.h>

namespace quasimc::test {
namespace {

namespace fs = std::filesystem;

std::string quoted(const std::string& word) {
    std::string text = "'";
    for (const char c : word) {
        text += c == '\'' ? "'\\''" : std::string(1, c);
    }
    return text + "'";
}

}  // namespace

Outcome run_program(
    const fs::path& folder, const std::vector<std::string>& arguments, const std::string& input) {
    std::string command = "\"$quasimc\"";
    for (const std::string& argument : arguments) {
        command += " " + quoted(argument);
    }
    return run_shell(folder, command, input);
}

Outcome run_shell(const fs::path& folder, const std::string& command, const std::string& input) {
    const TemporaryFolder streams;
    const fs::path in = streams.write("in", input);
    const std::string whole =
        "cd " + quoted(folder.string()) + " && { quasimc=" + quoted(QUASIMC_PROGRAM) + "; " +
        command + "\n} <" + quoted(in.string()) + " >" + quoted((streams.path() / "out").string()) +
        " 2>" + quoted((streams.path() / "err").string());
    const int status =
        std::system(("bash -c " + quoted(whole)).c_str());  // NOLINT(concurrency-mt-unsafe)
    return {
        WIFEXITED(status) ? WEXITSTATUS(status) : 128, streams.read("out"), streams.read("err")};
}

std::string good_run_file() {
    return R"(format = 1
bands = ["PAR"]
[run]
paths = 256
replicates = 3
[output]
csv = "out.csv"
json = "out.json"
[[source]]
type = "directional"
direction = [0, 0, -1]
irradiance_facing = 1
[[material]]
name = "leaf"
reflectance = 0.1
transmittance = 0.2
[[geometry]]
file = "leaves.tri"
material = "leaf"
[[organ]]
name = "third"
material = "leaf"
shape = "triangle"
corners = [[0, 0, 5], [1, 0, 5], [0, 1, 5]]
)";
}

std::string good_leaves() {
    return "0 0 1 1 0 1 0 1 1\n0 0 2 1 0 2.5 0 1 2\n";
}

std::string replaced(std::string text, const std::string& find, const std::string& replacement) {
    const std::size_t at = text.find(find);
    if (at == std::string::npos) {
        ADD_FAILURE() << "no '" << find << "' to replace";
        return text;
    }
    return text.replace(at, find.size(), replacement);
}

void ProgramTest::SetUp() {
    folder_.write("run.toml", good_run_file());
    folder_.write("leaves.tri", good_leaves());
}

Outcome ProgramTest::run_within(
    double seconds, std::vector<std::string> arguments, const std::string& words) const {
    arguments.insert(arguments.end(), {"--max-seconds", ""});
    for (;; seconds *= 2) {
        arguments.back() = std::to_string(seconds);
        Outcome outcome = run(arguments);
        if (outcome.out.find(words) != std::string::npos || seconds > kLongestLimit) {
            return outcome;
        }
    }
}

std::vector<std::string> ProgramTest::new_files() const {
    const std::set<std::string> own{"run.toml", "leaves.tri", "leaves.obj", "leaves.ply"};
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_.path())) {
        const std::string name = entry.path().filename().string();
        if (!own.contains(name)) {
            names.push_back(name);
        }
    }
    std::sort(names.begin(), names.end());
    return names;
}

}  // namespace quasimc::test
