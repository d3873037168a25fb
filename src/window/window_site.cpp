#include "window/window_site.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <optional>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <sys/random.h>

#include "window/page.h"
#include "window/window_names.h"

namespace quasimc {
namespace {

constexpr std::string_view kLineEnd = "\r\n";

bool equal_names(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](unsigned char x, unsigned char y) {
        return std::tolower(x) == std::tolower(y);
    });
}

std::string_view without_blanks(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) {
        return {};
    }
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Method, target and version of the first line.
bool take_first_line(std::string_view line, HttpRequest& request) {
    const std::size_t first = line.find(' '), last = line.rfind(' ');
    if (first == std::string_view::npos || last == first) {
        return false;
    }
    request.method = line.substr(0, first);
    request.target = line.substr(first + 1, last - first - 1);
    const std::string_view version = line.substr(last + 1);
    const bool is_clean = std::all_of(
        request.target.begin(), request.target.end(), [](char c) { return c > ' ' && c < '\x7f'; });
    return is_clean && !request.target.empty() && (version == "HTTP/1.1" || version == "HTTP/1.0");
}

/// Whether a value has no control characters except tabs (RFC 9110, section 5.5): for programs that
/// end lines at a lone CR or LF, another Host could follow.
bool is_field_value(std::string_view value) {
    return std::none_of(value.begin(), value.end(), [](unsigned char c) {
        return (c < ' ' && c != '\t') || c == 0x7F;
    });
}

bool take_header(std::string_view line, HttpRequest& request) {
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos || colon == 0) {
        return false;
    }
    const std::string_view name = line.substr(0, colon);
    const std::string_view value = without_blanks(line.substr(colon + 1));
    if (!is_field_value(value)) {
        return false;
    }
    const auto set_once = [&](std::string_view& field) {
        const bool is_first = field.data() == nullptr;
        field = value.data() == nullptr ? std::string_view("") : value;
        return is_first;
    };
    if (equal_names(name, "host")) {
        return set_once(request.host);
    }
    if (equal_names(name, "origin")) {
        return set_once(request.origin);
    }
    if (equal_names(name, "sec-fetch-site")) {
        return set_once(request.fetch_site);
    }
    request.has_body = request.has_body || equal_names(name, "transfer-encoding") ||
                       (equal_names(name, "content-length") && value != "0");
    return name.find_first_of(" \t") == std::string_view::npos;
}

/// Compares in constant time.
bool is_same_secret(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) {
        return false;
    }
    unsigned difference = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
    }
    return difference == 0;
}

std::string_view reason_of(int status) {
    switch (status) {
        case 200:
            return "OK";
        case 403:
            return "Forbidden";
        case 404:
            return "Not Found";
        case 405:
            return "Method Not Allowed";
        case 413:
            return "Content Too Large";
        case 421:
            return "Misdirected Request";
        case 431:
            return "Request Header Fields Too Large";
        default:
            return "Bad Request";
    }
}

/// The page with links to its parts instead of the parts.
std::string served_html(std::string_view html, WindowKind kind) {
    const auto put = [](std::string text, std::string_view mark, std::string_view link) {
        const std::size_t at = text.find(mark);
        return at == std::string::npos ? text : text.replace(at, mark.size(), link);
    };
    std::string text = put(std::string(html), "<!--policy-->", "");
    text = put(std::move(text), "<!--style-->", "<link rel=\"stylesheet\" href=\"viewer.css\">");
    text =
        put(std::move(text), "<!--data-->",
            kind == WindowKind::live ? "<div id=\"live\" hidden></div>" : "");
    return put(std::move(text), "<!--script-->", "<script src=\"viewer.js\"></script>");
}

}  // namespace

HttpRequest parse_request(std::string_view text) {
    HttpRequest request;
    std::size_t end = text.find(kLineEnd);
    if (end == std::string_view::npos || !take_first_line(text.substr(0, end), request)) {
        return request;
    }
    text.remove_prefix(end + kLineEnd.size());
    for (end = text.find(kLineEnd); end != 0; end = text.find(kLineEnd)) {
        if (end == std::string_view::npos || !take_header(text.substr(0, end), request)) {
            return request;
        }
        text.remove_prefix(end + kLineEnd.size());
    }
    request.is_valid = true;
    return request;
}

