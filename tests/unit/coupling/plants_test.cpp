// Both environments of plants: the program at the other end of pipes, and light in this process.

#include <array>
#include <bit>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "coupling/plants/environment_program.h"
#include "coupling/plants/light_in_process.h"
#include "coupling_testing.h"
#include "growth/view/surface.h"
#include "support/temporary_folder.h"
#include "text/line_scanner.h"

namespace quasimc::test {
namespace {

const std::string kTurtleLines =
    "turtle position: %g %g %g\nturtle heading: %g %g %g\nturtle left: %g %g %g\n"
    "turtle up: %g %g %g\nturtle line width: %g\nturtle scale factor: %g\n";

CommFile format_of(const std::string& text) {
    RecordedNotices recorded;
    return read_comm_text(text, "comm.e", recorded.notices);
}

/// A query with its parameters.
struct MadeQuery {
    std::int64_t id = 0;
    std::vector<float> parameters;
    std::string following;
    std::vector<float> following_parameters = {};
    TurtleFrame frame = {};
    bool is_answered = true;

    [[nodiscard]] PlantQuery view() const {
        PlantQuery query;
        query.id = id;
        query.parameters = parameters;
        query.following = following;
        query.following_parameters = following_parameters;
        query.frame = frame;
        query.line_width = 2;
        query.is_answered = is_answered;
        return query;
    }
};

/// Leaves in many positions, whose numbers have more than six digits.
std::vector<MadeQuery> leaves(int count) {
    std::vector<MadeQuery> queries;
    for (int i = 0; i < count; ++i) {
        const double a = 0.7 * i, c = std::cos(a), s = std::sin(a);
        const TurtleFrame frame{
            {c / 3, 0.1 * i, s / 3}, {c, 0, s}, {s, 0, -c}, {1e-17 * c, i % 3 == 0 ? -1. : 1, -0.}};
        queries.push_back(
            {8 * i, {i % 4 == 3 ? -1.F : 1.F / 3, 0.F}, "P", {0.1F + i * 0.001F, 1.F / 7}, frame});
    }
    return queries;
}

std::map<std::int64_t, std::vector<std::optional<std::uint32_t>>> bits_of(
    const std::vector<PlantAnswer>& answers) {
    std::map<std::int64_t, std::vector<std::optional<std::uint32_t>>> bits;
    for (const PlantAnswer& answer : answers) {
        for (const auto& value : answer.values) {
            bits[answer.id].push_back(
                value ? std::optional(std::bit_cast<std::uint32_t>(*value)) : std::nullopt);
        }
    }
    return bits;
}

TEST(NumberLines, AreThoseOfPrintf) {
    const std::array<double, 3> values{-1.0 / 3, 6.123233995736766e-17, 123456789};
    for (const char* format :
         {" %g %g %g", "P: %f %.2f|%10.3e %%", "%-12g;%+08.1f;% G", "%lf %5.0f %E",
          "%012g %.12g "}) {
        Faults faults;
        const CommFile file = format_of("turtle position:" + std::string(format) + "\n");
        const NumberLine line(file.line(TurtleField::position), 3, faults);
        faults.throw_if_any();
        std::string text;
        line.append(text, values);
        std::array<char, 200> expected{};
        std::snprintf(expected.data(), expected.size(), format, values[0], values[1], values[2]);
        EXPECT_EQ(text, std::string(expected.data()) + "\n") << format;
    }
}

TEST(NumberLines, RejectOtherConversions) {
    for (const char* format : {"%s", "%g %g %g %g", "%g %n", "%*g", "%1000g", "%.99f", "%g %"}) {
        EXPECT_THROW(
            QueryWriter{format_of("turtle heading:" + std::string(format) + " %g\n")}, InputError)
            << format;
    }
    EXPECT_THROW(QueryWriter{format_of("turtle line width: %g %g\n")}, InputError);
}

TEST(SixDigits, AreThoseOfTheText) {
    for (const double value : {1.0 / 3, -0.0, 1e300 / 7, 5e-324, 999999.5, 0.1, 2e-7 / 3}) {
        std::string text;
        append_six_digits(text, value);
        EXPECT_EQ(
            std::bit_cast<std::uint64_t>(six_digits(value)),
            std::bit_cast<std::uint64_t>(std::strtod(text.c_str(), nullptr)))
            << text;
    }
}

TEST(CommFile, NamesTheProgramAndTheInterpretedModules) {
    const CommFile file = format_of(
        "executable:  QuasiMC -q light.qmc \ninterpreted modules: M(2), ~l;K\n"
        "remote host: other\n");
    EXPECT_EQ(file.executable, "QuasiMC -q light.qmc");
    EXPECT_EQ(file.remote_host, "other");
    EXPECT_TRUE(file.interprets("M", 2) && file.interprets("~l", 0) && file.interprets("K", 3));
    EXPECT_FALSE(file.interprets("M", 1) || file.interprets("P", 2) || file.interprets("", 0));
    EXPECT_TRUE(format_of("interpreted modules: all\n").interprets("P", 5));
    EXPECT_TRUE(format_of("when interpret: -1\n").interprets("P", 5));
    const CommFile by_count = format_of("when interpret: 1 3\n");
    EXPECT_TRUE(by_count.interprets("P", 3));
    EXPECT_FALSE(by_count.interprets("P", 2));
}

TEST(AnswersOfPrograms, AreRead) {
    const PlantAnswer answer = read_answer("41 E(0.5,,-1e-3,)", "program");
    EXPECT_EQ(answer.id, 41);
    const std::vector<std::optional<float>> expected{0.5F, {}, -1e-3F, {}};
    EXPECT_EQ(answer.values, expected);
    EXPECT_TRUE(read_answer("0 E", "program").values.empty());
    for (const char* line : {"hello", "E(1)", "1 F(1)", "1 E(1", "1 E(x)", "1"}) {
        EXPECT_THROW(static_cast<void>(read_answer(line, "program")), InputError) << line;
    }
}

/// One light with text between, and one without.
class BothWays {
  public:
    explicit BothWays(const std::string& text, const std::string& comm = kTurtleLines)
        : format_(format_of(comm)),
          by_text_(specification(text, recorded_), recorded_.notices),
          in_process_(
              specification(text, recorded_),
              recorded_.notices,
              [](const std::string&) {},
              {format_}) {}

