// [sweep]: which runs a file asks for, what is wrong with it, and what its points share.

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "meshio/mesh_cache.h"
#include "quasimc/error.h"
#include "quasimc/result_file.h"
#include "quasimc/run.h"
#include "runfile/run_file.h"
#include "scene/overlap/covered.h"
#include "scene/scene.h"
#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

/// Counts how often each file is read.
struct CountedFiles {
    FakeFiles files;
    std::map<std::string, int> reads;
};

RunSweep sweep_of(const std::string& text, CountedFiles& counted) {
    const InputFiles files("/run", [&counted](const std::filesystem::path& path) {
        const std::string name = path.filename().string();
        ++counted.reads[name];
        return counted.files.at(name);
    });
    return read_sweep_document(read_toml(text, "run.toml"), "run.toml", [files] { return files; });
}

RunSweep sweep_of(const std::string& text) {
    CountedFiles none;
    return sweep_of(text, none);
}

/// A run file with a named sun and this below [sweep].
std::string swept(const std::string& keys) {
    RunText text;
    text.sources =
        "[[source]]\ntype = 'directional'\nname = 'sun'\nazimuth_deg = 180\nelevation_deg = 40\n"
        "irradiance_facing = 1\n";
    text.rest = "[sweep]\n" + keys;
    return text.text();
}

std::vector<std::string> sweep_faults(const std::string& keys) {
    std::vector<std::string> texts;
    try {
        static_cast<void>(sweep_of(swept(keys)));
    } catch (const InputError& error) {
        for (const Fault& fault : error.faults()) {
            texts.push_back(fault.text());
        }
    }
    return texts;
}

/// The values of all points, as texts: "10|0.1".
std::vector<std::string> points_of(RunSweep sweep) {
    std::vector<std::string> points;
    for (std::size_t i = 0; i < sweep.size(); ++i) {
        const RunFile run = sweep.take(i);
        std::string text;
        for (const SweptValue& value : (*run.sweep)[run.point].values) {
            text += (text.empty() ? "" : "|") + value.text;
        }
        points.push_back(text);
    }
    return points;
}

TEST(Sweep, CombinesEveryValueWithEveryOther) {
    EXPECT_EQ(
        points_of(sweep_of(swept("source.sun.elevation_deg = [10, 30]\n"
                                 "'material.leaf.reflectance' = [0, 0.1, [0.2]]\n"))),
        (std::vector<std::string>{"10|0", "10|0.1", "10|[0.2]", "30|0", "30|0.1", "30|[0.2]"}));
}

TEST(Sweep, TakesValuesTogetherOnRequest) {
    EXPECT_EQ(
        points_of(sweep_of(swept("combine = 'zip'\nsource.sun.elevation_deg = [10, 30]\n"
                                 "run.sampler = ['sobol', 'halton']\n"))),
        (std::vector<std::string>{"10|sobol", "30|halton"}));
}

/// The weights of all points.
std::vector<double> weights_of(const std::string& keys) {
    std::vector<double> weights;
    const RunFile run = sweep_of(swept(keys)).take(0);
    for (const SweepPoint& point : *run.sweep) {
        weights.push_back(point.weight);
    }
    return weights;
}

TEST(Sweep, WeighsItsPointsOrTheValuesOfItsKeys) {
    EXPECT_EQ(weights_of("paths = [64, 128]\n"), (std::vector<double>{1, 1}));
    EXPECT_EQ(
        weights_of("weights = [31, 28.5]\npaths = [64, 128]\n"), (std::vector<double>{31, 28.5}));
    const std::string keys = "source.sun.elevation_deg = [10, 30]\npaths = [64, 128]\n";
    EXPECT_EQ(
        weights_of("weights = { 'source.sun.elevation_deg' = [2, 3], paths = [0, 5] }\n" + keys),
        (std::vector<double>{0, 10, 0, 15}));
    EXPECT_EQ(
        weights_of("weights.source.sun.elevation_deg = [2, 3]\ncombine = 'zip'\n" + keys),
        (std::vector<double>{2, 3}));
}

