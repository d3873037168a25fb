// The command line itself: help, completion, colours, and what is said of wrong usage.

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "picture/image.h"
#include "program.h"
#include "quasimc/quasimc.h"

namespace quasimc::test {
namespace {

using CommandLine = ProgramTest;

std::size_t longest_line(const std::string& text) {
    std::size_t longest = 0;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        longest = std::max(longest, line.size());
    }
    return longest;
}

class Completion : public ProgramTest {
  protected:
    /// The words that bash offers for the last word of a command line.
    [[nodiscard]] std::string offered(const std::string& words) const {
        const Outcome outcome = shell(
            "source <(\"$quasimc\" completion bash); COMP_WORDS=(" + words +
            "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _quasimc; echo \"${COMPREPLY[*]}\"");
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return outcome.out.substr(0, outcome.out.find('\n'));
    }
};

TEST_F(CommandLine, HelpFitsTheWidthOfTheTerminal) {
    for (const char* command :
         {"", "run", "merge", "check", "info", "convert", "list", "show", "view", "report", "sky",
          "completion"}) {
        for (const std::size_t width : {60, 80, 132}) {
            const Outcome outcome =
                shell("COLUMNS=" + std::to_string(width) + " \"$quasimc\" " + command + " --help");
            EXPECT_EQ(outcome.status, 0);
            EXPECT_LE(longest_line(outcome.out), width) << command << outcome.out;
        }
    }
    EXPECT_LE(longest_line(run({"run", "--help"}).out), 80U) << "without a terminal";
}

TEST_F(CommandLine, HelpSaysInWordsWhatFlagsTake) {
    const std::string help = shell("COLUMNS=300 \"$quasimc\" show --help").out;
    EXPECT_NE(help.find("--fov X"), std::string::npos) << help;
    EXPECT_NE(help.find("(number, 0 to 150; default 0)"), std::string::npos) << help;
    EXPECT_NE(help.find("(one of viridis, "), std::string::npos) << help;
    EXPECT_EQ(help.find("FLOAT"), std::string::npos) << help;
    const std::string of_run = shell("COLUMNS=300 \"$quasimc\" run --help").out;
    for (const char* text :
         {"\nOutput:\n", "\nSampling (overrides the run file):\n",
          "\nExpert (overrides the run file):\n", "(whole number >= 1; default 65536)",
          "; number >= 0; default 0)", "default auto)", "  -h,--help"}) {
        EXPECT_NE(of_run.find(text), std::string::npos) << text << of_run;
    }
    EXPECT_EQ(of_run.find("\n\n\n"), std::string::npos);
}

TEST_F(CommandLine, HelpAndVersionAreCommandsToo) {
    EXPECT_EQ(run({"help"}).out, run({"--help"}).out);
    EXPECT_EQ(run({"help", "show"}).out, run({"show", "--help"}).out);
    EXPECT_EQ(run({"help", "show"}).status, 0);
    for (const char* word : {"version", "--version", "-V"}) {
        EXPECT_EQ(run({word}).out, "quasimc " + std::string(version()) + "\n") << word;
    }
    const Outcome wrong = run({"help", "shwo"});
    EXPECT_EQ(wrong.status, 2);
    EXPECT_NE(wrong.err.find("unknown command 'shwo'; did you mean 'show'?"), std::string::npos);
}

TEST_F(CommandLine, MisspeltValuesAreNamedWithTheNearestAndAllChoices) {
    const std::vector<std::pair<std::vector<std::string>, std::string>> table{
        {{"run", "run.toml", "--method", "raybundles"},
         "error: --method: 'raybundles' is not one of light_tracing, first_hits, from_organs, "
         "ray_bundles, auto; did you mean 'ray_bundles'?\n"},
        {{"run", "run.toml", "--paths", "0"}, "error: --paths: 0 is out of range (1 to 2^30)\n"},
        {{"run", "run.toml", "--paths", "many"},
         "error: --paths: 'many' is not a whole number (1 to 2^30)\n"},
        {{"show", "run.toml", "--colormap", "virids"},
         "error: --colormap: 'virids' is not one of viridis, cividis, magma; did you mean "
         "'viridis'?\n"},
        {{"show", "run.toml", "--fov", "200"}, "error: --fov: 200 is out of range (0 to 150)\n"},
        {{"show", "run.toml", "--fov", "wide"}, "error: --fov: 'wide' is not a number\n"},
        {{"list", "optins"}, "did you mean 'options'?\n"},
        {{"run.toml"},
         "error: unknown command 'run.toml'; did you mean 'quasimc run run.toml'?\n"}};
    for (const auto& [arguments, message] : table) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 2) << message;
        EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
    }
    folder_.write("run.toml", replaced(good_run_file(), "paths = 256", "method = \"ray_bundle\""));
    const Outcome of_file = run({"run", "run.toml"});
    EXPECT_EQ(of_file.status, 1);
    EXPECT_NE(
        of_file.err.find("run.toml:4: [run]: method: 'ray_bundle' is not one of light_tracing, "),
        std::string::npos)
        << of_file.err;
}

