#pragma once

#include <string>

namespace quasimc::test {

/// The body of what a server of this machine answers to GET; "" if it is gone or refuses.
/// @param address  "http://127.0.0.1:8080/token/name"
[[nodiscard]] std::string http_get(const std::string& address);

/// The last address of a server on this machine that a text names; "" if there is none yet.
[[nodiscard]] std::string address_in(const std::string& text);

/// The address that a program tells in a file, once it is there; "" if that takes too long.
[[nodiscard]] std::string await_address(const std::string& file);

}  // namespace quasimc::test