TEST(Sweep, RefusesWeightsThatAreNotOneForEachPoint) {
    for (const auto& [weights, message] : std::vector<std::pair<std::string, std::string>>{
             {"[1, 2, 3]", "[sweep]: weights has 3 numbers, there are 2 points (each point needs"},
             {"{ paths = [1] }", "weights of paths has 1 number, there are 2 values"},
             {"{ pahts = [1, 2] }", "weights: 'pahts' is not swept; did you mean 'paths'?"},
             {"{ paths = 2 }", "weights of paths is an integer (it must be a list"},
             {"'all'", "weights is a text (it must be a list, a number for each point)"},
             {"[1, -2]", "weights is -2 (it must be a finite number of at least 0)"},
             {"[1, 'a']", "weights is a text (it must be a number)"},
             {"[0, 0]", "all weights are 0 (a sum needs"}}) {
        const auto faults = sweep_faults("weights = " + weights + "\npaths = [64, 128]\n");
        EXPECT_TRUE(mentions(faults, message)) << weights << ": " << faults.front();
        EXPECT_EQ(faults.size(), 1U) << weights;
    }
}

std::string tabulated_sweep(const std::string& keys, const std::string& table = "") {
    return swept(keys) + "[[table]]\nfile = 'sum.csv'\nper = 'sweep'\n" + table;
}

std::vector<std::string> faults_of_sweep(const std::string& text) {
    try {
        static_cast<void>(sweep_of(text));
    } catch (const InputError& error) {
        std::vector<std::string> texts;
        for (const Fault& fault : error.faults()) {
            texts.push_back(fault.text());
        }
        return texts;
    }
    return {};
}

/// Light is added row by row, and replicate by replicate.
TEST(Sweep, IsSummedOnlyOverEqualRowsAndReplicates) {
    const std::string corners =
        "'organ.1.corners' = [[[0,0,1],[1,0,1],[0,1,1]], [[0,0,1],[2,0,1],[0,1,1]], "
        "[[0,0,1],[3,0,1],[0,1,1]]]\n";
    const auto areas = faults_of_sweep(tabulated_sweep(corners));
    ASSERT_EQ(areas.size(), 1U);
    EXPECT_NE(areas[0].find("per = \"sweep\": point 2 ("), std::string::npos) << areas[0];
    EXPECT_NE(
        areas[0].find("has organ 1 'organ 1' of area 1, the first has organ 1 'organ 1' of "
                      "area 0.5"),
        std::string::npos)
        << areas[0];
    EXPECT_EQ(faults_of_sweep(tabulated_sweep(corners, "rows = 'groups'\n")).size(), 1U);
    EXPECT_TRUE(faults_of_sweep(swept(corners)).empty()) << "other tables have rows of each point";
    const auto replicates = faults_of_sweep(tabulated_sweep("replicates = [8, 4]\n"));
    ASSERT_EQ(replicates.size(), 1U);
    EXPECT_NE(replicates[0].find("has 4 replicates, the first has 8"), std::string::npos);
}

TEST(Sweep, OfMovedOrgansIsSummed) {
    EXPECT_TRUE(faults_of_sweep(tabulated_sweep("'organ.1.corners' = [[[0,0,1],[1,0,1],[0,1,1]], "
                                                "[[0,0,2],[0,1,2],[1,0,2]]]\n"))
                    .empty());
}

TEST(Sweep, TablesOfItsSumNeedIt) {
    const std::string table = "[[table]]\nfile = 'sum.csv'\nper = 'sweep'\n";
    EXPECT_TRUE(
        mentions(faults_of_sweep(RunText().text() + table), "per = \"sweep\" without [sweep]"));
    EXPECT_TRUE(mentions(
        faults_of_sweep(tabulated_sweep("paths = [64, 128]\n", "quantities = ['ratios']\n")),
        "quantities: there is no 'ratios' in such a table"));
}

