// Programs that call QuasiMC once per plant, like YplantQMC (an R package) and OpenAlea's
// vplants.quasimc: the input is a file that ends with the order to exit, all organs are polygons,
// and the result is the table of areas and fluxes.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <sstream>

#include <fcntl.h>
#include <unistd.h>

#include <fmt/format.h>

#include "captures.h"
#include "optics/material.h"
#include "quasimc/run.h"
#include "scene/scene.h"
#include "session_fixture.h"

namespace quasimc::test {
namespace {

using Corners = std::vector<Vec3>;

/// The environment file of both programs: it has no line about a turtle.
const std::string kEnviro =
    "executable: QuasiMC.exe -e enviro.e quasimc.cfg\ncommunication type: pipes\nverbose: off\n"
    "interpreted modules: all\n";

/// A table with a header, as R reads it: columns by name.
class Table {
  public:
    explicit Table(const std::string& text) {
        std::istringstream lines(text);
        std::string line;
        std::getline(lines, line);
        std::istringstream names(line);
        for (std::string name; names >> name;) {
            names_.push_back(name);
        }
        while (std::getline(lines, line)) {
            std::istringstream words(line);
            rows_.emplace_back();
            for (std::string word; words >> word;) {
                rows_.back().push_back(std::stod(word));
            }
            EXPECT_EQ(rows_.back().size(), names_.size()) << line;
        }
    }
    [[nodiscard]] std::size_t size() const { return rows_.size(); }
    [[nodiscard]] std::vector<double> column(const std::string& name) const {
        const auto found = std::find(names_.begin(), names_.end(), name);
        EXPECT_NE(found, names_.end()) << name;
        std::vector<double> values;
        for (const auto& row : rows_) {
            values.push_back(found == names_.end() ? NAN : row.at(found - names_.begin()));
        }
        return values;
    }

  private:
    std::vector<std::string> names_;
    std::vector<std::vector<double>> rows_;
};

/// The output between the first and the last sign.
std::string unsigned_text(const std::string& out) {
    return out.size() < 2 ? "" : out.substr(1, out.size() - 2);
}

/// The input of YplantQMC for a plant: numbers without a blank before them.
std::string plant_text(const std::vector<Corners>& leaves, const std::string& end) {
    std::string text;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        text += fmt::format("{} E(0)\nDbegin\npolygon\n", i + 1);
        for (const Vec3& p : leaves[i]) {
            text += fmt::format("{:.15g} {:.15g} {:.15g}\n", p.x, p.y, p.z);
        }
        text += "Dend\n";
    }
    return text + end;
}

/// YplantQMC's configuration, line by line in its order.
std::string yplant_configuration(const std::string& material, const std::string& light) {
    return "verbose: 0\nnumber of runs: 1\nsampling method: korobov\nnumber of rays: 65536\n"
           "maximum depth: 5\nRussian roulette: 0 0\ngrid size: 10 x 10 x 10\n"
           "remove objects: yes\nrays from objects: no\none ray per spectrum: yes\n"
           "ignore direct light: no\nreturn variance: yes\noutput file: yes qmcarea.out\n"
           "return type: D\nlocal light model: Lambertian\nspectrum samples: 1\n"
           "source spectrum: 660 1 730 1\nleaf material (top): " +
           material + "\nleaf material (bottom): " + material + "\n" + light + "\n";
}

class Batch : public SessionTest {
  protected:
    void SetUp() override {
        SessionTest::SetUp();
        folder_.write("enviro.e", kEnviro);
    }
    /// Runs "QuasiMC -e enviro.e quasimc.cfg -no_xserver < in > out"; returns the text of out.
    std::string call(const std::string& configuration, const std::string& input) {
        folder_.write("quasimc.cfg", configuration);
        const std::string name = folder_.write("in", input).string();
        return call_with(::open(name.c_str(), O_RDONLY | O_CLOEXEC), {false, 0});
    }
    std::string call_with(int in, Ending expected) {
        Process process(
            QUASIMC_ENVIRONMENT, {"-e", "enviro.e", "quasimc.cfg", "-no_xserver"}, folder_.path(),
            in);
        ::close(in);
        EXPECT_EQ(process.wait(), expected) << folder_.read("err");
        return folder_.read("out");
    }
};

/// A leaf 1 above another of the same size, both horizontal, and a vertical one in full light.
std::vector<Corners> three_leaves() {
    const auto square = [](double height) {
        return Corners{{0, height, 0}, {0, height, 2}, {2, height, 2}, {2, height, 0}};
    };
    return {square(1), square(0), {{-9, 0, 0}, {-9, 0, 1}, {-9, 1, 1}, {-9, 1, 0}}};
}

/// Light from 60 degrees above the horizon, rounded as YplantQMC does.
const std::string kTilted = "light source: 0.5 -0.866 0 1";
constexpr double kTolerance = 2e-3;  // of 65536 rays

TEST_F(Batch, AsYplantCallsItGivesAreasAndFluxesOfBlackLeaves) {
    const std::string out = call(
        yplant_configuration("0 0 0 0 1", kTilted), plant_text(three_leaves(), "Control: 8\n\n"));
    const Table table(folder_.read("qmcarea.out"));
    ASSERT_EQ(table.size(), 3U);
    const double sine = std::sin(std::numbers::pi / 3), shift = 0.5 / 0.866;
    const std::array<double, 3> area{4, 4, 1}, projected{4 * sine, 4 * sine, 0.5};
    // The shadow of the upper leaf falls beside the lower one by its shift.
    const std::array<double, 3> lit{4 * sine, 2 * shift * sine, 0.5};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(table.column("actual_leaf_area")[i], area[i], 1e-5);
        EXPECT_NEAR(table.column("mean_projected_area")[i], projected[i], 1e-3);
        EXPECT_NEAR(table.column("sunlit_area")[i], lit[i], 4 * kTolerance);
        EXPECT_NEAR(table.column("shaded_area")[i], projected[i] - lit[i], 4 * kTolerance);
        EXPECT_NEAR(table.column("mean_flux0")[i], lit[i] / area[i], kTolerance);
        EXPECT_NEAR(table.column("rel_mean_flux0")[i], lit[i] / area[i] / sine, 2 * kTolerance);
        EXPECT_EQ(table.column("variance0")[i], 0);  // of one run
    }
    // The answers, between two signs, have the same values.
    EXPECT_TRUE(out.starts_with('\x01') && out.ends_with("Control: 5\n\x01")) << out;
    const auto answers = values_of(unsigned_text(out));
    EXPECT_EQ(answers.size(), 3U);
    for (const auto& [id, value] : answers) {
        EXPECT_NEAR(value, table.column("mean_flux0").at(static_cast<std::size_t>(id - 1)), 1e-5);
    }
}

