// TCP to the plant simulator, which listens on two ports: the first for answers, the second for
// queries.

#include <cerrno>
#include <chrono>
#include <memory>
#include <system_error>
#include <thread>

#include <netdb.h>
#include <unistd.h>

#include <fmt/format.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include "coupling/protocol/descriptor_stream.h"

namespace quasimc {
namespace {

using Clock = std::chrono::steady_clock;

/// Time to wait for the simulator to listen, which may start this process first.
constexpr std::chrono::seconds kPatience{1};
constexpr std::chrono::milliseconds kPause{20};

[[noreturn]] void fail(const std::string& host, int port, const std::string& why) {
    throw InputError(
        {{fmt::format("{} port {}", host, port), "the plant simulator can't be reached", why,
          "-host and -k name the computer and the first of the two ports it listens on"}});
}

struct FreeAddresses {
    void operator()(addrinfo* list) const { ::freeaddrinfo(list); }
};
using Addresses = std::unique_ptr<addrinfo, FreeAddresses>;

Addresses addresses_of(const std::string& host, int port) {
    addrinfo hints{};
    hints.ai_socktype = SOCK_STREAM;
    addrinfo* list = nullptr;
    const int error = ::getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &list);
    if (error != 0) {
        fail(host, port, ::gai_strerror(error));
    }
    return Addresses(list);
}

/// A connection, or the error number.
struct Attempt {
    int descriptor = -1;
    int error = 0;
};

Attempt try_addresses(const addrinfo* list) {
    Attempt attempt;
    for (const addrinfo* a = list; a != nullptr; a = a->ai_next) {
        const int made = ::socket(a->ai_family, a->ai_socktype | SOCK_CLOEXEC, a->ai_protocol);
        if (made >= 0 && ::connect(made, a->ai_addr, a->ai_addrlen) == 0) {
            const int on = 1;
            ::setsockopt(made, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
            return {made, 0};
        }
        attempt.error = errno;
        if (made >= 0) {
            ::close(made);
        }
    }
    return attempt;
}

int connect_to(const std::string& host, int port, Clock::time_point until) {
    const Addresses list = addresses_of(host, port);
    while (true) {
        const Attempt attempt = try_addresses(list.get());
        if (attempt.descriptor >= 0) {
            return attempt.descriptor;
        }
        if (attempt.error != ECONNREFUSED || Clock::now() >= until) {
            fail(host, port, std::generic_category().message(attempt.error));
        }
        std::this_thread::sleep_for(kPause);
    }
}

}  // namespace

std::unique_ptr<ByteStream> make_socket_stream(const std::string& host, int port) {
    const Clock::time_point until = Clock::now() + kPatience;
    const int out = connect_to(host, port, until);
    try {
        const int in = connect_to(host, port + 1, until);
        return std::make_unique<DescriptorStream>(in, out, DescriptorStream::Ownership::owned);
    } catch (...) {
        ::close(out);
        throw;
    }
}

}  // namespace quasimc
