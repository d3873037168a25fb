#pragma once

#include <string>
#include <thread>

#include "view/window_server.h"

namespace quasimc {

/// Serves a site beside the work of a program, on a thread that gives way to all others and takes
/// no signals. It ends at once with this object, whoever is connected.
class WindowThread {
  public:
    /// @throws InputError  if the port can't be had
    WindowThread(WindowSite site, int port);
    ~WindowThread();
    WindowThread(const WindowThread&) = delete;
    WindowThread& operator=(const WindowThread&) = delete;

    [[nodiscard]] std::string address() const { return server_.address(); }

  private:
    WindowServer server_;
    std::jthread thread_;
};

}  // namespace quasimc