    void expect_equal(const std::vector<MadeQuery>& queries, Drawing* (*draw)(Drawing*) = nullptr) {
        std::string text;
        for (const MadeQuery& query : queries) {
            QueryWriter(format_).append(text, query.view());
            Drawing* drawing = in_process_.query(query.view());
            EXPECT_EQ(drawing != nullptr, draw != nullptr);
            if (drawing != nullptr && draw != nullptr) {
                GraphicsText graphics(text);
                text += "Dbegin\n";
                draw(&graphics);
                draw(drawing);
                text += "Dend\n";
            }
        }
        append_master_control(text, ChunkPosition::only, step_);
        const auto answers = in_process_.answers(step_);
        EXPECT_EQ(bits_of(answers), bits_of(read(text)));
        EXPECT_FALSE(answers.empty());
        EXPECT_EQ(in_process_.snapshot().step, step_);
        by_text_.set_step(static_cast<std::uint64_t>(++step_));
    }
    [[nodiscard]] LightInProcess& in_process() { return in_process_; }

  private:
    std::vector<PlantAnswer> read(const std::string& text) {
        Pass pass;
        Answers answers;
        static_cast<void>(parser_.parse(text, pass));
        by_text_.answer(
            pass, [] {}, answers);
        std::vector<PlantAnswer> read;
        const auto replies = reply_chunks(pass, answers, 1000, 1U << 20U);
        LineScanner lines(replies.front());
        while (lines.next() && !lines.line().starts_with("Control")) {
            read.push_back(read_answer(lines.line(), "program"));
        }
        return read;
    }

