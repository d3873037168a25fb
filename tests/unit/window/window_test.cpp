// The page in the browser: what its server refuses, and what it bears.

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include <unistd.h>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include "quasimc/error.h"
#include "text/base64.h"
#include "window/page.h"
#include "window/window_server.h"
#include "window/window_site.h"

namespace quasimc::test {
namespace {

constexpr const char* kToken = "0123456789abcdef0123456789abcdef";

WindowData small_data() {
    return {
        R"({"title":"</script><script>"})", std::string(36, 'p'), {"first", "second"}, {{0}, {-1}}};
}

ViewerRoutes small_site() {
    ViewerRoutes site(files_of(small_data()), kToken);
    site.set_port(8080);
    return site;
}

/// The status of a request to the site.
int status_of_request(const std::string& text) {
    return small_site().answer(parse_request(text)).status;
}

std::string get_request(
    const std::string& target,
    const std::string& more = "",
    const std::string& host = "127.0.0.1:8080") {
    return "GET " + target + " HTTP/1.1\r\nHost: " + host + "\r\n" + more + "\r\n";
}

const std::string kRoot = std::string("/") + kToken + "/";

TEST(ViewerRoutes, GivesThePageAndItsData) {
    for (const char* name : {"", "viewer.js", "viewer.css", "data", "colors", "shape"}) {
        EXPECT_EQ(status_of_request(get_request(kRoot + name)), 200) << name;
    }
    const ViewerRoutes site = small_site();
    const std::string request = get_request(kRoot + "values-1");
    EXPECT_EQ(site.answer(parse_request(request)).body, "second");
    EXPECT_EQ(site.address(), "http://127.0.0.1:8080" + kRoot);
    EXPECT_EQ(status_of_request(get_request(kRoot, "", "localhost:8080")), 200);
    EXPECT_EQ(status_of_request(get_request(kRoot, "Origin: http://127.0.0.1:8080\r\n")), 200);
    EXPECT_EQ(status_of_request(get_request(kRoot, "Sec-Fetch-Site: same-origin\r\n")), 200);
}

TEST(ViewerRoutes, GivesTheCourseOfAnOrgan) {
    // Two organs at three times; the second time has no values.
    const auto numbers = [](std::vector<float> all) {
        return std::string(reinterpret_cast<const char*>(all.data()), all.size() * sizeof(float));
    };
    const WindowData data{
        "{}",
        "",
        {numbers({1, 2, 3, 4, 5, 6, 7, 8}), numbers({11, 12, 13, 14, 15, 16, 17, 18})},
        {{0}, {-1}, {1}}};
    EXPECT_EQ(data.course(0, 1), numbers({2, 4, 6, 8, 0, 0, 0, 0, 12, 14, 16, 18}));
    ViewerRoutes site(files_of(data), kToken);
    site.set_port(8080);
    const auto body = [&site](const std::string& name) {
        const std::string request = get_request(kRoot + name);
        const HttpAnswer answer = site.answer(parse_request(request));
        return std::pair(answer.status, std::string(answer.body));
    };
    EXPECT_EQ(body("course-0-0"), std::pair(200, data.course(0, 0)));
    for (const char* name : {"course-0-2", "course-1-0", "course-0", "course-0-0-0"}) {
        EXPECT_EQ(body(name).first, 404) << name;
    }
}

TEST(ViewerRoutes, RefusesOtherTokens) {
    std::string other = kRoot;
    other[5] = 'x';
    for (const std::string& target :
         {std::string("/"), std::string("/data"), std::string("//data"), other, other + "data",
          kRoot.substr(0, kRoot.size() - 1), "/" + kRoot, kRoot.substr(0, 9) + "/",
          "http://127.0.0.1:8080" + kRoot}) {
        EXPECT_EQ(status_of_request(get_request(target)), 403) << target;
    }
}

TEST(ViewerRoutes, RefusesOtherHosts) {
    // A foreign name that resolves to this machine (DNS rebinding).
    for (const char* host :
         {"evil.example:8080", "evil.example", "127.0.0.1", "127.0.0.1:8081", "127.0.0.1:80800",
          "localhost", "", "127.0.0.1:8080.evil.example", "[::1]:8080"}) {
        EXPECT_EQ(status_of_request(get_request(kRoot, "", host)), 421) << host;
    }
    EXPECT_EQ(status_of_request("GET " + kRoot + " HTTP/1.1\r\n\r\n"), 421);
}

TEST(ViewerRoutes, RefusesOtherOrigins) {
    for (const char* header :
         {"Origin: http://evil.example\r\n", "Origin: null\r\n",
          "Origin: https://127.0.0.1:8080\r\n", "Origin: http://127.0.0.1:8081\r\n", "origin:\r\n",
          "Sec-Fetch-Site: cross-site\r\n", "sec-fetch-site: same-site\r\n"}) {
        EXPECT_EQ(status_of_request(get_request(kRoot + "data", header)), 403) << header;
    }
}

TEST(ViewerRoutes, RefusesOtherPaths) {
    for (const char* name :
         {"..", "../", "../../etc/passwd", "%2e%2e/data", "data/", "data?x", "index.html",
          "values-", "values-2", "values--1", "values-1x", "values-99999999999999999999", "./data",
          "DATA"}) {
        EXPECT_EQ(status_of_request(get_request(kRoot + name)), 404) << name;
    }
}

TEST(ViewerRoutes, RefusesOtherMethodsAndBodies) {
    for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS", "CONNECT", "get"}) {
        EXPECT_EQ(
            status_of_request(
                std::string(method) + " " + kRoot + " HTTP/1.1\r\nHost: 127.0.0.1:8080\r\n\r\n"),
            405)
            << method;
    }
    EXPECT_EQ(status_of_request(get_request(kRoot, "Content-Length: 5\r\n")), 413);
    EXPECT_EQ(status_of_request(get_request(kRoot, "Transfer-Encoding: chunked\r\n")), 413);
}

TEST(ViewerRoutes, RefusesWhatIsNoRequest) {
    for (const std::string& text :
         {std::string(), std::string("\r\n\r\n"), std::string("GET\r\n\r\n"),
          std::string("GET /\r\n\r\n"), "GET " + kRoot + " HTTP/2\r\nHost: 127.0.0.1:8080\r\n\r\n",
          "GET " + kRoot + " x HTTP/1.1\r\nHost: 127.0.0.1:8080\r\n\r\n",
          "GET " + kRoot + " HTTP/1.1\r\nHost: 127.0.0.1:8080\r\n",
          get_request(kRoot, "Host: evil.example\r\n"), get_request(kRoot, "no colon\r\n"),
          get_request(kRoot, ": no name\r\n"), get_request(kRoot, "Content-Length : 5\r\n"),
          get_request(kRoot, " folded: 1\r\n"), std::string(64, '\0') + "\r\n\r\n"}) {
        EXPECT_EQ(status_of_request(text), 400) << text;
    }
}

TEST(ViewerRoutes, RefusesTwoHosts) {
    const std::string host = "127.0.0.1:8080";
    for (const std::string& second :
         {"Host: " + host, std::string("Host: evil.example"), std::string("host:"),
          std::string("Host: "), "hOST:" + host}) {
        const std::string first = "Host: " + host;
        for (const std::string& lines :
             {first + "\r\n" + second, second + "\r\n" + first, first + "\r\nAccept: a\n" + second,
              first + "\r\nAccept: a\r" + second, first + "\r\n " + second,
              first + "\n" + second}) {
            EXPECT_EQ(status_of_request("GET " + kRoot + " HTTP/1.1\r\n" + lines + "\r\n\r\n"), 400)
                << lines;
        }
    }
    EXPECT_EQ(status_of_request(get_request(kRoot, "Accept: a,\tb\r\n")), 200);
}

TEST(ViewerRoutes, TellsBrowsersToKeepItToItself) {
    const std::string request = get_request(kRoot);
    const std::string head = small_site().answer(parse_request(request)).head();
    for (const char* header :
         {"Content-Security-Policy: default-src 'none'; script-src 'self';",
          "frame-ancestors 'none'", "Cache-Control: no-store\r\n",
          "X-Content-Type-Options: nosniff\r\n", "Referrer-Policy: no-referrer\r\n",
          "Cross-Origin-Resource-Policy: same-origin\r\n"}) {
        EXPECT_NE(head.find(header), std::string::npos) << head;
    }
    EXPECT_EQ(head.find("Access-Control"), std::string::npos);
}

TEST(ViewerRoutes, DrawsAnotherTokenEachTime) {
    const std::string token = random_token();
    EXPECT_EQ(token.size(), 32U);
    EXPECT_EQ(token.find_first_not_of("0123456789abcdef"), std::string::npos);
    EXPECT_NE(token, random_token());
}

/// A connection to a server, blocking, with a limit on how long it waits.
class Client {
  public:
    explicit Client(int port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
        const timeval limit{20, 0};
        setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        address.sin_port = htons(static_cast<std::uint16_t>(port));
        is_connected_ =
            connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
    }
    Client(Client&& other) = delete;
    ~Client() { close(socket_); }

