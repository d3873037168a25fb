#include "window/window_server.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <poll.h>

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/eventfd.h>
#include <sys/resource.h>
#include <sys/socket.h>

#include "base/start_thread.h"
#include "files/descriptor.h"
#include "quasimc/error.h"

namespace quasimc {
namespace window_server {

using Clock = std::chrono::steady_clock;

Clock::time_point after(double seconds) {
    return Clock::now() +
           std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

bool can_be_tried_again() {
    return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR;
}

constexpr double kTimeToBegin = 0.1;  // seconds until a connection without a request is silent

/// One request and its answer.
class Connection {
  public:
    Connection(Descriptor socket, const ServerLimits& limits)
        : socket_(std::move(socket)),
          limits_(&limits),
          deadline_(after(limits.request_seconds)),
          silent_from_(after(kTimeToBegin)) {}

    [[nodiscard]] pollfd waits_for() const {
        return {socket_.number(), static_cast<short>(is_answering() ? POLLOUT : POLLIN), 0};
    }
    /// Whether it has sent nothing within kTimeToBegin.
    [[nodiscard]] bool is_silent() const { return head_.empty() && Clock::now() > silent_from_; }
    /// Whether its answer is sent completely, and only the other side still has to close.
    [[nodiscard]] bool is_answered() const { return is_leaving_; }
    [[nodiscard]] bool is_late() const { return Clock::now() > deadline_; }

    /// Proceeds as far as possible without waiting. @returns whether there is more to do
    bool go_on(const ViewerRoutes& site) {
        if (is_leaving_) {
            return drain();
        }
        return is_answering() ? send_more() : read_more(site);
    }

  private:
    [[nodiscard]] bool is_answering() const { return !head_.empty() && !is_leaving_; }

    bool read_more(const ViewerRoutes& site) {
        std::array<char, 2048> bytes{};
        const ssize_t got = recv(socket_.number(), bytes.data(), bytes.size(), 0);
        if (got <= 0) {
            return got < 0 && can_be_tried_again();
        }
        request_.append(bytes.data(), static_cast<std::size_t>(got));
        const std::size_t end = request_.find("\r\n\r\n");
        if (std::min(end, request_.size()) > limits_->request_bytes) {
            start({.status = 431, .body = "too long\n"});
        } else if (end != std::string::npos) {
            start(site.answer(parse_request(std::string_view(request_).substr(0, end + 4))));
        }
        return true;
    }

    void start(const HttpAnswer& answer) {
        head_ = answer.head();
        body_ = answer.is_head ? std::string_view() : answer.body;
        owner_ = answer.owner;
        deadline_ = after(limits_->idle_seconds);
    }

    bool send_more() {
        const std::string_view rest = sent_ < head_.size() ? std::string_view(head_).substr(sent_)
                                                           : body_.substr(sent_ - head_.size());
        const ssize_t sent = send(socket_.number(), rest.data(), rest.size(), MSG_NOSIGNAL);
        if (sent < 0) {
            return can_be_tried_again();
        }
        sent_ += static_cast<std::size_t>(sent);
        deadline_ = after(limits_->idle_seconds);
        if (sent_ == head_.size() + body_.size()) {
            // Further bytes are read and dropped: closing a socket with unread bytes would reset
            // the connection before the client has read the answer (RFC 9112, section 9.6).
            shutdown(socket_.number(), SHUT_WR);
            is_leaving_ = true;
            deadline_ = after(1);
        }
        return true;
    }

    bool drain() {
        std::array<char, 2048> bytes{};
        const ssize_t got = recv(socket_.number(), bytes.data(), bytes.size(), 0);
        return got > 0 || (got < 0 && can_be_tried_again());
    }

    Descriptor socket_;
    const ServerLimits* limits_;
    Clock::time_point deadline_, silent_from_;
    std::string request_, head_;
    std::string_view body_;
    std::shared_ptr<const std::string> owner_;  // owner of the body
    std::size_t sent_ = 0;
    bool is_leaving_ = false;
};

[[noreturn]] void refuse_port(int port) {
    throw InputError(
        {{"--port", fmt::format("{} is not available", port),
          std::generic_category().message(errno), "remove it to use any free port"}});
}

Descriptor listen_at(int port) {
    Descriptor socket(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    const int on = 1;
    setsockopt(socket.number(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    constexpr int kWaiting = 128;
    if (bind(socket.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
        listen(socket.number(), kWaiting) != 0) {
        refuse_port(port);
    }
    return socket;
}

int port_of(const Descriptor& socket) {
    sockaddr_in address{};
    socklen_t size = sizeof address;
    getsockname(socket.number(), reinterpret_cast<sockaddr*>(&address), &size);
    return ntohs(address.sin_port);
}

}  // namespace window_server

using window_server::Connection;

class HttpServer::State {
  public:
    State(ViewerRoutes site, int port, const ServerLimits& limits)
        : site_(std::move(site)), limits_(limits), listener_(window_server::listen_at(port)) {
        site_.set_port(window_server::port_of(listener_));
    }

    [[nodiscard]] std::string address() const { return site_.address(); }

    /// Serves all connections once; waits at most 0.2 s for an event, less if further connections
    /// wait for room.
    void step() {
        std::vector<pollfd> waits;
        for (const Connection& each : connections_) {
            waits.push_back(each.waits_for());
        }
        const bool is_open = has_room() || find_idle() != connections_.end();
        waits.push_back({wake_.number(), POLLIN, 0});
        waits.push_back({listener_.number(), static_cast<short>(is_open ? POLLIN : 0), 0});
        const int milliseconds = is_open ? 200 : 20;
        if (poll(waits.data(), waits.size(), milliseconds) < 0) {
            return;
        }
        std::vector<Connection> going;
        for (std::size_t i = 0; i < connections_.size(); ++i) {
            const bool is_ready = waits[i].revents != 0;
            if (is_ready ? connections_[i].go_on(site_) : !connections_[i].is_late()) {
                // Single bytes sent now and then do not extend the time limit.
                if (!connections_[i].is_late()) {
                    going.push_back(std::move(connections_[i]));
                }
            }
        }
        connections_ = std::move(going);
        if (waits.back().revents != 0) {
            accept_all();
        }
    }

    void wake() const {
        const std::uint64_t one = 1;
        static_cast<void>(::write(wake_.number(), &one, sizeof one) < 0);
    }

  private:
    [[nodiscard]] bool has_room() const { return connections_.size() < limits_.connections; }

    /// The oldest connection that has its answer, or else the oldest silent one.
    [[nodiscard]] std::vector<Connection>::iterator find_idle() {
        const auto first = [this](bool (Connection::*is)() const) {
            return std::find_if(connections_.begin(), connections_.end(), std::mem_fn(is));
        };
        const auto answered = first(&Connection::is_answered);
        return answered != connections_.end() ? answered : first(&Connection::is_silent);
    }

    /// Without room, connections that are answered or silent are closed. Bytes sent before a
    /// connection is accepted are read at once, so that it does not count as silent when many
    /// connections arrive together.
    void accept_all() {
        for (std::size_t i = 0; i < limits_.connections; ++i) {
            const auto idle = find_idle();
            if (!has_room() && idle == connections_.end()) {
                return;
            }
            Descriptor socket(
                accept4(listener_.number(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
            if (!socket.is_open()) {
                return;
            }
            if (!has_room()) {
                connections_.erase(idle);
            }
            connections_.emplace_back(std::move(socket), limits_);
            if (!connections_.back().go_on(site_)) {
                connections_.pop_back();
            }
        }
    }

    ViewerRoutes site_;
    ServerLimits limits_;
    Descriptor listener_;
    Descriptor wake_{::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)};
    std::vector<Connection> connections_;
};

HttpServer::HttpServer(ViewerRoutes site, int port, const ServerLimits& limits)
    : state_(std::make_unique<State>(std::move(site), port, limits)) {
    sigset_t all{}, before{};
    sigfillset(&all);
    ::pthread_sigmask(SIG_BLOCK, &all, &before);
    thread_ = start_thread([this](const std::stop_token& ends) {
        // Lowers the priority of this thread only: computing comes first.
        constexpr int kLowest = 19;
        static_cast<void>(::setpriority(PRIO_PROCESS, 0, kLowest));
        while (!ends.stop_requested()) {
            state_->step();
        }
    });
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

HttpServer::~HttpServer() {
    thread_.request_stop();
    state_->wake();
}

std::string HttpServer::address() const {
    return state_->address();
}

}  // namespace quasimc
