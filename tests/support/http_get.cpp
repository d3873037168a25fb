#include "support/http_get.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <iterator>
#include <string_view>
#include <thread>

#include <unistd.h>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

namespace quasimc::test {
namespace {

constexpr std::string_view kStart = "http://127.0.0.1:";

/// All that comes from a connection until its other end closes it.
std::string hear(int socket) {
    std::string text;
    std::array<char, 4096> bytes{};
    for (ssize_t got = 1; got > 0;) {
        got = recv(socket, bytes.data(), bytes.size(), 0);
        text.append(bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    }
    return text;
}

}  // namespace

std::string http_get(const std::string& address) {
    const std::size_t slash = address.find('/', kStart.size());
    const std::string host = address.substr(std::string_view("http://").size(), slash - 7);
    const int connection = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const timeval limit{20, 0};
    setsockopt(connection, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
    sockaddr_in there{};
    there.sin_family = AF_INET;
    there.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    there.sin_port = htons(static_cast<std::uint16_t>(std::stoi(address.substr(kStart.size()))));
    std::string answer;
    if (connect(connection, reinterpret_cast<const sockaddr*>(&there), sizeof there) == 0) {
        const std::string request =
            "GET " + address.substr(slash) + " HTTP/1.1\r\nHost: " + host + "\r\n\r\n";
        static_cast<void>(send(connection, request.data(), request.size(), MSG_NOSIGNAL));
        answer = hear(connection);
    }
    close(connection);
    const std::size_t body = answer.find("\r\n\r\n");
    const bool is_good = answer.starts_with("HTTP/1.1 200 ") && body != std::string::npos;
    return is_good ? answer.substr(body + 4) : "";
}

std::string address_in(const std::string& text) {
    const std::size_t first = text.rfind(kStart);
    const std::size_t end = first == std::string::npos ? first : text.find('\n', first);
    return end == std::string::npos ? "" : text.substr(first, end - first);
}

std::string await_address(const std::string& file) {
    constexpr int kTries = 600;
    std::string address;
    for (int i = 0; i < kTries && address.empty(); ++i) {
        std::ifstream stream(file);
        address = address_in({std::istreambuf_iterator<char>(stream), {}});
        if (address.empty()) {
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
    }
    return address;
}

}  // namespace quasimc::test