    RecordedNotices recorded_;
    CommFile format_;
    MessageParser parser_{format_};
    PlantLight by_text_;
    LightInProcess in_process_;
    std::int64_t step_ = 0;
};

TEST(LightInProcess, HasTheBitsOfPipes) {
    BothWays both(
        "number of rays: 2048\nreturn type: F\nsky: uniform\nseed: 3\nmaximum depth: 3\n"
        "location: 51 -114\n");
    both.expect_equal(leaves(12));
    both.expect_equal(leaves(13));
    std::vector<MadeQuery> queries = leaves(9);
    queries.push_back({200, {1}, "Q", {512}});
    queries.push_back({300, {}, "P", {1, 1}});
    queries.push_back({400, {std::numeric_limits<float>::quiet_NaN()}, "P", {0.1F, 0.1F}});
    both.expect_equal(queries);
    both.expect_equal(leaves(3));
}

TEST(LightInProcess, HasTheBitsOfPipesForPolygons) {
    BothWays both(
        "number of rays: 1024\nreturn type: D\nleaf material (top): 0.1 0 0.1 0\n",
        kTurtleLines + "interpreted modules: M(1), P\n");
    const auto draw = [](Drawing* drawing) {
        const std::array<Vec3, 4> corners{
            Vec3{0, 1, 0}, Vec3{1.0 / 3, 1, 0}, Vec3{1.0 / 3, 1, 2.0 / 3}, Vec3{0, 1, 2.0 / 3}};
        BezierSurface surface;
        surface.mesh = std::make_shared<Mesh>(
            Mesh{Triangle{Vec3{0, 0, 0}, Vec3{1.0 / 7, 0, 0}, Vec3{0, 0, 1.0 / 7}}});
        drawing->begin_module({'M'});
        drawing->polygon(corners, 1);
        drawing->segment({{0, 0, 0}, {0, 1, 0}, 0.1, 0.1, {}}, 1);
        drawing->surface(surface, {}, 2);
        return drawing;
    };
    std::vector<MadeQuery> queries = leaves(2);
    queries[1].following = "M";
    queries[1].following_parameters = {1.5F};
    both.expect_equal(queries, draw);
    EXPECT_EQ(both.in_process().pass().polygons.size(), 4U);
    EXPECT_EQ(both.in_process().pass().other_graphics.front(), "cylinder");
    EXPECT_EQ(both.in_process().query(MadeQuery{0, {1}, "M", {1, 2}}.view()), nullptr);
}

TEST(LightInProcess, CountsPassesWithQueriesAndDropsAnswersOfHomomorphisms) {
    RecordedNotices recorded;
    LightInProcess light(
        specification("number of rays: 64\n", recorded), recorded.notices,
        [](const std::string&) {}, {});
    EXPECT_TRUE(light.answers(0).empty());
    std::vector<MadeQuery> queries = leaves(2);
    queries[1].id = 1;
    queries[1].is_answered = false;
    for (const MadeQuery& query : queries) {
        EXPECT_EQ(light.query(query.view()), nullptr);
    }
    EXPECT_EQ(light.answers(1).size(), 1U);
    EXPECT_EQ(light.snapshot().light->organs.size(), 2U);
    EXPECT_EQ(light.worst(), SessionOutcome::good);
}

TEST(LightInProcess, ReportsTheErrorsOfStepsAndContinues) {
    RecordedNotices recorded;
    std::string sent;
    LightInProcess light(
        specification("number of rays: 64\npicture file: /no/such/folder/file.ply\n", recorded),
        recorded.notices, [&](const std::string& text) { sent += text; }, {});
    const std::vector<MadeQuery> queries = leaves(1);
    for (int step = 0; step < 2; ++step) {
        static_cast<void>(light.query(queries[0].view()));
        static_cast<void>(light.answers(step));
    }
    EXPECT_NE(sent.find("step 0: "), std::string::npos);
    EXPECT_EQ(light.worst(), SessionOutcome::rejected);
}

/// Programs of a few lines for the shell.
class EnvironmentPrograms : public FolderTest {
  protected:
    void SetUp() override { std::signal(SIGPIPE, SIG_IGN); }