std::string HttpAnswer::head() const {
    return fmt::format(
        "HTTP/1.1 {} {}\r\n"
        "Content-Type: {}\r\n"
        "Content-Length: {}\r\n"
        "Connection: close\r\n"
        "Cache-Control: no-store\r\n"
        "Content-Security-Policy: default-src 'none'; script-src 'self'; style-src 'self'; "
        "connect-src 'self'; img-src 'self' data:; base-uri 'none'; form-action 'none'; "
        "frame-ancestors 'none'\r\n"
        "Cross-Origin-Opener-Policy: same-origin\r\n"
        "Cross-Origin-Resource-Policy: same-origin\r\n"
        "Referrer-Policy: no-referrer\r\n"
        "X-Content-Type-Options: nosniff\r\n"
        "X-Frame-Options: DENY\r\n"
        "\r\n",
        status, reason_of(status), type, body.size());
}

WindowFiles files_of(WindowData data) {
    const auto kept = std::make_shared<const WindowData>(std::move(data));
    return [kept](std::string_view name) -> std::optional<WindowFile> {
        if (name == "data") {
            return WindowFile{kJsonType, kept->json};
        }
        if (name == "shape") {
            return WindowFile{kBytesType, kept->shape};
        }
        const auto number = numbers_behind<1>("values", name);
        if (number && number->front() < kept->values.size()) {
            return WindowFile{kBytesType, kept->values[number->front()]};
        }
        if (const auto numbers = numbers_behind<2>("course", name)) {
            auto bytes =
                std::make_shared<const std::string>(kept->course((*numbers)[0], (*numbers)[1]));
            if (!bytes->empty()) {
                return WindowFile{kBytesType, *bytes, bytes};
            }
        }
        return std::nullopt;
    };
}

ViewerRoutes::ViewerRoutes(WindowFiles files, std::string token, WindowKind kind)
    : files_(std::move(files)),
      token_(std::move(token)),
      colors_(color_maps_json()),
      html_(served_html(embedded_page().html, kind)) {}

void ViewerRoutes::set_port(int port) {
    host_ = fmt::format("127.0.0.1:{}", port);
    local_host_ = fmt::format("localhost:{}", port);
}

std::string ViewerRoutes::address() const {
    return fmt::format("http://{}/{}/", host_, token_);
}

HttpAnswer ViewerRoutes::answer(const HttpRequest& request) const {
    const auto refuse = [](int status, std::string_view words) {
        return HttpAnswer{.status = status, .body = words};
    };
    if (!request.is_valid) {
        return refuse(400, "bad request\n");
    }
    if (request.host != host_ && !equal_names(request.host, local_host_)) {
        return refuse(421, "wrong host\n");
    }
    const std::string origin = fmt::format("http://{}", request.host);
    if (request.origin.data() != nullptr && !equal_names(request.origin, origin)) {
        return refuse(403, "not from this page\n");
    }
    if (request.fetch_site == "cross-site" || request.fetch_site == "same-site") {
        return refuse(403, "not from this page\n");
    }
    if (request.method != "GET" && request.method != "HEAD") {
        return refuse(405, "only GET and HEAD\n");
    }
    if (request.has_body) {
        return refuse(413, "a request has no body\n");
    }
    const std::string_view target = request.target;
    const std::size_t slash = target.find('/', 1);
    if (target.front() != '/' || slash == std::string_view::npos ||
        !is_same_secret(target.substr(1, slash - 1), token_)) {
        return refuse(403, "wrong address\n");
    }
    HttpAnswer found = file(target.substr(slash + 1));
    found.is_head = request.method == "HEAD";
    return found;
}

HttpAnswer ViewerRoutes::file(std::string_view name) const {
    const Page page = embedded_page();
    const std::array<std::pair<std::string_view, HttpAnswer>, 4> files{{
        {"", {200, "text/html; charset=utf-8", html_}},
        {"viewer.css", {200, "text/css; charset=utf-8", page.style}},
        {"viewer.js", {200, "text/javascript; charset=utf-8", page.script}},
        {"colors", {200, kJsonType, colors_}},
    }};
    for (const auto& [known, answer] : files) {
        if (name == known) {
            return answer;
        }
    }
    if (auto found = files_(name)) {
        return {200, found->type, found->body, false, std::move(found->owner)};
    }
    return {404, "text/plain; charset=utf-8", "not found\n"};
}

std::string random_token() {
    std::array<unsigned char, 16> bytes{};
    if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
        throw std::system_error(errno, std::generic_category(), "random numbers");
    }
    std::string token;
    for (const unsigned char byte : bytes) {
        token += fmt::format("{:02x}", byte);
    }
    return token;
}

}  // namespace quasimc
