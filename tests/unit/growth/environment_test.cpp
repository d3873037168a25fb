#include "growth/environment.h"

#include <functional>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "growing.h"

namespace quasimc::test {
namespace {

using Texts = std::vector<std::string>;
using Values = std::vector<std::optional<float>>;

/// An environment that notes its queries, answers by a table, and draws what it is sent.
class NotedEnvironment : public PlantEnvironment {
  public:
    Drawing* query(const PlantQuery& query) override {
        std::string text = fmt::format("{}:", query.id);
        for (const float value : query.parameters) {
            text += fmt::format(" {}", value);
        }
        text += " " + query.following;
        for (const float value : query.following_parameters) {
            text += fmt::format(" {}", value);
        }
        queries.push_back(text);
        notes.push_back(
            {query.frame, query.line_width, query.scale, query.module, query.is_answered});
        return drawing;
    }

    std::vector<PlantAnswer> answers(std::int64_t step) override {
        passes.push_back(step);
        queries.push_back("end " + std::to_string(step));
        return answer ? answer(step) : std::vector<PlantAnswer>();
    }

    struct Note {
        TurtleFrame frame;
        double width = 0, scale = 0;
        DrawnModule module;
        bool is_answered = false;
    };
    Texts queries;
    std::vector<Note> notes;
    std::vector<std::int64_t> passes;
    std::function<std::vector<PlantAnswer>(std::int64_t)> answer;
    Drawing* drawing = nullptr;
};

TEST(PlantQueries, HaveTheirPlacesAsIds) {
    NotedEnvironment environment;
    grow(lsystem(1, "F?E(1)?E(2,3)P(4)[?E]X?E(5)", "\n"), "", &environment);
    EXPECT_EQ(environment.queries, (Texts{"0: 1 ?", "8: 2 3 P 4", "29: ]", "33: 5 ", "end 0"}));
}

TEST(PlantQueries, TellWhatFollows) {
    NotedEnvironment environment;
    grow(lsystem(1, "?E(0)F(2)?E(0)~l(3)?E(0)@O(4)?E(0)[F]?E(0)", "\n"), "", &environment);
    EXPECT_EQ(
        environment.queries,
        (Texts{"0: 0 F 2", "15: 0 ~l 3", "31: 0 @O 4", "47: 0 [", "58: 0 ", "end 0"}));
}

TEST(PlantQueries, TellTheTurtle) {
    NotedEnvironment environment;
    grow(
        lsystem(1, "#(9)F(2)@D(3)[+(90)F(1)?E(0)X]", "\n"), "initial line width: 0.5\n",
        &environment);
    ASSERT_EQ(environment.notes.size(), 1U);
    const auto& note = environment.notes[0];
    EXPECT_NEAR(note.frame.position.x, -3, 1e-12);
    EXPECT_NEAR(note.frame.position.y, 2, 1e-12);
    EXPECT_NEAR(note.frame.heading.x, -1, 1e-12);
    EXPECT_NEAR(note.frame.up.z, -1, 1e-12);
    EXPECT_EQ(note.width, 0.5) << "widths are not executed";
    EXPECT_EQ(note.scale, 3);
    EXPECT_EQ(note.module.branch, 1U);
    EXPECT_EQ(note.module.order, 1U);
    EXPECT_TRUE(note.is_answered);
}

TEST(PlantQueries, OfTheHomomorphismHaveNoAnswer) {
    NotedEnvironment environment;
    environment.answer = [](std::int64_t) { return std::vector<PlantAnswer>{{1, Values{7}}}; };
    const Grown grown = grow(
        lsystem(1, "A(2)B", "A(x) --> A(x)\nhomomorphism\nA(x) --> F(x)?E(x)K(3)\n"), "",
        &environment);
    EXPECT_EQ(environment.queries, (Texts{"1: 2 K 3", "end 0"}));
    EXPECT_FALSE(environment.notes[0].is_answered);
    EXPECT_EQ(grown.text, "A(2)B");
}

TEST(PlantQueries, InASuccessorSeeItsEnd) {
    NotedEnvironment environment;
    grow(lsystem(1, "A B", "homomorphism\nA --> F?E(0)\n"), "", &environment);
    EXPECT_EQ(environment.queries, (Texts{"1: 0 ", "end 0"}));
}

TEST(PlantAnswers, AreParametersOfTheNextStep) {
    NotedEnvironment environment;
    environment.answer = [](std::int64_t step) {
        const float light = static_cast<float>(step + 1) * 10;
        return std::vector<PlantAnswer>{{0, Values{light}}};
    };
    const Grown grown = grow(
        lsystem(
            3, "?E(0)A(0)", "E(x) < A(y) : * {printf(\"%g %g \",x,seen);} --> A(x)",
            "StartEach: {seen=Q;}"),
        "", &environment);
    EXPECT_EQ(grown.text, "?E(30)A(30)");
    EXPECT_EQ(grown.printed, "10 1 20 2 30 3 ");
    EXPECT_EQ(environment.passes, (std::vector<std::int64_t>{0, 1, 2}));
}

TEST(PlantAnswers, KeepWhatTheyLeaveEmpty) {
    NotedEnvironment environment;
    environment.answer = [](std::int64_t) {
        return std::vector<PlantAnswer>{
            {19, Values{1}}, {0, Values{std::nullopt, 5, 6, 7}}, {99, Values{8}}};
    };
    const Grown grown = grow(lsystem(1, "F?E(1,2,3)P?E(4)", "\n"), "", &environment);
    EXPECT_EQ(grown.text, "F?E(1,5,6)P?E(1)");
    EXPECT_EQ(
        grown.notices,
        Texts{"the environment answers 4 values to a query of 3 parameters; the others "
              "are dropped"});
}

TEST(PlantAnswers, MayComeInAnyOrder) {
    NotedEnvironment environment;
    environment.answer = [](std::int64_t) {
        return std::vector<PlantAnswer>{{8, Values{2}}, {0, Values{1}}};
    };
    EXPECT_EQ(grow(lsystem(1, "?E(0)?E(0)", "\n"), "", &environment).text, "?E(1)?E(2)");
}

TEST(PlantPasses, AreMadeBeforeEveryStep) {
    NotedEnvironment environment;
    grow(lsystem(2, "?E(0)", "\n"), "", &environment);
    EXPECT_EQ(environment.passes, (std::vector<std::int64_t>{0, 1}));
    environment.passes.clear();
    grow(lsystem(2, "?E(0)", "\n"), "environment display: before\n", &environment);
    EXPECT_EQ(environment.passes, (std::vector<std::int64_t>{0, 1, 2}));
    environment.passes.clear();
    grow(lsystem(2, "?E(0)", "\n"), "environment display: after\n", &environment);
    EXPECT_EQ(environment.passes, (std::vector<std::int64_t>{0, 1}));
}

TEST(PlantPasses, NeedAQueryInTheModel) {
    NotedEnvironment environment;
    grow(lsystem(2, "A?(1)$", "B --> C"), "", &environment);
    EXPECT_TRUE(environment.passes.empty());
    grow(lsystem(2, "A", "B < ? --> C"), "", &environment);
    EXPECT_EQ(environment.passes.size(), 2U);
    environment.passes.clear();
    grow(lsystem(1, "A", "B --> C\nhomomorphism\nB --> ?E(0)\n"), "", &environment);
    EXPECT_EQ(environment.passes.size(), 1U);
    environment.passes.clear();
    grow(lsystem(1, "A", "B --> %(2)"), "", &environment);
    EXPECT_EQ(environment.passes.size(), 1U);
}

TEST(PlantPasses, ComeBeforeTheBlocks) {
    NotedEnvironment environment;
    environment.answer = [](std::int64_t step) {
        return std::vector<PlantAnswer>{{0, Values{static_cast<float>(step + 5)}}};
    };
    const Grown grown = grow(
        lsystem(
            2, "?E(0)K",
            "E(x) : * {printf(\"%g:%g \",Q,x);} --> E(x)\nhomomorphism\n"
            "K : * {printf(\"h%g \",Q);} --> K\n",
            "StartEach: {printf(\"b%g \",Q);}\nEndEach: {printf(\"e%g \",Q);}"),
        "", &environment);
    EXPECT_EQ(grown.printed.find("h0 b1 1:5 e1 h1 b2 2:6 e2 h2 "), 0U) << grown.printed;
}

TEST(PlantPasses, FillPositions) {
    NotedEnvironment environment;
    EXPECT_EQ(
        grow(
            lsystem(1, "F?P(0,0)s(8,8)s(8,8,8)s(8)F?E(0)", "P(x,y) : y>0 --> P(y,0)"), "",
            &environment)
            .text,
        "F?P(0,1)s(0,1)s(0,1,0)s(8)F?E(0)");
    EXPECT_EQ(grow(lsystem(1, "F s(8,8)", "\n"), "", &environment).text, "Fs(8,8)");
}

TEST(PlantPasses, DrawTheModulesThatFollowQueries) {
    const View view;
    PlainGeometry geometry(view);
    NotedEnvironment environment;
    environment.drawing = &geometry;
    grow(
        lsystem(1, "F(5)?E(0)F(2)F(3)?E(0)L(4)@O(9)", "homomorphism\nL(s) --> ;(3)@O(s)\n"), "",
        &environment);
    EXPECT_EQ(
        geometry.text(),
        "model\ncolor 128\ncylinder 0.5 0 5 0 0 7 0\ncolor 3\nsphere 2 0 10 0\nend\n");
}

TEST(PlantPasses, AreMadeWithoutAnEnvironment) {
    EXPECT_EQ(grow(lsystem(2, "F?E(4)?P(9,9)", "P(x,y) --> P(x,y)")).text, "F?E(4)?P(0,1)");
}

TEST(PlantPasses, EndIfTheEnvironmentFails) {
    NotedEnvironment environment;
    environment.answer = [](std::int64_t step) -> std::vector<PlantAnswer> {
        if (step == 1) {
            throw InputError({{"environment", "it has ended", "", ""}});
        }
        return {};
    };
    const Grown grown = grow(lsystem(5, "?E(0)", "\n"), "", &environment);
    EXPECT_EQ(grown.faults, Texts{"environment: it has ended"});
}

}  // namespace
}  // namespace quasimc::test
