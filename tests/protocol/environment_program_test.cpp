// The plant simulator's own side, with the program QuasiMC: by every transport, and in comparison
// with light in the same process.

#include "coupling/plants/environment_program.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "coupling/plants/light_in_process.h"
#include "files/input_files.h"
#include "session_fixture.h"

namespace quasimc::test {
namespace {

const std::string kDiffuseSky =
    "number of rays: 4096\nsky: uniform\nreturn type: D\nmaximum depth: 2\nverbose: 0\n";

class EnvironmentPrograms : public SessionTest, public ::testing::WithParamInterface<Transport> {
  protected:
    void SetUp() override {
        SessionTest::SetUp();
        before_ = std::filesystem::current_path();
        std::filesystem::current_path(folder_.path());
        folder_.write("light.qmc", kDiffuseSky);
    }
    void TearDown() override { std::filesystem::current_path(before_); }

    /// Starts QuasiMC. @param more  further lines of the environment file
    std::unique_ptr<EnvironmentProgram> started(const std::string& more = "") {
        const std::string text = "communication type: " + name_of(GetParam()) +
                                 "\nexecutable: " QUASIMC_ENVIRONMENT
                                 " light.qmc\nturtle position: %g %g %g\nturtle heading: %g %g "
                                 "%g\nturtle left: %g %g %g\nturtle up: %g %g %g\n" +
                                 more;
        folder_.write("comm.e", text);
        return std::make_unique<EnvironmentProgram>(
            read_comm_text(text, "comm.e", notices_), "comm.e", notices_);
    }

    /// Sends the queries of a pass; the first of four parts of a plant only shades.
    static void ask(PlantEnvironment& environment, int count) {
        constexpr float kParameters[]{1.F / 3, 0.7F};
        for (int i = 0; i < count; ++i) {
            const float request = i % 4 == 0 ? -1.F : 1.F;
            PlantQuery query;
            query.id = 8 * i;
            query.parameters = {&request, 1};
            query.following = "P";
            query.following_parameters = kParameters;
            const double c = std::cos(0.7 * i), s = std::sin(0.7 * i);
            query.frame = {{c * i / 7, 0.1 * i, s * i / 7}, {c, 0, s}, {s, 0, -c}, {0, 1, 0}};
            EXPECT_EQ(environment.query(query), nullptr);
        }
    }
    static void expect_equal(
        const std::vector<PlantAnswer>& answers, const std::vector<PlantAnswer>& expected) {
        ASSERT_EQ(answers.size(), expected.size());
        float sum = 0;
        for (std::size_t i = 0; i < answers.size(); ++i) {
            ASSERT_EQ(answers[i].values.size(), 1U);
            sum += answers[i].values[0].value_or(0);
            EXPECT_EQ(answers[i].id, expected[i].id);
            EXPECT_EQ(answers[i].values, expected[i].values);
        }
        EXPECT_TRUE(answers.empty() || sum > 0);
    }

    std::string reported_;
    Notices notices_{[this](const std::string& text) { reported_ += text + "\n"; }};

  private:
    std::filesystem::path before_;
};

INSTANTIATE_TEST_SUITE_P(
    Protocol,
    EnvironmentPrograms,
    ::testing::Values(Transport::pipes, Transport::files, Transport::memory, Transport::sockets),
    [](const auto& test) { return name_of(test.param); });

TEST_P(EnvironmentPrograms, AnswerAsLightInProcess) {
    LightInProcess in_process(
        read_specification("light.qmc", SpecificationKind::automatic, notices_), notices_,
        [&](const std::string& text) { reported_ += text; }, {});
    {
        const auto program = started();
        ASSERT_TRUE(program->is_connected()) << reported_;
        for (const int count : {1, 7, 100, 101, 1300, 3}) {
            ask(*program, count);
            ask(in_process, count);
            expect_equal(program->answers(count), in_process.answers(count));
        }
        EXPECT_TRUE(program->answers(0).empty());
    }
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
        const std::string name = entry.path().filename().string();
        EXPECT_TRUE(name == "comm.e" || name == "light.qmc") << name;
    }
    EXPECT_EQ(reported_, "");
}

TEST_P(EnvironmentPrograms, SendChunksOfAnySize) {
    LightInProcess in_process(
        read_specification("light.qmc", SpecificationKind::automatic, notices_), notices_,
        [&](const std::string& text) { reported_ += text; }, {});
    const auto program = started("communication type: " + name_of(GetParam()) + " 3\n");
    for (const int count : {2, 3, 10}) {
        ask(*program, count);
        ask(in_process, count);
        expect_equal(program->answers(count), in_process.answers(count));
    }
}

TEST_P(EnvironmentPrograms, FailIfTheyAreKilledDuringAComputation) {
    folder_.write("light.qmc", "number of rays: 1073741824\nmethod: light_tracing\nsky: uniform\n");
    const auto path = folder_.write(
        "killed",
        "#!/bin/sh\n(sleep 0.5; kill -9 $$) >/dev/null &\nexec " QUASIMC_ENVIRONMENT " \"$@\"\n");
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    const auto program = started("executable: ./killed light.qmc\n");
    ask(*program, 9);
    try {
        static_cast<void>(program->answers(0));
        FAIL() << "it should have been killed";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("signal 9"), std::string::npos) << error.what();
    }
    EXPECT_THROW(static_cast<void>(program->answers(1)), InputError);
}

TEST_P(EnvironmentPrograms, AreIgnoredIfTheyRefuse) {
    folder_.write("light.qmc", "number of rays: many\n");
    const auto program = started();
    ask(*program, 3);
    EXPECT_TRUE(program->answers(0).empty());
}

}  // namespace
}  // namespace quasimc::test