/// The file is wrong too: another command line does not help.
TEST_F(CommandLine, FaultsOfAFileBesideThoseOfAFlagAreStatusOne) {
    folder_.write("run.toml", replaced(good_run_file(), "replicates = 3", "replicates = 0"));
    EXPECT_EQ(run({"run", "run.toml", "--paths", "0"}).status, 1);
}

TEST_F(CommandLine, OffersCommandsFlagsAndValuesToBash) {
    EXPECT_EQ(shell("\"$quasimc\" completion bash | bash -n").status, 0);
    EXPECT_EQ(run({"completion", "csh"}).status, 2);
    EXPECT_NE(run({"completion", "zsh"}).out.find("bashcompinit"), std::string::npos);
    const std::string fish = run({"completion", "fish"}).out;
    EXPECT_NE(
        fish.find("complete -c quasimc -n __fish_use_subcommand -f -a run -d 'compute the "),
        std::string::npos)
        << fish;
    EXPECT_NE(fish.find(" -l method -r -f -a 'light_tracing "), std::string::npos) << fish;
}

TEST_F(Completion, KnowsCommandsFlagsAndValues) {
    EXPECT_EQ(offered("quasimc ru"), "run");
    EXPECT_EQ(
        offered("quasimc run --target-"),
        "--target-error --target-fraction --target-quantity --target-bands");
    EXPECT_EQ(offered("quasimc run a.toml --method fi"), "first_hits");
    EXPECT_EQ(offered("quasimc show a.json --colormap m"), "magma");
    EXPECT_EQ(offered("quasimc list quan"), "quantities");
    EXPECT_EQ(offered("quasimc run a.toml --paths 6"), "");
    EXPECT_EQ(offered("quasimc show a"), "") << "bash offers files then";
}

TEST_F(CommandLine, ColoursItsErrorsOnATerminalOnly) {
    if (shell("command -v script").status != 0) {
        GTEST_SKIP() << "there is no program to make a terminal";
    }
    const std::string command = "script -qec \"$quasimc run none.toml\" /dev/null";
    const std::string shown = shell("TERM=xterm " + command).out;
    EXPECT_NE(shown.find("\x1b[1;31merror:\x1b[0m none.toml"), std::string::npos) << shown;
    EXPECT_EQ(shell("TERM=xterm NO_COLOR=1 " + command).out.find("\x1b[1;"), std::string::npos);
    EXPECT_EQ(run({"run", "none.toml"}).err.find('\x1b'), std::string::npos);
}

TEST_F(CommandLine, DrawsGeometryFiles) {
    if (!has_png()) {
        GTEST_SKIP() << "built without pictures";
    }
    const Outcome outcome = run({"show", "leaves.tri", "--size", "100x80"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "written leaves.png\n");
    EXPECT_TRUE(folder_.read("leaves.png").starts_with("\x89PNG"));
    ASSERT_EQ(run({"convert", "leaves.tri", "plant.obj"}).status, 0);
    EXPECT_EQ(run({"show", "plant.obj", "-o", "plant.png", "--camera", "top"}).status, 0);
}

TEST_F(CommandLine, SaysWhatToDoWithAResultAndWithGeometry) {
    ASSERT_EQ(run({"run", "run.toml"}).status, 0);
    const Outcome result = run({"run", "out.json"});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(
        result.err,
        "error: out.json: is a result, not a run file; show it: quasimc view out.json; or repeat "
        "its run: quasimc run --repeat out.json\n");
    const Outcome geometry = run({"run", "leaves.tri"});
    EXPECT_EQ(geometry.status, 1);
    EXPECT_EQ(
        geometry.err,
        "error: leaves.tri: is geometry, not a run file; name it in a run file, under "
        "[[geometry]]: file = \"leaves.tri\"; or draw it: quasimc show leaves.tri\n");
}

}  // namespace
}  // namespace quasimc::test