/// Directions of a sky with zenith angle, azimuth and weight, in the format of R's write.table.
TEST_F(Batch, AsYplantCallsItForDiffuseLight) {
    std::string sky;
    constexpr int kRings = 6, kAround = 10;
    for (int ring = 0; ring < kRings; ++ring) {
        for (int i = 0; i < kAround; ++i) {
            const double zenith = std::acos((ring + 0.5) / kRings);
            sky += fmt::format(
                "{:.15g} {:.15g} {:.15g}\n", zenith, 2 * std::numbers::pi * i / kAround,
                1.0 / (kRings * kAround));
        }
    }
    folder_.write("turtlediffuse.dat", sky);
    static_cast<void>(call(
        yplant_configuration("0.1 0 0.1 0 1", "light source file: turtlediffuse.dat"),
        plant_text({three_leaves().front()}, "Control: 8\n\n")));
    const Table table(folder_.read("qmcarea.out"));
    ASSERT_EQ(table.size(), 1U);
    // A single flat leaf absorbs the light that it neither reflects nor transmits.
    EXPECT_NEAR(table.column("rel_mean_flux0")[0], 0.8, kTolerance);
    // The mean of |cos| over such a sky is 0.5, and so is the projected fraction of a horizontal
    // leaf.
    EXPECT_NEAR(table.column("mean_projected_area")[0], 2, 1e-3);
    EXPECT_NEAR(table.column("sunlit_area")[0], 2, 4 * kTolerance);
}

/// Light absorbed per area by scattering leaves, computed by the library with random numbers.
std::vector<double> library_fluxes(const std::vector<Corners>& leaves) {
    SceneBuilder builder({{"660", "1"}}, Orientation{UpAxis::y, {-1, 0, 0}});
    SideOptics side;
    side.reflectance = 0.3;
    side.transmittance = 0.2;
    builder.add_material({"leaf", {side}, {side}});
    for (const Corners& corners : leaves) {
        OrganSpec organ;
        organ.name = "leaf";
        organ.parts.push_back({"leaf", make_polygon(corners)});
        builder.add_organ(std::move(organ));
    }
    const Scene scene = std::move(builder).build();
    Sources sources;
    const Vec3 travel = Orientation{UpAxis::y, {-1, 0, 0}}.inward({0.5, -0.866, 0});
    sources.push_back(make_directional_source("sun", normalized(travel), {1}));
    RunSpec spec;
    spec.method = Method::light_tracing;
    spec.sampler = "monte_carlo";
    spec.paths = 1U << 18U;
    spec.seed = 17;
    const Result result = run(scene, sources, spec);
    std::vector<double> fluxes;
    for (std::uint32_t i = 0; i < leaves.size(); ++i) {
        fluxes.push_back(result.at(i, Quantity::absorbed_flux_density, 0).mean);
    }
    return fluxes;
}

