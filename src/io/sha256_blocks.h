#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace quasimc {

/// The hash value H of FIPS 180-4, section 6.2.
using Sha256State = std::array<std::uint32_t, 8>;
inline constexpr std::size_t kSha256Block = 64;  // bytes

/// Takes whole blocks into a hash value: by the processor's own instructions where it has them,
/// some five times as fast.
void sha256_take(Sha256State& state, std::string_view blocks);

/// The same in plain arithmetic.
void sha256_take_plainly(Sha256State& state, std::string_view blocks);

}  // namespace quasimc