TEST(Sweep, SetsWhatItsKeysName) {
    RunSweep sweep =
        sweep_of(swept("combine = 'zip'\npaths = [64, 128]\n"
                       "'source.1.irradiance_facing' = [2, 3]\n"
                       "material.leaf.transmittance = [0.1, 0.2]\n"));
    ASSERT_EQ(sweep.size(), 2U);
    const RunFile second = sweep.take(1);
    EXPECT_EQ(second.spec.paths, 128U);
    EXPECT_EQ(second.sources.front()->spectrum()[0], 3);
    EXPECT_NEAR(
        data_of(second.scene).materials.front().side(SurfaceSide::upper).albedo()[0], .2, 1e-15);
    EXPECT_EQ(sweep.take(0).spec.paths, 64U);
}

TEST(Sweep, OfNoneIsOfOnePoint) {
    RunSweep sweep = sweep_of(RunText().text());
    EXPECT_EQ(sweep.size(), 1U);
    EXPECT_EQ(sweep.take(0).sweep, nullptr);
}

/// A point is, bit for bit, the run of a file with its values.
TEST(Sweep, PointIsTheRunOfItsValues) {
    RunSweep sweep = sweep_of(swept("source.sun.elevation_deg = [10, 30]\n"));
    std::string alone = swept("");
    alone.resize(alone.find("[sweep]"));
    alone.replace(alone.find("= 40"), 4, "= 30");
    const RunFile point = sweep.take(1);
    const RunFile file = read_text(alone);
    EXPECT_EQ(
        digest_of_organs(point, run(point.scene, point.sources, point.spec)),
        digest_of_organs(file, run(file.scene, file.sources, file.spec)));
}

TEST(Sweep, TellsTheFaultsOfAllPointsOnceEach) {
    const std::vector<std::string> faults = sweep_faults(
        "source.sun.elevation_deg = [10, 95, 'high']\nsource.moon.name = ['a']\n"
        "material.leaf.reflectance = [0.1, 1.5]\nmaterial.leaf.reflektance = [1]\n"
        "paths = [64, 0]\n");
    ASSERT_EQ(faults.size(), 1U) << "where a key leads nowhere no point can be read";
    EXPECT_NE(
        faults[0].find("[sweep]: source.moon.name: there is no 'source.moon'"), std::string::npos)
        << faults[0];
    const std::vector<std::string> values = sweep_faults(
        "source.sun.elevation_deg = [10, 95, 'high']\n"
        "material.leaf.reflectance = [0.1, 1.5]\nmaterial.leaf.reflektance = [1]\n"
        "paths = [64, 0]\n");
    EXPECT_TRUE(mentions(values, "elevation_deg is 95"));
    EXPECT_TRUE(mentions(values, "elevation_deg is a text"));
    EXPECT_TRUE(mentions(values, "reflectance is 1.5"));
    EXPECT_TRUE(mentions(values, "unknown key 'reflektance'; did you mean 'reflectance'"))
        << values.back();
    EXPECT_TRUE(mentions(values, "paths: 0 is out of range"));
    EXPECT_EQ(values.size(), 5U);
}

