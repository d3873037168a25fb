#include "view/window_thread.h"

#include <csignal>
#include <utility>

#include <sys/resource.h>

#include "base/start_thread.h"

namespace quasimc {
namespace {

/// Of this thread alone: what is computed comes first.
void give_way() {
    constexpr int kLowest = 19;
    static_cast<void>(::setpriority(PRIO_PROCESS, 0, kLowest));
}

}  // namespace

WindowThread::WindowThread(WindowSite site, int port) : server_(std::move(site), port) {
    sigset_t all{}, before{};
    sigfillset(&all);
    ::pthread_sigmask(SIG_BLOCK, &all, &before);
    thread_ = start_thread([this](const std::stop_token& ends) {
        give_way();
        server_.serve([&ends] { return ends.stop_requested(); });
    });
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

WindowThread::~WindowThread() {
    thread_.request_stop();
    server_.wake();
}

}  // namespace quasimc
