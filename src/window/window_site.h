#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "window/window_data.h"

namespace quasimc {

/// The head of a request: method, target and the headers that matter.
struct HttpRequest {
    std::string_view method, target;
    std::string_view host, origin, fetch_site;
    bool has_body = false;
    bool is_valid = false;  ///< it is HTTP/1.x, with one Host and at most one Origin
};

/// @param text  up to the empty line, with it (RFC 9112, section 2)
[[nodiscard]] HttpRequest parse_request(std::string_view text);

/// A served file: a type and its bytes.
struct WindowFile {
    std::string_view type, body;
    std::shared_ptr<const std::string> owner =
        {};  ///< owner of the body, if it was made for one request
};

/// The data of a run by name; nothing for unknown names.
using WindowFiles = std::function<std::optional<WindowFile>(std::string_view name)>;

/// The files of a finished run.
[[nodiscard]] WindowFiles files_of(WindowData data);

/// An answer; its body is part of the site, one of a few fixed words, or its own.
struct HttpAnswer {
    int status = 400;
    std::string_view type = "text/plain; charset=utf-8", body = "bad request\n";
    bool is_head = false;                           ///< the body is not requested
    std::shared_ptr<const std::string> owner = {};  ///< owner of the body

    /// Status line and headers, up to the empty line.
    [[nodiscard]] std::string head() const;
};

/// Whether the shown run is finished (of_result) or in progress (live).
enum class WindowKind { of_result, live };

/// The routes of the viewer: the page and the data of a run, below a secret address.
class ViewerRoutes {
  public:
    /// @param token  at least 16 letters or digits, drawn at random for this site
    ViewerRoutes(WindowFiles files, std::string token, WindowKind kind = WindowKind::of_result);

    /// Sets the port: only requests to it on this machine are answered.
    void set_port(int port);
    /// "http://127.0.0.1:8080/TOKEN/".
    [[nodiscard]] std::string address() const;

    /// Refuses requests that come neither from the page nor from a user: other hosts (DNS
    /// rebinding) with 421, other origins and tokens with 403, other paths with
    /// 404, other methods with 405, bodies with 413, malformed requests with 400.
    [[nodiscard]] HttpAnswer answer(const HttpRequest& request) const;

  private:
    [[nodiscard]] HttpAnswer file(std::string_view name) const;

    WindowFiles files_;
    std::string token_, colors_, html_;
    std::string host_, local_host_;  // as in a Host header
};

/// 32 hexadecimal digits from the system's source of random numbers.
[[nodiscard]] std::string random_token();

}  // namespace quasimc
