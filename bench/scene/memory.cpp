// Peak memory of a process (VmHWM) that makes a scene and traces a few paths, in bytes per
// triangle. Each case is a process of its own, so that peaks are independent.
//
//   quasimc_bench_scene_memory [--triangles N]

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include <unistd.h>

#include <fmt/format.h>
#include <sys/wait.h>

#include "light/models/source.h"
#include "memory_scenes.h"
#include "quasimc/run.h"
#include "runfile/run_file.h"
#include "scene/scene.h"
#include "support/process_memory.h"

namespace quasimc::bench {
namespace {

using test::status_bytes;

constexpr std::size_t kTriangles = 1'000'000;

void trace_a_little(const Scene& scene, const Sources& sources) {
    const double read_peak = status_bytes("VmHWM"), resident = status_bytes("VmRSS");
    RunSpec spec;
    spec.method = Method::light_tracing;
    spec.paths = 1024;
    spec.replicates = 2;
    const Result result = run(scene, sources, spec);
    const auto triangles = static_cast<double>(scene.triangle_count());
    std::cerr << fmt::format(
        "scene {:.0f} (peak {:.0f}), ray caster built in {:.2f} s; ", resident / triangles,
        read_peak / triangles, result.preparation_seconds);
}

/// Makes a scene through the library's interface.
void run_api(const std::string& surface, std::size_t count, bool each) {
    SceneBuilder builder({Band{.name = "PAR"}});
    const std::vector<SideOptics> side{{.reflectance = 0.1, .transmittance = 0.1}};
    builder.add_material({"leaf", side, side});
    {
        Surface made = surface == "soup" ? soup(count) : sheet(count);
        Mesh mesh(std::move(made.vertices), std::move(made.faces));
        if (each) {
            for (std::size_t i = 0; i < mesh.size(); ++i) {
                builder.add_organ({.parts = {{"leaf", {mesh[i]}}}});
            }
        } else {
            std::vector<OrganPart> parts;
            parts.push_back({"leaf", std::move(mesh)});
            builder.add_organ({.parts = std::move(parts)});
        }
    }
    const Scene scene = std::move(builder).build();
    const Sources sources{make_directional_source("sun", {0, 0, -1}, {100})};
    trace_a_little(scene, sources);
}

void run_of_file(const std::string& file, bool each) {
    const std::string text = fmt::format(
        "bands = [\"PAR\"]\n[[source]]\ntype = \"directional\"\ndirection = [0, 0, -1]\n"
        "irradiance_facing = 100\n[[material]]\nname = \"leaf\"\nreflectance = 0.1\n"
        "transmittance = 0.1\n[[geometry]]\nfile = \"{}\"\nmaterial = \"leaf\"\n"
        "organs = \"{}\"\n",
        file, each ? "each" : "one");
    InputFiles files(std::filesystem::temp_directory_path());
    const RunFile read = read_run_text(text, "memory.toml", files);
    trace_a_little(read.scene, read.sources);
}

struct Case {
    std::string way, surface;  ///< api, obj, ply; soup, sheet
    bool each = false;
};

void run_case(const Case& which, std::size_t count, const std::string& file) {
    if (which.way == "api") {
        run_api(which.surface, count, which.each);
    } else {
        run_of_file(file, which.each);
    }
}

/// Runs a case in a child process, and prints its output.
int run_child(const Case& which, std::size_t count, const std::string& file) {
    const pid_t child = fork();
    if (child == 0) {
        const std::string number = std::to_string(count);
        execl(
            "/proc/self/exe", "memory", "--case", which.way.c_str(), which.surface.c_str(),
            which.each ? "each" : "one", number.c_str(), file.c_str(), nullptr);
        std::_Exit(EXIT_FAILURE);
    }
    int status = EXIT_FAILURE;
    waitpid(child, &status, 0);
    return status;
}

/// Runs the cases of one kind of surface.
int run_surface(const std::string& surface, std::size_t count) {
    int failures = 0;
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / fmt::format("quasimc_memory_{}", getpid());
    std::filesystem::create_directories(folder);
    for (const std::string way : {"api", "obj", "ply"}) {
        const std::string file = folder / ("surface." + way);
        if (way != "api") {
            const Surface made = surface == "soup" ? soup(count) : sheet(count);
            way == "obj" ? write_obj_file(made, file) : write_ply_file(made, file);
        }
        for (const bool each : {false, true}) {
            failures += run_child({way, surface, each}, count, file) == 0 ? 0 : 1;
        }
    }
    std::filesystem::remove_all(folder);
    return failures;
}

int main_of(const std::vector<std::string>& words) {
    if (words.size() == 6 && words[0] == "--case") {
        const std::size_t count = std::stoul(words[4]);
        run_case({words[1], words[2], words[3] == "each"}, count, words[5]);
        std::cerr << fmt::format(
            "{} {} {}: {:.0f} bytes a triangle\n", words[1], words[2], words[3],
            status_bytes("VmHWM") / static_cast<double>(count));
        return 0;
    }
    const bool given = words.size() == 2 && words[0] == "--triangles";
    const std::size_t count = given ? std::stoul(words[1]) : kTriangles;
    return run_surface("soup", count) + run_surface("sheet", count);
}

}  // namespace
}  // namespace quasimc::bench

int main(int count, char** words) {
    return quasimc::bench::main_of({words + 1, words + count});
}
