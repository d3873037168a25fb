// Pipes and TCP to an environment program.

#include <algorithm>
#include <array>
#include <cerrno>
#include <limits>
#include <optional>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include "coupling/plants/program_connection.h"
#include "files/descriptor.h"

namespace quasimc {
namespace {

/// The byte that a program sends at its start and at its end.
constexpr char kSignOfProgram = '\x01';
/// Time of one wait for the first sign.
constexpr int kSignSliceMs = 100;

[[noreturn]] void no_connection(const char* what) {
    throw ProgramNotStarted(std::string(what) + ": " + std::generic_category().message(errno));
}

bool is_ready(int descriptor, short events, int limit_ms) {
    pollfd end{descriptor, events, 0};
    return ::poll(&end, 1, limit_ms) > 0;
}

/// A pair of descriptors. Writing reads too, so that a program that answers early never waits for
/// a simulator that waits for it.
class DescriptorConnection : public ProgramConnection {
  public:
    using ProgramConnection::ProgramConnection;

    void send(std::string_view message) override {
        if (!write(message, -1)) {
            fail_as_ended();
        }
    }
    std::string_view receive_line() override {
        constexpr std::size_t kLongestLine = std::size_t{1} << 20U;
        buffer_.erase(0, taken_);
        taken_ = 0;
        std::size_t searched = 0;
        while (true) {
            const std::size_t end = buffer_.find('\n', searched);
            if (end != std::string::npos) {
                taken_ = end + 1;
                return std::string_view(buffer_).substr(0, end);
            }
            searched = buffer_.size();
            if (searched > kLongestLine) {
                fail("its output is not text", "a line of a reply is longer than 1 MiB");
            }
            if (!read_some()) {
                fail_as_ended();
            }
        }
    }
    void request_chunk() override {}
    [[nodiscard]] std::size_t capacity() const override {
        return std::numeric_limits<std::size_t>::max();
    }
    [[nodiscard]] std::size_t default_chunk() const override { return 100; }

  protected:
    /// @param in, out  this process's ends
    void open(Descriptor in, Descriptor out) {
        in_ = std::move(in);
        out_ = std::move(out);
        ::fcntl(out_.number(), F_SETFL, ::fcntl(out_.number(), F_GETFL) | O_NONBLOCK);
    }
    void await_sign_byte() {
        await_sign([&] {
            if (!is_ready(in_.number(), POLLIN, kSignSliceMs)) {
                return false;
            }
            constexpr useconds_t kPauseUs = 1000;
            char byte = 0;
            const ssize_t count = ::read(in_.number(), &byte, 1);
            if (count == 1 && byte != kSignOfProgram) {
                wait_for_end();
                throw ProgramNotStarted("it refused, or wrote something else than the sign");
            }
            if (count == 0) {
                ::usleep(kPauseUs);  // its end comes after that of its output
            }
            return count == 1;
        });
    }

  private:
    void send_last(std::string_view message) override {
        constexpr int kLimitMs = 1000;
        static_cast<void>(write(message, kLimitMs));
        out_ = Descriptor(-1);
    }

