#pragma once

#include <functional>
#include <memory>

#include "view/window_site.h"

namespace quasimc {

/// How much a server bears.
struct ServerLimits {
    std::size_t connections = 64;      ///< at a time; one more ends the oldest that is idle
    std::size_t request_bytes = 8192;  ///< up to the empty line
    double request_seconds = 5;        ///< for all of a request
    double idle_seconds = 30;          ///< without taking a byte of the answer
};

/// Serves a site on 127.0.0.1, one request a connection, in one thread that never waits for a
/// single connection: who is slow, or many, holds up nobody else.
class WindowServer {
  public:
    /// Opens the port. @param port  0: any that is free
    /// @throws InputError  if the port can't be had
    WindowServer(WindowSite site, int port, const ServerLimits& limits = {});
    ~WindowServer();
    WindowServer(const WindowServer&) = delete;
    WindowServer& operator=(const WindowServer&) = delete;

    [[nodiscard]] std::string address() const;
    /// Serves until asked to stop, which is looked at some times a second.
    void serve(const std::function<bool()>& is_stopped);
    /// Lets serve() look at once whether it is to stop, for good. From any thread.
    void wake() const;

  private:
    class State;
    std::unique_ptr<State> state_;
};

}  // namespace quasimc