TEST(Sweep, RefusesWhatCantBeSwept) {
    for (const auto& [keys, message] : std::vector<std::pair<std::string, std::string>>{
             {"", "[sweep]: it has no keys"},
             {"sun.elevation_deg = [1]\n", "write source.sun.elevation_deg"},
             {"bands.PAR = [1]\n",
              "'bands.PAR' can't be swept (it must be the same for all points)"},
             {"title = ['a', 'b']\n",
              "'title' can't be swept (it must be the same for all points)"},
             {"source = [1]\n", "'source' can't be swept (it is a section); name one of its keys"},
             {"pahts = [1]\n",
              "'pahts' can't be swept (it is not a run option); did you mean 'paths'?"},
             {"'' = [1]\n", "[sweep]: '' is not a key (part of it is empty)"},
             {"'run.' = [1]\n", "[sweep]: 'run.' is not a key (part of it is empty)"},
             {"run.groups = [['plant']]\n", "'run.groups' can't be swept"},
             {"ratios = [['R:FR']]\n", "it must be the same for all points"},
             {"paths = 64\n", "paths is an integer"},
             {"paths = []\n", "paths is an empty list"},
             {"combine = 1\npaths = [1]\n", "combine is 1 (it must be"},
             {"combine = 'zap'\npaths = [1]\n", "did you mean 'zip'?"},
             {"combine = 'zip'\npaths = [1, 2]\nseed = [1]\n", "seed has 1 values, paths has 2"},
             {"paths = [1]\nrun.paths = [2]\n", "paths and run.paths set the same"},
             {"source.sun = [{type = 'sun'}]\n", "there is no 'source.sun'"},
             {"source.3.name = ['x']\n", "there is no 'source.3'"},
             {"material.leaf.upper.reflectance = [0.1]\n", "there is no 'material.leaf.upper'"},
             {"material.leaf.name.first = ['a']\n", "'material.leaf.name' is a text"}}) {
        const std::vector<std::string> faults = sweep_faults(keys);
        EXPECT_TRUE(mentions(faults, message)) << keys << faults.back();
        EXPECT_FALSE(mentions(faults, "unknown key 'sweep'")) << keys;
    }
    std::string many;
    for (const char* key : {"seed", "paths", "replicates", "max_depth", "audit", "max_paths"}) {
        many += std::string(key) + " = [1, 2, 3, 4, 5, 6, 7, 8]\n";
    }
    EXPECT_TRUE(mentions(sweep_faults(many), "more than 100000 points"));
}

