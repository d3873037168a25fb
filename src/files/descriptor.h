#pragma once

#include <utility>

#include <unistd.h>

namespace quasimc {

/// A file descriptor that is closed at the end, unless it is standard input.
class Descriptor {
  public:
    /// @param number  result of open(); negative: none
    explicit Descriptor(int number) : number_(number) {}
    ~Descriptor() {
        if (number_ >= 0 && number_ != STDIN_FILENO) {
            ::close(number_);
        }
    }
    Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(number_, other.number_);
        return *this;
    }

    [[nodiscard]] int number() const { return number_; }
    [[nodiscard]] bool is_open() const { return number_ >= 0; }

  private:
    int number_;
};

}  // namespace quasimc
