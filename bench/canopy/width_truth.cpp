#include "width_truth.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>

#include <fmt/format.h>

#include "base/process_time.h"
#include "methods.h"

namespace quasimc::bench {
namespace {

constexpr std::uint64_t kTruthSeed = 987654321;
constexpr std::uint32_t kTruthReplicates = 64;
/// Changes when quantities, or scenes in parts that the hash omits, change.
constexpr int kVersion = 1;

/// FNV-1a.
class Hash {
  public:
    void add(std::string_view bytes) {
        for (const char byte : bytes) {
            value_ = (value_ ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
        }
    }
    void add(double number) {
        char bytes[sizeof number];
        std::memcpy(bytes, &number, sizeof number);
        add(std::string_view(bytes, sizeof bytes));
    }
    [[nodiscard]] std::uint64_t value() const { return value_; }

  private:
    std::uint64_t value_ = 0xcbf29ce484222325U;
};

void add_sources(Hash& hash, const Sources& sources) {
    for (const auto& source : sources) {
        hash.add(source->name());
        for (const double amount : source->spectrum()) {
            hash.add(amount);
        }
    }
}

/// Hash of triangles, materials' names and the sources' spectra.
std::uint64_t hash_of(const WidthScene& scene) {
    Hash hash;
    for (const Organ& organ : scene.scene.organs()) {
        hash.add(scene.scene.material_name(scene.scene.regions()[organ.first_region]));
        for (const Triangle& triangle : scene.scene.triangles_of(organ)) {
            for (const Vec3& corner : triangle) {
                hash.add(corner.x);
                hash.add(corner.y);
                hash.add(corner.z);
            }
        }
    }
    add_sources(hash, scene.sources);
    for (const TimeStep& hour : scene.hours) {
        add_sources(hash, hour.sources);
    }
    return hash.value();
}

std::string material_of(const Scene& scene, const Organ& organ) {
    return organ.is_ground ? "ground" : scene.material_name(scene.regions()[organ.first_region]);
}

void add_organs(const Scene& scene, const Result& result, std::vector<WidthValue>& values) {
    for (std::size_t i = 0; i < result.organs(); ++i) {
        const std::string material = material_of(scene, scene.organs()[i]);
        const bool is_panel = material == "panel";
        if (!is_panel && material != "leaf" && material != "stem" && material != "ground") {
            continue;
        }
        const WidthKind kind = is_panel               ? WidthKind::sides
                               : material == "leaf"   ? WidthKind::leaves
                               : material == "ground" ? WidthKind::ground
                                                      : WidthKind::stems;
        const Quantity quantity =
            is_panel ? Quantity::incident_lower : Quantity::absorbed_flux_density;
        for (std::size_t b = 0; b < result.bands; ++b) {
            values.push_back({kind, b, result.at(i, quantity, b)});
        }
        for (std::size_t r = 0; kind == WidthKind::leaves && r < result.ratios; ++r) {
            values.push_back({WidthKind::ratios, r, result.ratio(i, r)});
        }
        if (kind == WidthKind::leaves && !result.sunlit_fraction.empty()) {
            values.push_back({WidthKind::sunlit, 0, result.sunlit_fraction[i]});
        }
    }
}

std::vector<WidthValue> values_of(const Scene& scene, const Result& result) {
    std::vector<WidthValue> values;
    add_organs(scene, result, values);
    for (std::size_t b = 0; b < result.bands; ++b) {
        for (std::size_t g = 1; g < result.groups.groups.size(); ++g) {
            values.push_back(
                {WidthKind::groups, b, result.groups.at(g, Quantity::absorbed_flux_density, b)});
        }
        values.push_back({WidthKind::total, b, result.budget[b].absorbed_by_organs});
    }
    return values;
}

std::vector<WidthValue> values_of(const Scene& scene, const SeriesSum& sum) {
    std::vector<WidthValue> values;
    for (std::size_t b = 0; b < sum.bands; ++b) {
        for (std::size_t i = 0; i < scene.organs().size(); ++i) {
            values.push_back({WidthKind::day, b, sum.at(i, Quantity::absorbed_flux_density, b)});
        }
        values.push_back({WidthKind::total, b, sum.groups.at(0, Quantity::absorbed_flux, b)});
    }
    return values;
}

std::filesystem::path file_of(const WidthScene& scene, const std::string& folder) {
    return std::filesystem::path(folder) / (scene.name + ".txt");
}

/// The values of a file, if its first line is `header`; else none.
std::vector<WidthValue> read_truth(const std::filesystem::path& path, const std::string& header) {
    std::ifstream file(path);
    std::string line;
    if (!std::getline(file, line) || line != header) {
        return {};
    }
    std::vector<WidthValue> values;
    int kind = 0;
    WidthValue value;
    while (file >> kind >> value.band >> value.estimate.mean >> value.estimate.standard_error) {
        value.kind = static_cast<WidthKind>(kind);
        values.push_back(value);
    }
    return values;
}

void write_truth(
    const std::filesystem::path& path,
    const std::string& header,
    const std::vector<WidthValue>& values) {
    std::filesystem::create_directories(path.parent_path());
    std::ofstream file(path);
    file << header << '\n';
    for (const WidthValue& value : values) {
        file << fmt::format(
            "{} {} {:.17g} {:.17g}\n", static_cast<int>(value.kind), value.band,
            value.estimate.mean, value.estimate.standard_error);
    }
}

}  // namespace

const char* name_of(WidthKind kind) {
    constexpr std::array kNames{"leaves", "dim leaves", "sides",  "stems",  "ground",
                                "groups", "total",      "ratios", "sunlit", "days"};
    return kNames[static_cast<std::size_t>(kind)];
}

WidthValues run_width(Simulator& simulator, const WidthScene& scene, const RunSpec& spec) {
    RunSpec whole = spec;
    whole.groups = scene.groups.labels;
    whole.layers = scene.groups.layers;
    whole.ratios = scene.ratios;
    const bool is_day = !scene.hours.empty();
    if (!is_day) {
        const Result result = simulator.run(scene.scene, scene.sources, whole);
        return {
            values_of(scene.scene, result), result.solve_cpu_seconds,
            kMethodNames[static_cast<std::size_t>(result.chosen.method)]};
    }
    const SeriesSummary summary = run_series(simulator, scene.scene, scene.hours, whole);
    const Method method = summary.methods.begin()->first;
    return {
        values_of(scene.scene, summary.total), summary.solve_cpu_seconds,
        kMethodNames[static_cast<std::size_t>(method)]};
}

std::vector<WidthValue> truth_of(
    const WidthScene& scene, const std::string& folder, std::uint64_t paths) {
    const std::string header = fmt::format(
        "{} version {} hash {:016x} replicates {} paths {}", scene.name, kVersion, hash_of(scene),
        kTruthReplicates, paths);
    if (!folder.empty()) {
        std::vector<WidthValue> known = read_truth(file_of(scene, folder), header);
        if (!known.empty()) {
            return known;
        }
    }
    RunSpec spec;
    spec.method = Method::first_hits;
    spec.replicates = kTruthReplicates;
    spec.paths = paths;
    spec.seed = kTruthSeed;
    const Stopwatch watch;
    Simulator simulator;
    WidthValues run = run_width(simulator, scene, spec);
    for (WidthValue& value : run.values) {
        double& error = value.estimate.standard_error;
        error = std::isfinite(error) ? error : 0;  // no contributions
    }
    std::printf(
        "  %s: the truth took %.1f s of CPU time\n", scene.name.c_str(), watch.cpu_seconds());
    if (!folder.empty()) {
        write_truth(file_of(scene, folder), header, run.values);
    }
    return run.values;
}

}  // namespace quasimc::bench