    [[nodiscard]] bool is_connected() const { return is_connected_; }
    void say(std::string_view text) const {
        while (!text.empty()) {
            const ssize_t sent = send(socket_, text.data(), text.size(), MSG_NOSIGNAL);
            if (sent <= 0) {
                return;
            }
            text.remove_prefix(static_cast<std::size_t>(sent));
        }
    }
    /// All that comes until the other side ends.
    [[nodiscard]] std::string hear() const {
        std::string text;
        std::array<char, 4096> bytes{};
        for (ssize_t got = 1; got > 0;) {
            got = recv(socket_, bytes.data(), bytes.size(), 0);
            text.append(bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
        }
        return text;
    }

  private:
    int socket_;
    bool is_connected_ = false;
};

/// A server in a thread of its own, with limits that a test need not wait for.
class WindowServerTest : public testing::Test {
  protected:
    WindowServerTest()
        : server_(
              ViewerRoutes(files_of(data()), kToken),
              0,
              {.connections = 16, .request_bytes = 2048, .request_seconds = 1, .idle_seconds = 1}) {
    }
    static WindowData data() {
        WindowData made = small_data();
        made.shape.assign(std::size_t{20} << 20U, 'p');
        return made;
    }
    [[nodiscard]] int port() const {
        const std::string address = server_.address();
        return std::stoi(address.substr(std::strlen("http://127.0.0.1:")));
    }
    [[nodiscard]] std::string request(const std::string& name, const std::string& more = "") const {
        return get_request(kRoot + name, more, "127.0.0.1:" + std::to_string(port()));
    }
    /// The whole answer to a request by a new connection.
    [[nodiscard]] std::string ask(const std::string& text) const {
        const Client client(port());
        client.say(text);
        return client.hear();
    }

