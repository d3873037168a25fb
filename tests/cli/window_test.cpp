// The page in the browser from the command line. What it shows: tests/web. What its server refuses:
// tests/unit/window/window_test.cpp.

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "program.h"
#include "support/http_get.h"
#include "window/page.h"

namespace quasimc::test {
namespace {

class WindowCommand : public ProgramTest {
  protected:
    void SetUp() override {
        ProgramTest::SetUp();
        ASSERT_EQ(run({"run", "run.toml"}).status, 0);
    }
    void expect_fault(const std::vector<std::string>& arguments, const std::string& text) const {
        const Outcome outcome = run(arguments);
        const bool names_a_flag = outcome.err.starts_with("error: -");
        EXPECT_EQ(outcome.status, names_a_flag ? 2 : 1) << outcome.err;
        EXPECT_NE(outcome.err.find(text), std::string::npos) << outcome.err;
    }
    static bool has_page() { return !embedded_page().script.empty(); }
};

TEST_F(WindowCommand, SaysThatThereIsNoPage) {
    if (has_page()) {
        GTEST_SKIP() << "built with its page";
    }
    expect_fault({"report", "out.json", "-o", "p.html"}, "built without the viewer");
    expect_fault({"view", "out.json"}, "built without the viewer");
}

TEST_F(WindowCommand, WritesReports) {
    if (!has_page()) {
        GTEST_SKIP() << "built without the viewer";
    }
    EXPECT_EQ(run({"report", "out.json", "-o", "p.html"}).status, 0);
    const std::string html = folder_.read("p.html");
    EXPECT_TRUE(html.starts_with("<!doctype html>"));
    EXPECT_TRUE(html.ends_with("</html>\n"));
    EXPECT_EQ(html, run({"report", "out.json", "-o", "-"}).out) << "the same each time";
    expect_fault({"report", "out.json", "-o", "leaves.tri"}, "leaves.tri");
    const std::string result = folder_.read("out.json");
    expect_fault({"report", "out.json", "-o", "./out.json"}, "is an input of this run");
    EXPECT_EQ(folder_.read("out.json"), result);
    expect_fault({"report", "run.toml", "-o", "q.html"}, "run.toml: is not a result");
    expect_fault(
        {"report", "out.json", "-o", "q.html", "--sweep-point", "2"},
        "--sweep-point: 2 is out of range (1 to 1)");
    folder_.write("cut.json", folder_.read("out.json").substr(0, 500));
    expect_fault({"report", "cut.json", "-o", "q.html"}, "cut.json");
    EXPECT_EQ(run({"report", "out.json"}).status, 2);
    folder_.write("leaves.tri", "");
    expect_fault({"report", "out.json", "-o", "q.html"}, "leaves.tri");
}

TEST_F(WindowCommand, WritesDifferencesOfResults) {
    if (!has_page()) {
        GTEST_SKIP() << "built without the viewer";
    }
    const auto report = [](const std::string& minus) {
        return std::vector<std::string>{"report", "out.json", "-o", "p.html", "--minus", minus};
    };
    EXPECT_EQ(run(report("out.json")).status, 0);
    EXPECT_NE(folder_.read("p.html").find("\"minus\""), std::string::npos);
    expect_fault(report("run.toml"), "run.toml: is not a result");
    expect_fault(report("none.json"), "none.json");
    std::string other = folder_.read("run.toml");
    const std::string file = "file = \"leaves.tri\"";
    ASSERT_NE(other.find(file), std::string::npos);
    other.replace(other.find(file), file.size(), file + "\nfirst_id = 900");
    folder_.write("other.toml", other);
    ASSERT_EQ(run({"run", "other.toml", "--json", "other.json"}).status, 0);
    EXPECT_EQ(run(report("other.json")).status, 0);
    const std::string html = folder_.read("p.html");
    EXPECT_NE(html.find("\"only_first\":2,\"only_other\":2"), std::string::npos);
    folder_.write(
        "photons.toml", "irradiance_unit = \"umol m-2 s-1\"\n" + folder_.read("run.toml"));
    ASSERT_EQ(run({"run", "photons.toml", "--json", "photons.json"}).status, 0);
    expect_fault(report("photons.json"), "is in umol m-2 s-1 here, but in W m-2");
}

TEST_F(WindowCommand, ServesUntilItIsInterrupted) {
    if (!has_page()) {
        GTEST_SKIP() << "built without the viewer";
    }
    // A job of an interactive shell: others ignore SIGINT.
    const Outcome outcome = shell(
        "set -m; \"$quasimc\" view out.json >address & "
        "for i in {1..200}; do [ -s address ] && break; sleep 0.05; done; "
        "kill -INT $!; wait $!");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const std::string address = folder_.read("address");
    EXPECT_TRUE(address.starts_with("http://127.0.0.1:")) << address;
    EXPECT_EQ(address.find('\n'), address.size() - 1) << "printed once";
    EXPECT_EQ(run({"view", "out.json", "--port", "65536"}).status, 2);
    expect_fault({"view", "run.toml"}, "run.toml: is not a result");
}

TEST_F(WindowCommand, FollowsARunAndStaysUntilItIsInterrupted) {
    if (!has_page()) {
        GTEST_SKIP() << "built without the viewer";
    }
    EXPECT_EQ(run({"run", "run.toml", "--csv", "alone.csv"}).status, 0);
    const Outcome outcome = shell(
        "set -m; \"$quasimc\" run run.toml --csv seen.csv --view >told 2>err & "
        "for i in {1..400}; do grep -q stays err && break; sleep 0.05; done; "
        "cp seen.csv there_already.csv; kill -INT $!; wait $!");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(address_in(folder_.read("err")), "") << folder_.read("err");
    EXPECT_EQ(folder_.read("there_already.csv"), folder_.read("alone.csv")) << "to the last bit";
    EXPECT_EQ(folder_.read("told").find("http:"), std::string::npos) << "stdout is for the summary";
    EXPECT_EQ(run({"run", "run.toml", "--view", "--part", "1/2"}).status, 2);
}

TEST_F(WindowCommand, OfARunThatIsInterruptedEndsInOrder) {
    if (!has_page()) {
        GTEST_SKIP() << "built without the viewer";
    }
    const Outcome outcome = shell(
        "set -m; \"$quasimc\" run run.toml --csv seen.csv --view --checkpoint c "
        "--checkpoint-interval 0 "
        "--method light_tracing --paths 1073741824 >told 2>err & "
        "until [ -e c ] || ! kill -0 $!; do sleep 0.01; done; kill -INT $!; wait $!");
    EXPECT_EQ(outcome.status, 130) << outcome.err;
    EXPECT_NE(folder_.read("err").find("stopping;"), std::string::npos) << folder_.read("err");
    EXPECT_TRUE(std::filesystem::exists(folder_.path() / "c"));
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "c.lock"));
}

}  // namespace
}  // namespace quasimc::test