TEST(Sweep, AFlagThatItSweepsIsRefused) {
    const InputFiles files("/run");
    const auto said = [&](const std::string& keys, const Override& flag) {
        try {
            static_cast<void>(read_sweep_document(
                read_toml(swept(keys), "run.toml"), "run.toml", [&] { return files; }, {flag}));
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string("taken");
    };
    for (const auto& [keys, flag] : std::vector<std::pair<std::string, Override>>{
             {"paths = [64]\n", {"paths", "128", "--paths"}},
             {"method = ['first_hits']\n", {"method", "from_organs", "--method"}}}) {
        EXPECT_NE(
            said(keys, flag).find(flag.where + ": is swept by the run file"), std::string::npos)
            << said(keys, flag);
    }
}

TEST(Sweep, ReadsGeometryOnceWhereItStaysTheSame) {
    RunText text;
    text.organs = "[[geometry]]\nfile = 'leaves.tri'\nmaterial = 'leaf'\n";
    text.rest = "[sweep]\nmaterial.leaf.reflectance = [0.1, 0.2, 0.3]\nseed = [1, 2]\n";
    CountedFiles counted{{{"leaves.tri", "0 0 0 1 0 0 0 1 0\n"}}, {}};
    RunSweep sweep = sweep_of(text.text(), counted);
    const RunFile first = sweep.take(0);
    for (std::size_t i = 1; i < sweep.size(); ++i) {
        const RunFile other = sweep.take(i);
        EXPECT_EQ(&data_of(other.scene).triangles(), &data_of(first.scene).triangles());
        EXPECT_EQ(other.inputs.size(), first.inputs.size());
    }
    EXPECT_EQ(counted.reads["leaves.tri"], 1);
}

TEST(Sweep, KeepsTheParsedFilesOfThePointBefore) {
    const MeshCache::Key key{"a.tri", "tri", UpAxis::z, "m", {}};
    MeshCache meshes;
    meshes.start_point();
    meshes.add(key, std::make_shared<const MeshCache::Parsed>());
    for (int point = 0; point < 3; ++point) {
        meshes.start_point();
        EXPECT_NE(meshes.find(key), nullptr);
    }
    meshes.start_point();  // which does not name it
    meshes.start_point();
    EXPECT_EQ(meshes.find(key), nullptr);
}

TEST(Sweep, MayVaryGeometryToo) {
    RunText text;
    text.rest =
        "[sweep]\n'organ.1.corners' = [[[0,0,1],[1,0,1],[0,1,1]], [[0,0,1],[2,0,1],[0,1,1]]]\n";
    RunSweep sweep = sweep_of(text.text());
    EXPECT_EQ(sweep.take(0).scene.organs().front().area, .5);
    EXPECT_EQ(sweep.take(1).scene.organs().front().area, 1);
}

/// A sensor lets all light pass, and what it covers is not cut away: the scene is built anew.
/// Overlaps of unchanged organs are not searched again: the scenes are the same as those of single
/// runs.
TEST(Sweep, OfAPanelThatTurnsHasTheScenesOfItsPoints) {
    const std::string panel =
        "[[organ]]\nname = 'panel'\nmaterial = 'leaf'\nshape = 'parallelogram'\n"
        "corner = [-0.5, -0.5, 0]\nedge_a = [1, 0, 0]\nedge_b = [0, 1, 0]\n"
        "transform = { rotate = { axis = [0, 1, 0], angle_deg = 45 }, translate = [0.2, 0.2, 1] }\n"
        "[[organ]]\nname = 'shelf'\nmaterial = 'leaf'\nshape = 'parallelogram'\n"
        "corner = [-3, -3, 1]\nedge_a = [6, 0, 0]\nedge_b = [0, 6, 0]\n"
        "[[geometry]]\nfile = 'leaves.tri'\nmaterial = 'leaf'\nat = [[0, 0, 2], [1, 0, 2]]\n";
    RunText text;
    text.rest = panel + "[sweep]\norgan.panel.transform.rotate.angle_deg = [0, 30, 0, 180]\n";
    std::vector<std::pair<std::size_t, std::size_t>> read;
    const auto leaves = [](const std::filesystem::path&) { return "0 0 0 1 0 0 0 1 0\n"; };
    const InputFiles files("/run", leaves);
    RunSweep sweep = read_sweep_document(
        read_toml(text.text(), "run.toml"), "run.toml", [files] { return files; }, {},
        [&](std::size_t done, std::size_t points) { read.emplace_back(done, points); });
    EXPECT_EQ(
        read, (std::vector<std::pair<std::size_t, std::size_t>>{{0, 4}, {1, 4}, {2, 4}, {3, 4}}));
    const std::vector<std::string> angles{"0", "30", "0", "180"};
    for (std::size_t i = 0; i < 4; ++i) {
        RunText alone;
        alone.rest = panel;
        alone.rest.replace(alone.rest.find("45"), 2, angles[i]);
        CountedFiles counted{{{"leaves.tri", leaves("")}}, {}};
        const Scene expected = std::move(sweep_of(alone.text(), counted)).only_run().scene;
        const Scene found = sweep.take(i).scene;
        EXPECT_TRUE(data_of(found).triangles() == data_of(expected).triangles()) << i;
        EXPECT_EQ(
            data_of(found).coincidences->pairs.size(), data_of(expected).coincidences->pairs.size())
            << i;
        EXPECT_EQ(data_of(found).coincidences->pairs.size(), angles[i] == "30" ? 1U : 2U) << i;
        ASSERT_EQ(found.organs().size(), expected.organs().size());
        for (std::size_t k = 0; k < found.organs().size(); ++k) {
            EXPECT_EQ(found.organs()[k].covered_area, expected.organs()[k].covered_area);
        }
    }
}

TEST(Sweep, BuildsASceneAnewWhereAMaterialBecomesTransparent) {
    RunText text;
    text.materials += "transmission_model = 'mirror'\ntransmittance = 0.5\n";
    text.rest = "[sweep]\nmaterial.leaf.transmittance = [0.5, 1]\n";
    RunSweep sweep = sweep_of(text.text());
    EXPECT_TRUE(data_of(sweep.take(1).scene).materials.front().is_transparent());
    EXPECT_FALSE(data_of(sweep.take(0).scene).materials.front().is_transparent());
}

}  // namespace
}  // namespace quasimc::test