TEST_F(Batch, AgreesWithTheLibraryOnLeavesThatScatterLight) {
    static_cast<void>(call(
        yplant_configuration("0.3 0 0.2 0 1", kTilted),
        plant_text(three_leaves(), "Control: 8\n")));
    const auto ours = Table(folder_.read("qmcarea.out")).column("mean_flux0");
    const auto expected = library_fluxes(three_leaves());
    ASSERT_EQ(ours.size(), expected.size());
    for (std::size_t i = 0; i < ours.size(); ++i) {
        EXPECT_NEAR(ours[i], expected[i], 0.01) << "leaf " << i;
    }
    // The lower leaf absorbs more than half of its direct light, because the upper one scatters
    // light to it.
    EXPECT_GT(ours[1], 0.5 * 0.25 + 0.01);
}

/// The triangles of a regular octahedron.
std::vector<Corners> octahedron(const Vec3& middle) {
    std::vector<Corners> faces;
    for (const double x : {-1.0, 1.0}) {
        for (const double y : {-1.0, 1.0}) {
            for (const double z : {-1.0, 1.0}) {
                faces.push_back(
                    {middle + Vec3{x, 0, 0}, middle + Vec3{0, y, 0}, middle + Vec3{0, 0, z}});
            }
        }
    }
    return faces;
}

/// OpenAlea gives every triangle the id of its shape, and reads seven numbers for each; more than a
/// hundred answers need several chunks.
TEST_F(Batch, AsOpenAleaCallsItForManyTrianglesOfAShape) {
    constexpr int kShapes = 15;
    std::string input;
    for (int shape = 0; shape < kShapes; ++shape) {
        for (const Corners& face : octahedron({3.0 * shape, 0, 0})) {
            input += fmt::format("{} E(0)\nDbegin\npolygon\n", 100 + shape);
            for (const Vec3& p : face) {
                input += fmt::format(" {:.1f} {:.1f} {:.1f}\n", p.x, p.y, p.z);
            }
            input += "Dend\n";
        }
    }
    const std::string out = call(
        "verbose: 0\nnumber of runs: 1\nsampling method: korobov\nnumber of rays: 65536\n"
        "maximum depth: 4\nRussian roulette: 0.0 0.7\ngrid size: 10 x 10 x 10\n"
        "remove objects:\tyes\nrays from objects: no\none ray per spectrum: yes\n"
        "ignore direct light: no\nreturn type: D\noutput file: yes addoutput.dat\n"
        "local light model: Lambertian\nspectrum samples: 1\nsource spectrum: 660 1\n"
        "leaf material (top): 0.0 0 0.0 0 1\nleaf material (bottom): 0.0 0 0.0 0 1\n"
        "light source: 0.0 -1.0 0.0 1.0\n",
        input + "Control: 8\n");
    // It interprets every line that begins with a number as an answer.
    std::istringstream lines(out.substr(1));
    std::map<int, double> density;
    std::size_t answers = 0;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        int id = 0;
        std::string value;
        if (words >> id >> value) {
            density[id] += std::stod(value.substr(2));
            ++answers;
        }
    }
    EXPECT_EQ(answers, 8U * kShapes);
    EXPECT_EQ(density.size(), std::size_t{kShapes});
    const auto sunlit = Table(folder_.read("addoutput.dat")).column("sunlit_area");
    ASSERT_EQ(sunlit.size(), answers);
    for (int shape = 0; shape < kShapes; ++shape) {
        // From above the octahedron is a square of diagonal 2, of which each upper face covers a
        // quarter.
        const double seen = std::accumulate(&sunlit[8 * shape], &sunlit[8 * shape] + 8, 0.0);
        EXPECT_NEAR(seen, 2, 0.05);
        EXPECT_NEAR(density[100 + shape], 4 / std::sqrt(3.0), 0.06);
    }
}

/// Every order to exit, with and without the end of its line, from a file and from a closed pipe.
TEST_F(Batch, AnswersQueriesBeforeAnyOrderToExit) {
    const std::string black =
        "number of rays: 1024\nreturn type: D\nleaf material (top): 0 0 0 0\n";
    const std::vector<Corners> leaf{three_leaves().front()};
    for (const char* end :
         {"Control: 8", "Control: 8 0\n", "Control: 9 0\n", "Control: 12 3\n", "Control: 13 0\n",
          "Control: 1 0\nControl: 8 0\n"}) {
        const std::string input = plant_text(leaf, end);
        std::filesystem::remove(folder_.path() / "out");
        const std::string from_file = call(black, input);
        EXPECT_NEAR(values_of(unsigned_text(from_file)).at(1), 1, kTolerance) << end;
        std::array<int, 2> pipe{};
        ASSERT_EQ(::pipe2(pipe.data(), O_CLOEXEC), 0);
        ASSERT_EQ(::write(pipe[1], input.data(), input.size()), static_cast<ssize_t>(input.size()));
        ::close(pipe[1]);
        std::filesystem::remove(folder_.path() / "out");
        EXPECT_EQ(call_with(pipe[0], {false, 0}), from_file) << end;
    }
}

