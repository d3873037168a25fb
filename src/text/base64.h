#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace quasimc {

/// `bytes` as text (RFC 4648, section 4), without line ends.
[[nodiscard]] std::string encode_base64(std::string_view bytes);

/// The bytes that a base64 text stands for (RFC 4648, section 4), with or without the '=' at its
/// end; nothing if it is no such text.
[[nodiscard]] std::optional<std::string> decode_base64(std::string_view text);

}  // namespace quasimc