  private:
    HttpServer server_;
};

TEST_F(WindowServerTest, AnswersAndEnds) {
    const std::string answer = ask(request("values-0"));
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 200 OK\r\n")) << answer;
    EXPECT_TRUE(answer.ends_with("\r\n\r\nfirst")) << answer;
    const std::string large = ask(request("shape"));
    EXPECT_GT(large.size(), std::size_t{20} << 20U);
    std::string head = request("data");
    head.replace(0, 3, "HEAD");
    EXPECT_TRUE(ask(head).ends_with("\r\n\r\n"));
    EXPECT_TRUE(ask("GET / HTTP/1.1\r\nHost: x\r\n\r\n").starts_with("HTTP/1.1 421 "));
}

TEST_F(WindowServerTest, RefusesHugeRequests) {
    const std::string answer = ask(request("", "X: " + std::string(1U << 20U, 'x') + "\r\n"));
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 431 ")) << answer.substr(0, 80);
    EXPECT_TRUE(ask(request("values-0")).ends_with("first"));
}

TEST_F(WindowServerTest, EndsConnectionsThatAreSlowToAsk) {
    const Client slow(port());
    std::atomic<bool> is_over{false};
    std::thread dribbling([&] {
        while (!is_over) {
            slow.say("G");  // each byte in time, the whole never
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
    });
    EXPECT_EQ(slow.hear(), "");
    is_over = true;
    dribbling.join();
}

TEST_F(WindowServerTest, AnswersWhileAHundredConnectionsKeepSilent) {
    std::vector<std::unique_ptr<Client>> silent;
    for (int i = 0; i < 100; ++i) {
        silent.push_back(std::make_unique<Client>(port()));
    }
    EXPECT_TRUE(ask(request("values-0")).ends_with("first"));
    // And while some take nothing of a large answer.
    for (int i = 0; i < 8; ++i) {
        silent.push_back(std::make_unique<Client>(port()));
        silent.back()->say(request("shape"));
    }
    EXPECT_TRUE(ask(request("values-1")).ends_with("second"));
}

TEST_F(WindowServerTest, AnswersInAFloodOfRequestsThatItRefuses) {
    std::atomic<bool> is_over{false};
    std::vector<std::thread> floods;
    for (int i = 0; i < 3; ++i) {
        floods.emplace_back([&] {
            std::deque<Client> open;  // none is closed before its answer, most are long after
            while (!is_over) {
                open.emplace_back(port());
                open.back().say("GET / HTTP/1.1\r\n\r\n");
                if (open.size() > 30) {
                    open.pop_front();
                }
            }
        });
    }
    std::vector<std::string> others;  // than the answer
    for (int i = 0; i < 200; ++i) {
        const std::string answer = ask(request("values-0"));
        if (!answer.ends_with("first")) {
            others.push_back(answer);
        }
    }
    is_over = true;
    for (std::thread& flood : floods) {
        flood.join();
    }
    EXPECT_EQ(others, std::vector<std::string>());
}

TEST_F(WindowServerTest, RefusesAPortThatIsTaken) {
    EXPECT_THROW(HttpServer(small_site(), port()), InputError);
}

TEST(Page, Base64IsThatOfTheStandard) {
    // RFC 4648, section 10.
    EXPECT_EQ(encode_base64(""), "");
    EXPECT_EQ(encode_base64("f"), "Zg==");
    EXPECT_EQ(encode_base64("fo"), "Zm8=");
    EXPECT_EQ(encode_base64("foo"), "Zm9v");
    EXPECT_EQ(encode_base64("foob"), "Zm9vYg==");
    EXPECT_EQ(encode_base64("foobar"), "Zm9vYmFy");
    EXPECT_EQ(encode_base64("\xff\xfe\xfd"), "//79");
}

TEST(Page, ReportsHoldNoMarkupOfTheData) {
    if (embedded_page().script.empty()) {
        GTEST_SKIP() << "built without the viewer";
    }
    std::string html;
    write_report({{small_data()}}, [&html](std::string_view text) { html += text; });
    EXPECT_NE(html.find(R"({"title":"\u003c/script>\u003cscript>"})"), std::string::npos);
    EXPECT_NE(html.find("default-src 'none'; script-src 'sha256-"), std::string::npos);
    EXPECT_EQ(html.find("<!--"), html.npos) << "a mark is left";
    EXPECT_NE(html.find("<meta name=\"viewport\""), html.npos)
        << "phones would show it as on a desk";
    EXPECT_NE(html.find("id=\"values-1\">c2Vjb25k</script>"), std::string::npos);
}

TEST(Page, ReportsOfSweepsHoldEachShapeOnce) {
    if (embedded_page().script.empty()) {
        GTEST_SKIP() << "built without the viewer";
    }
    std::vector<WindowData> points(4, small_data());
    points[2].shape.assign(36, 'q');
    points[3].shape = points[2].shape;
    std::string html;
    write_report(points, [&html](std::string_view text) { html += text; });
    const auto has = [&html](const std::string& text) { return html.find(text) != html.npos; };
    EXPECT_TRUE(has("id=\"shape\">cHBw"));
    EXPECT_TRUE(has("id=\"point-1-shape\" data-same=\"shape\"></script>"));
    EXPECT_TRUE(has("id=\"point-2-shape\">cXFx"));
    EXPECT_TRUE(has("id=\"point-3-shape\" data-same=\"point-2-shape\"></script>"));
    for (const char* id : {"data", "point-1-data", "point-3-values-1"}) {
        EXPECT_TRUE(has("id=\"" + std::string(id) + "\">")) << id;
    }
}

}  // namespace
}  // namespace quasimc::test
