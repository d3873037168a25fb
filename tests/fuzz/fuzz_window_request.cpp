#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "view/window_site.h"

/// No request is answered that does not name the host and the token.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::string_view kToken = "0123456789abcdef0123456789abcdef";
    static const quasimc::WindowSite site = [kToken] {
        quasimc::WindowSite made({"{}", "positions", {"values"}}, std::string(kToken));
        made.set_port(8080);
        return made;
    }();
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const quasimc::HttpAnswer answer = site.answer(quasimc::parse_request(text));
    const bool has_both =
        text.find(kToken) != std::string_view::npos && text.find(":8080") != std::string_view::npos;
    const bool is_told = answer.status == 200 || answer.status == 404;
    if ((is_told && !has_both) || !answer.head().ends_with("\r\n\r\n")) {
        std::abort();
    }
    return 0;
}