/// With tens of thousands of corners, an algorithm that visits all of them for each triangle takes
/// an hour.
TEST_F(Batch, TakesAPolygonOfVeryManyCorners) {
    constexpr int kCorners = 30000;
    Corners circle;
    for (int i = 0; i < kCorners; ++i) {
        const double angle = 2 * std::numbers::pi * i / kCorners;
        circle.push_back({std::cos(angle), 0, std::sin(angle)});
    }
    static_cast<void>(call(
        yplant_configuration("0 0 0 0 1", "light source: 0 -1 0 1"),
        plant_text({circle}, "Control: 8\n")));
    const Table table(folder_.read("qmcarea.out"));
    EXPECT_NEAR(table.column("actual_leaf_area").at(0), std::numbers::pi, 1e-5);
    EXPECT_NEAR(table.column("rel_mean_flux0").at(0), 1, kTolerance);
}

/// A table between the answers would be read as an answer.
TEST_F(Batch, RefusesAnOutputFileThatIsTheLineOfTheAnswers) {
    for (const std::string name : {"/dev/stdout", "out"}) {
        folder_.write("quasimc.cfg", "number of rays: 64\noutput file: yes " + name + "\n");
        const std::string in =
            folder_.write("in", plant_text({three_leaves().front()}, "Control: 8\n")).string();
        std::filesystem::remove(folder_.path() / "out");
        const std::string out = call_with(::open(in.c_str(), O_RDONLY | O_CLOEXEC), {false, 1});
        EXPECT_EQ(out, std::string(1, '\0')) << "there will be no light";
        EXPECT_NE(
            folder_.read("err").find("output file: '" + name + "' is the file of the answers"),
            std::string::npos)
            << folder_.read("err");
    }
}

TEST_F(Batch, SaysWhenItsAnswersCantBeWritten) {
    folder_.write("quasimc.cfg", "number of rays: 64\n");
    folder_.write("in", plant_text({three_leaves().front()}, "Control: 8\n"));
    const std::string call = "cd '" + folder_.path().string() + "' && '" + QUASIMC_ENVIRONMENT +
                             "' -e enviro.e quasimc.cfg <in 2>err ";
    for (const auto& [where, why] : std::vector<std::pair<std::string, std::string>>{
             {">/dev/full", "No space left on device"}, {">&-", "standard output is closed"}}) {
        EXPECT_NE(std::system((call + where).c_str()), 0);  // NOLINT(concurrency-mt-unsafe)
        EXPECT_EQ(folder_.read("err"), "QuasiMC: the answers can't be written: " + why + "\n");
    }
}

/// Every line begins with the program's name, as a simulator writes to the same log.
TEST_F(Batch, NamesItselfInEveryLineOfItsMessages) {
    static_cast<void>(folder_.write("in", ""));
    folder_.write("quasimc.cfg", "number of rays: x\nnumber of runs: y\n");
    const std::string in = (folder_.path() / "in").string();
    static_cast<void>(call_with(::open(in.c_str(), O_RDONLY | O_CLOEXEC), {false, 1}));
    folder_.write("enviro.e", "communication type: nonsense\n");
    const std::string of_specification = folder_.read("err");
    static_cast<void>(call_with(::open(in.c_str(), O_RDONLY | O_CLOEXEC), {false, 1}));
    std::istringstream lines(of_specification + folder_.read("err"));
    int count = 0;
    for (std::string line; std::getline(lines, line); ++count) {
        EXPECT_TRUE(line.starts_with("QuasiMC: ")) << line;
    }
    EXPECT_GE(count, 4);
}

/// 256 MB without the end of a line are read once, and most of them are dropped.
TEST_F(Batch, EndsAfterALineWithoutEnd) {
    folder_.write("quasimc.cfg", "");
    const std::string name = folder_.write("in", "0 E(1)P(").string();
    std::filesystem::resize_file(name, std::uintmax_t{1} << 28U);
    static_cast<void>(call_with(::open(name.c_str(), O_RDONLY | O_CLOEXEC), {false, 1}));
    EXPECT_NE(folder_.read("err").find("is incomplete"), std::string::npos);
}

}  // namespace
}  // namespace quasimc::test
