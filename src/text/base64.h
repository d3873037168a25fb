#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace quasimc {

/// Encodes `bytes` as text (RFC 4648, section 4), without line ends.
[[nodiscard]] std::string encode_base64(std::string_view bytes);

/// Decodes a base64 text (RFC 4648, section 4), with or without the '=' at its end; empty if it is
/// invalid.
[[nodiscard]] std::optional<std::string> decode_base64(std::string_view text);

}  // namespace quasimc
