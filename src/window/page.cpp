#include "window/page.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/checks.h"
#include "files/sha256.h"
#include "picture/color_map.h"
#include "quasimc/error.h"
#include "text/base64.h"
#include "window/window_names.h"

// The bytes of the files of the page.
#define QUASIMC_EMBED(symbol, file)         \
    __asm__(                                \
        ".pushsection .rodata\n"            \
        ".balign 16\n"                      \
        ".hidden " #symbol                  \
        "\n"                                \
        ".hidden " #symbol                  \
        "_end\n"                            \
        ".global " #symbol                  \
        "\n"                                \
        ".global " #symbol "_end\n" #symbol \
        ":\n"                               \
        ".incbin \"" file "\"\n" #symbol    \
        "_end:\n"                           \
        ".byte 0\n"                         \
        ".popsection\n")
QUASIMC_EMBED(quasimc_page_html, QUASIMC_PAGE "/index.html");
QUASIMC_EMBED(quasimc_page_style, QUASIMC_PAGE "/viewer.css");
QUASIMC_EMBED(quasimc_page_script, QUASIMC_PAGE "/viewer.js");
extern "C" {
// NOLINTBEGIN(modernize-avoid-c-arrays)
extern const char quasimc_page_html[], quasimc_page_html_end[];
extern const char quasimc_page_style[], quasimc_page_style_end[];
extern const char quasimc_page_script[], quasimc_page_script_end[];
// NOLINTEND(modernize-avoid-c-arrays)
}

namespace quasimc {
namespace {

std::string_view between(const char* begin, const char* end) {
    return {begin, static_cast<std::size_t>(end - begin)};
}

/// The hash of a script or a style in a content security policy: 'sha256-...'.
std::string source_hash(std::string_view text) {
    const std::string hex = sha256_hex(text);
    std::string bytes;
    const auto digit = [](char c) { return c <= '9' ? c - '0' : c - 'a' + 10; };
    for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
        bytes.push_back(static_cast<char>(16 * digit(hex[i]) + digit(hex[i + 1])));
    }
    return fmt::format("'sha256-{}'", encode_base64(bytes));
}

/// JSON for an element of HTML, with '<' escaped, so that it can't end the element.
std::string in_element(std::string_view json) {
    std::string text;
    text.reserve(json.size());
    for (const char c : json) {
        if (c == '<') {
            text += "\\u003c";
        } else {
            text += c;
        }
    }
    return text;
}

/// Splits the page at a mark: returns the text before it, and leaves the text after it.
std::string_view take_until(std::string_view& rest, std::string_view mark) {
    const std::size_t at = rest.find(mark);
    ENSURE(at != std::string_view::npos);
    const std::string_view before = rest.substr(0, at);
    rest.remove_prefix(at + mark.size());
    return before;
}

/// The beginning of an element that holds data.
std::string element(const std::string& id, std::string_view type, const std::string& more = "") {
    return fmt::format("<script type=\"{}\" id=\"{}\"{}>", type, id, more);
}

void write_bytes(const std::string& id, std::string_view bytes, const TextSink& sink) {
    sink(element(id, "application/octet-stream;base64"));
    constexpr std::size_t kPiece = 3U << 18U;
    for (std::size_t i = 0; i < bytes.size(); i += kPiece) {
        sink(encode_base64(bytes.substr(i, kPiece)));
    }
    sink("</script>\n");
}

/// The beginning of the names of a point's data.
std::string prefix_of(std::size_t point) {
    return point == 0 ? "" : fmt::format("point-{}-", point);
}

/// Writes the data of a point, with its shape unless an earlier one has the same.
void write_point(std::span<const WindowData> points, std::size_t point, const TextSink& sink) {
    const WindowData& data = points[point];
    const std::string prefix = prefix_of(point);
    sink(element(prefix + "data", kJsonType));
    sink(in_element(data.json));
    sink("</script>\n");
    const auto same = std::ranges::find(points, data.shape, &WindowData::shape);
    const auto first = static_cast<std::size_t>(same - points.begin());
    if (first == point) {
        write_bytes(prefix + "shape", data.shape, sink);
    } else {
        const std::string reference = fmt::format(" data-same=\"{}shape\"", prefix_of(first));
        sink(element(prefix + "shape", "text/plain", reference) + "</script>\n");
    }
    for (std::size_t i = 0; i < data.values.size(); ++i) {
        write_bytes(fmt::format("{}values-{}", prefix, i), data.values[i], sink);
    }
}

}  // namespace

Page embedded_page() {
    return {
        between(quasimc_page_html, quasimc_page_html_end),
        between(quasimc_page_style, quasimc_page_style_end),
        between(quasimc_page_script, quasimc_page_script_end)};
}

void require_page(std::string_view command) {
    if (embedded_page().script.empty()) {
        throw InputError(
            {{std::string(command), "this program was built without the viewer",
              "Node.js or the packages of web/ were missing",
              "install Node.js 18 or later and build again, or draw a picture: quasimc show"}});
    }
}

std::string color_maps_json() {
    std::string json = "{";
    for (const ColorMap& map : color_map_table()) {
        json += fmt::format("{}\"{}\":[", json.size() > 1 ? "," : "", map.name);
        constexpr int kSteps = 64;
        for (int i = 0; i < kSteps; ++i) {
            const Rgb color = color_at(map, static_cast<double>(i) / (kSteps - 1));
            json += fmt::format("{}[{},{},{}]", i > 0 ? "," : "", color.r, color.g, color.b);
        }
        json += ']';
    }
    return json + '}';
}

void write_report(std::span<const WindowData> points, const TextSink& sink) {
    const Page page = embedded_page();
    std::string_view rest = page.html;
    sink(take_until(rest, "<!--policy-->"));
    sink(fmt::format(
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
        "script-src {}; style-src {}; img-src data:; base-uri 'none'; form-action 'none'\">",
        source_hash(page.script), source_hash(page.style)));
    sink(take_until(rest, "<!--style-->"));
    sink("<style>");
    sink(page.style);
    sink("</style>");
    sink(take_until(rest, "<!--data-->"));
    sink(element("colors", kJsonType));
    sink(color_maps_json());
    sink("</script>\n");
    for (std::size_t point = 0; point < points.size(); ++point) {
        write_point(points, point, sink);
    }
    take_until(rest, "<!--script-->");
    sink("<script>");
    sink(page.script);
    sink("</script>");
    sink(rest);
}

}  // namespace quasimc
