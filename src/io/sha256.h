#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace quasimc {

/// The SHA-256 digest of bytes that come in pieces.
class Sha256 {
  public:
    Sha256();
    ~Sha256();
    Sha256(const Sha256&) = delete;
    Sha256& operator=(const Sha256&) = delete;

    void add(std::string_view bytes);
    /// 64 lower-case hexadecimal digits. Nothing is added after it.
    [[nodiscard]] std::string hex();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// The digest of one piece.
[[nodiscard]] std::string sha256_hex(std::string_view bytes);

}  // namespace quasimc
