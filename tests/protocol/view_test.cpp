// Steps of a growing plant in the browser. Tests of the page itself: tests/web.

#include <cstdlib>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "captures.h"
#include "growth.h"
#include "session_fixture.h"
#include "support/http_get.h"
#include "window/page.h"

namespace quasimc::test {
namespace {

constexpr int kSteps = 4;

class View : public SessionTest {
  protected:
    void SetUp() override {
        SessionTest::SetUp();
        if (embedded_page().script.empty()) {
            GTEST_SKIP() << "built without the viewer";
        }
    }

    void start(const std::string& specification, const std::vector<std::string>& words = {}) {
        folder_.write("comm.e", comm_text(Transport::pipes));
        folder_.write("light.qmc", "number of rays: 1024\nverbose: 0\n" + specification);
        master_ = make_master(Transport::pipes, Client::cpfg, folder_.path());
        std::vector<std::string> all = words;
        all.emplace_back("light.qmc");
        master_->start(all);
        master_->await_sign();
    }
    /// All answers of a growing plant. @param on_step  called after every step
    template <typename OnStep>
    std::string grow(const OnStep& on_step) {
        std::string answers;
        for (int step = 1; step <= kSteps; ++step) {
            master_->send(growing_leaves(30 * step, step));
            answers += master_->read_all_chunks();
            on_step(step);
        }
        return answers;
    }
    Ending end() {
        master_->send(kExit);
        EXPECT_EQ(master_->read(), "Control: 5\n");
        master_->await_last_sign();
        return master_->process().wait().value_or(Ending{true, 0});
    }
    std::string address() { return await_address((folder_.path() / "err").string()); }

    std::unique_ptr<Master> master_;
};

TEST_F(View, ChangesNoAnswer) {
    start("");
    const std::string alone = grow([](int) {});
    EXPECT_EQ(end(), (Ending{false, 0}));
    EXPECT_EQ(address_in(folder_.read("err")), "") << "not requested";
    start("view: yes\n");
    EXPECT_EQ(grow([](int) {}), alone) << "no page is open";
    EXPECT_EQ(end(), (Ending{false, 0}));
    start("", {"--view"});
    const std::string page = address();
    ASSERT_NE(page, "");
    const std::string watched = grow([&](int step) {
        const std::string number = std::to_string(step);
        if (step == 3) {
            return;  // the page disconnects and comes back
        }
        EXPECT_NE(http_get(page + "live").find("\"step " + number + "\""), std::string::npos);
        EXPECT_NE(http_get(page + "scene-" + number).find("\"unit\":\"\""), std::string::npos)
            << "a plant has no unit of length";
        EXPECT_EQ(http_get(page + "values-" + number + "-1-0").size(), 30U * step * 16);
    });
    EXPECT_EQ(watched, alone);
    EXPECT_NE(http_get(page + "values-1-1-0"), "") << "earlier steps are kept";
    EXPECT_EQ(end(), (Ending{false, 0}));
    EXPECT_EQ(http_get(page + "live"), "") << "the program is gone";
}

TEST_F(View, IsOfNoAccountWhereNothingIsLit) {
    start("light source: 0 -1 0 1\nsource spectrum: 660 0\nview: yes\n");
    const std::string page = address();
    ASSERT_NE(page, "");
    static_cast<void>(grow([](int) {}));
    const std::string news = http_get(page + "live");
    EXPECT_NE(news.find("nothing is lit"), std::string::npos) << news;
    EXPECT_NE(news.find("\"frames\":[]"), std::string::npos) << news;
    EXPECT_EQ(end(), (Ending{false, 0}));
}

TEST_F(View, RefusesAPortThatIsTaken) {
    start("view: yes\n");
    const std::string page = address();
    ASSERT_NE(page, "");
    const std::string port = page.substr(17, page.find('/', 17) - 17);
    folder_.write("other.qmc", "view: yes " + port + "\n");
    const std::string command = "cd " + folder_.path().string() +
                                " && printf 'Control: 8 0\\n' | " QUASIMC_ENVIRONMENT
                                " -e comm.e other.qmc > other.out 2> other.err";
    EXPECT_NE(std::system(command.c_str()), 0);
    EXPECT_NE(folder_.read("other.err").find(port + " is not available"), std::string::npos)
        << folder_.read("other.err");
    EXPECT_EQ(end(), (Ending{false, 0}));
}

}  // namespace
}  // namespace quasimc::test
