#include "io/sha256.h"

#include <algorithm>

#include <fmt/format.h>

namespace quasimc {

void Sha256::add(std::string_view bytes) {
    const std::size_t filled = size_ % kBlock;
    size_ += bytes.size();
    if (filled > 0) {
        const std::size_t taken = std::min(kBlock - filled, bytes.size());
        std::copy_n(bytes.data(), taken, pending_.data() + filled);
        bytes.remove_prefix(taken);
        if (filled + taken < kBlock) {
            return;
        }
        sha256_take(state_, {pending_.data(), kBlock});
    }
    const std::size_t whole = bytes.size() / kBlock * kBlock;
    sha256_take(state_, bytes.substr(0, whole));
    bytes.remove_prefix(whole);
    std::copy(bytes.begin(), bytes.end(), pending_.begin());
}

std::string Sha256::hex() const {
    constexpr std::size_t kLengthBytes = 8;
    Sha256 padded = *this;
    const std::size_t filled = size_ % kBlock;
    const std::size_t zeros =
        (filled < kBlock - kLengthBytes ? kBlock : 2 * kBlock) - kLengthBytes - filled - 1;
    std::string end = "\x80" + std::string(zeros, '\0');
    for (int shift = 56; shift >= 0; shift -= 8) {
        end += static_cast<char>(8 * size_ >> shift & 0xFF);
    }
    padded.add(end);
    std::string text;
    for (const std::uint32_t word : padded.state_) {
        text += fmt::format("{:08x}", word);
    }
    return text;
}

std::string sha256_hex(std::string_view bytes) {
    Sha256 digest;
    digest.add(bytes);
    return digest.hex();
}

}  // namespace quasimc
