#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <thread>

#include "window/window_site.h"

namespace quasimc {

/// How much a server bears.
struct ServerLimits {
    std::size_t connections = 64;      ///< at a time; one more ends the oldest that is idle
    std::size_t request_bytes = 8192;  ///< up to the empty line
    double request_seconds = 5;        ///< for all of a request
    double idle_seconds = 30;          ///< without taking a byte of the answer
};

/// Serves a site on 127.0.0.1, one request a connection, beside the work of a program: on one
/// thread that gives way to all others, takes no signals and never waits for a single connection,
/// so that slow or many clients hold up nobody else. It ends at once with this object, whoever is
/// connected.
class HttpServer {
  public:
    /// Opens the port. @param port  0: any that is free
    /// @throws InputError  if the port can't be had
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
