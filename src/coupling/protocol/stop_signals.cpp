#include "coupling/protocol/stop_signals.h"

#include <array>
#include <cerrno>
#include <cstdint>
#include <utility>

#include <poll.h>
#include <unistd.h>

#include <sys/eventfd.h>
#include <sys/signalfd.h>

#include "base/start_thread.h"

namespace quasimc {
namespace {

bool is_ignored(int signal) {
    struct sigaction action {};
    return ::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

StopSignals::StopSignals(std::function<void(int)> on_signal) : on_signal_(std::move(on_signal)) {
    sigset_t stops{};
    sigemptyset(&stops);
    for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
        if (!is_ignored(signal)) {
            sigaddset(&stops, signal);
        }
    }
    ::pthread_sigmask(SIG_BLOCK, &stops, &before_);
    signals_ = ::signalfd(-1, &stops, SFD_CLOEXEC);
    end_ = ::eventfd(0, EFD_CLOEXEC);
    thread_ = start_thread<std::thread>([this] { wait(); });
}

StopSignals::~StopSignals() {
    const std::uint64_t one = 1;
    static_cast<void>(::write(end_, &one, sizeof one) < 0);
    thread_.join();
    ::close(end_);
    ::close(signals_);
    ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

void StopSignals::wait() {
    std::array<pollfd, 2> ends{{{signals_, POLLIN, 0}, {end_, POLLIN, 0}}};
    while (true) {
        const int ready = ::poll(ends.data(), ends.size(), -1);
        if (ready < 0 && errno == EINTR) {
            continue;
        }
        if (ready <= 0 || ends[1].revents != 0) {
            return;
        }
        signalfd_siginfo what{};
        if (::read(signals_, &what, sizeof what) == sizeof what) {
            on_signal_(static_cast<int>(what.ssi_signo));
        }
    }
}

}  // namespace quasimc