    /// Writes a program that handles "$line" of its input, after its first sign.
    std::string made(const std::string& handle) {
        const auto path = folder_.write(
            "program", fmt::format(
                           "#!/bin/sh\nprintf '\\001'\nwhile IFS= read -r line; do\n"
                           "echo \"$line\" >> '{}'\n{}\ndone\n",
                           (folder_.path() / "log").string(), handle));
        std::filesystem::permissions(path, std::filesystem::perms::owner_all);
        return path.string();
    }
    /// Starts a program that an environment file names.
    EnvironmentProgram started(
        const std::string& program, const std::string& lines = kTurtleLines) {
        return EnvironmentProgram(
            format_of("executable: " + program + "\n" + lines), "comm.e", recorded_.notices,
            {std::chrono::seconds(20), std::chrono::seconds(20)});
    }
    /// The errors of a pass with one query; "" if there are none.
    static std::string failure_of(EnvironmentProgram& program) {
        try {
            static_cast<void>(program.query(MadeQuery{0, {1}, "P", {2}}.view()));
            static_cast<void>(program.answers(0));
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }

    RecordedNotices recorded_;
};

/// Answers each query with its id, in chunks of one answer.
const std::string kAnswering =
    "case \"$line\" in\n"
    "  'Control: 8'*) printf 'Control: 5\\n\\001'; exit 0;;\n"
    "  Control*) echo 'Control: 5';;\n"
    "  *' E('*) echo \"${line%% *} E(${line%% *},)\"; echo 'Control: 1';;\n"
    "esac";

TEST_F(EnvironmentPrograms, ReceiveQueriesAndGiveAnswers) {
    {
        EnvironmentProgram program = started(made(kAnswering));
        ASSERT_TRUE(program.is_connected());
        const TurtleFrame frame{
            {-2, 1, 0}, {-1, 6.123233995736766e-17, 0}, {-6.123233995736766e-17, -1, 0}};
        EXPECT_EQ(program.query(MadeQuery{0, {1, 5}, "P", {0.5F}, frame}.view()), nullptr);
        EXPECT_EQ(program.query(MadeQuery{1, {7}, "Q", {}, {}, false}.view()), nullptr);
        EXPECT_EQ(program.query(MadeQuery{35, {2}, "~l", {3, 4}}.view()), nullptr);
        EXPECT_EQ(program.query(MadeQuery{57, {9}, ""}.view()), nullptr);
        const auto answers = program.answers(0);
        ASSERT_EQ(answers.size(), 3U);
        EXPECT_EQ(answers[1].id, 35);
        EXPECT_EQ(answers[1].values[0], 35.F);
        EXPECT_EQ(answers[1].values[1], std::nullopt);
        EXPECT_TRUE(program.answers(1).empty());
    }
    const std::string upright = " 0 0 0\n 0 1 0\n -1 0 0\n 0 0 -1\n 2\n 1\n";
    EXPECT_EQ(
        folder_.read("log"),
        "0 E(1,5)P(0.5)\n -2 1 0\n -1 6.12323e-17 0\n -6.12323e-17 -1 0\n 0 0 -1\n 2\n 1\n"
        "1 E(7)Q\n" +
            upright + "35 E(2)~l(3,4)\n" + upright + "57 E(9)\n" + upright +
            "Control: 5 0\nControl: 8 0\n");
    EXPECT_TRUE(recorded_.texts.empty()) << recorded_.texts.front();
}

TEST_F(EnvironmentPrograms, ReceiveChunksAndShapes) {
    {
        EnvironmentProgram program = started(
            made(kAnswering),
            "communication type: pipes 2\nfollowing module: no\ninterpreted modules: M\n");
        for (int i = 0; i < 5; ++i) {
            Drawing* drawing = program.query(MadeQuery{i, {1}, i == 1 ? "M" : "P"}.view());
            ASSERT_EQ(drawing != nullptr, i == 1);
            if (drawing != nullptr) {
                const std::array<Vec3, 1> corner{Vec3{1.0 / 3, -0.0, 1e-17}};
                drawing->polygon(corner, 0);
            }
        }
        EXPECT_EQ(program.answers(7).size(), 5U);
    }
    EXPECT_EQ(
        folder_.read("log"),
        "0 E(1)\n1 E(1)\nDbegin\npolygon\n 0.333333 -0 1e-17\nDend\nControl: 1 0\n"
        "2 E(1)\n3 E(1)\nControl: 0 0\n4 E(1)\nControl: 4 7\nControl: 8 0\n");
}

TEST_F(EnvironmentPrograms, FailIfTheyEndOrWriteSomethingElse) {
    EnvironmentProgram ending = started(made("exit 3"));
    EXPECT_NE(failure_of(ending).find("status 3"), std::string::npos);
    EXPECT_NE(failure_of(ending).find("status 3"), std::string::npos) << "again";
    EnvironmentProgram killed = started(made("kill -9 $$"));
    EXPECT_NE(failure_of(killed).find("signal 9"), std::string::npos);
    EnvironmentProgram talking = started(made("echo 'hello plant'"));
    EXPECT_NE(failure_of(talking).find("hello plant"), std::string::npos);
}

TEST_F(EnvironmentPrograms, AreIgnoredIfTheyCannotStart) {
    for (const std::string& program :
         {std::string("/no/such/program"), std::string("false"), std::string("echo sign")}) {
        recorded_.texts.clear();
        EnvironmentProgram ignored = started(program);
        EXPECT_FALSE(ignored.is_connected());
        EXPECT_EQ(failure_of(ignored), "");
        EXPECT_TRUE(recorded_.has("can't be started")) << program;
    }
    EXPECT_THROW(static_cast<void>(started("")), InputError);
    EXPECT_THROW(static_cast<void>(started("true", "remote host: other\n")), InputError);
}

TEST_F(EnvironmentPrograms, AreReportedIfTheyEndBadly) {
    { const EnvironmentProgram program = started(made("exit 4")); }
    EXPECT_TRUE(recorded_.has("status 4"));
}

TEST(ProgramCommand, HasSwitchesAfterTheName) {
    const std::vector<std::string> plain{"QuasiMC", "-e", "comm.e", "-k", "4", "light.qmc"};
    EXPECT_EQ((ProgramCommand{{"QuasiMC", "light.qmc"}, "comm.e"}.with({"-k", "4"})), plain);
    const std::vector<std::string> named{"QuasiMC", "-k", "4", "-e", "my.e", "light.qmc"};
    EXPECT_EQ(
        (ProgramCommand{{"QuasiMC", "-e", "my.e", "light.qmc"}, "comm.e"}.with({"-k", "4"})),
        named);
}

}  // namespace
}  // namespace quasimc::test
