#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <thread>

#include "window/window_site.h"

namespace quasimc {

/// Limits of a server.
struct ServerLimits {
    std::size_t connections = 64;      ///< at a time; one more ends the oldest that is idle
    std::size_t request_bytes = 8192;  ///< up to the empty line
    double request_seconds = 5;        ///< for all of a request
    double idle_seconds = 30;          ///< without taking a byte of the answer
};

/// Serves a site on 127.0.0.1, one request per connection, while the program computes. Its one
/// thread has the lowest priority, takes no signals and never waits for a single connection, so
/// that slow clients do not delay others. It ends at once with this object, even with open
/// connections.
class HttpServer {
  public:
    /// Opens the port. @param port  0: any free port
    /// @throws InputError  if the port is not available
    HttpServer(ViewerRoutes site, int port, const ServerLimits& limits = {});
    ~HttpServer();
    HttpServer(const HttpServer&) = delete;
    HttpServer& operator=(const HttpServer&) = delete;

    [[nodiscard]] std::string address() const;

  private:
    class State;
    std::unique_ptr<State> state_;
    std::jthread thread_;
};

}  // namespace quasimc
