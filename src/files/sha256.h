#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace quasimc {

/// The SHA-256 digest (FIPS 180-4, section 6.2) of bytes that arrive in pieces.
class Sha256 {
  public:
    void add(std::string_view bytes);
    /// The digest of all bytes so far, 64 lower-case hexadecimal digits; more bytes may follow.
    [[nodiscard]] std::string hex() const;

  private:
    static constexpr std::size_t kBlock = 64;  // bytes

    std::array<std::uint32_t, 8> state_{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                        0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
    std::array<char, kBlock> pending_{};  // incomplete block
    std::uint64_t size_ = 0;              // bytes so far
};

/// The digest of one text.
[[nodiscard]] std::string sha256_hex(std::string_view bytes);

}  // namespace quasimc