    /// Returns false if the program no longer reads, or not within the time. @param limit_ms  of a
    /// wait; negative: none
    bool write(std::string_view text, int limit_ms) {
        while (!text.empty()) {
            std::array<pollfd, 2> ends{{{out_.number(), POLLOUT, 0}, {in_.number(), POLLIN, 0}}};
            const int ready = ::poll(ends.data(), ends.size(), limit_ms);
            if (ready < 0 && errno == EINTR) {
                continue;
            }
            if (ready <= 0 || (ends[1].revents != 0 && !read_some())) {
                return false;
            }
            const ssize_t count = ends[0].revents == 0 ? 0 : write_some(text);
            if (count < 0 && errno != EAGAIN && errno != EINTR) {
                return false;
            }
            text.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
        }
        return true;
    }
    /// Writes without a signal if nothing reads. Pipes need an ignored SIGPIPE for that.
    [[nodiscard]] ssize_t write_some(std::string_view text) const {
        const ssize_t sent = ::send(out_.number(), text.data(), text.size(), MSG_NOSIGNAL);
        return sent < 0 && errno == ENOTSOCK ? ::write(out_.number(), text.data(), text.size())
                                             : sent;
    }
    /// Reads the available bytes; returns false at the end.
    bool read_some() {
        std::array<char, 65536> piece{};
        ssize_t count = 0;
        do {
            count = ::read(in_.number(), piece.data(), piece.size());
        } while (count < 0 && errno == EINTR);
        buffer_.append(piece.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
        return count > 0;
    }

    Descriptor in_{-1}, out_{-1};
    std::string buffer_;
    std::size_t taken_ = 0;  // bytes of the buffer that were given out
};

class PipeConnection final : public DescriptorConnection {
  public:
    explicit PipeConnection(const ProgramCommand& command)
        : DescriptorConnection(command.patience) {
        std::array<int, 2> to{}, from{};
        if (::pipe2(to.data(), O_CLOEXEC) != 0) {
            no_connection("there is no pipe");
        }
        const Descriptor its_in(to[0]);
        Descriptor our_out(to[1]);
        if (::pipe2(from.data(), O_CLOEXEC) != 0) {
            no_connection("there is no pipe");
        }
        Descriptor our_in(from[0]);
        {
            const Descriptor its_out(from[1]);
            start(command.with({}), its_in.number(), its_out.number());
        }
        open(std::move(our_in), std::move(our_out));
        await_sign_byte();
    }
};

class SocketConnection final : public DescriptorConnection {
  public:
    explicit SocketConnection(const ProgramCommand& command)
        : DescriptorConnection(command.patience) {
        const int port = listen();
        start(command.with({"-k", std::to_string(port), "-host", "localhost"}), -1, -1);
        Descriptor in = accept(to_us_);
        open(std::move(in), accept(from_us_));
        await_sign_byte();
    }

  private:
    static sockaddr_in address_of(int port) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(static_cast<std::uint16_t>(port));
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        return address;
    }
    static Descriptor listener_on(int port) {
        Descriptor made(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
        const int on = 1;
        ::setsockopt(made.number(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
        const sockaddr_in address = address_of(port);
        const bool listens =
            ::bind(made.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address) ==
                0 &&
            ::listen(made.number(), 1) == 0;
        return listens ? std::move(made) : Descriptor(-1);
    }
    /// Listens on two consecutive free ports of this computer. @returns the first
    int listen() {
        constexpr int kFirst = 20000, kCount = 12000, kTries = 500;
        for (int i = 0; i < kTries; ++i) {
            const int port = kFirst + (static_cast<int>(::getpid()) * 2 + 2 * i) % kCount;
            to_us_ = listener_on(port);
            from_us_ = listener_on(port + 1);
            if (to_us_.is_open() && from_us_.is_open()) {
                return port;
            }
        }
        throw ProgramNotStarted("there are no two free ports");
    }
    Descriptor accept(const Descriptor& listener) {
        Descriptor made(-1);
        await_sign([&] {
            if (is_ready(listener.number(), POLLIN, kSignSliceMs)) {
                made = Descriptor(::accept4(listener.number(), nullptr, nullptr, SOCK_CLOEXEC));
            }
            return made.is_open();
        });
        const int on = 1;
        ::setsockopt(made.number(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
        return made;
    }

    Descriptor to_us_{-1}, from_us_{-1};  // listen
};

}  // namespace

std::unique_ptr<ProgramConnection> connect_by_pipes(const ProgramCommand& command) {
    return std::make_unique<PipeConnection>(command);
}

std::unique_ptr<ProgramConnection> connect_by_sockets(const ProgramCommand& command) {
    return std::make_unique<SocketConnection>(command);
}

}  // namespace quasimc
