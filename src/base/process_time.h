#pragma once

#include <chrono>
#include <ctime>

namespace quasimc {

/// Processor time of all threads of this process, in seconds.
[[nodiscard]] inline double process_cpu_seconds() {
    constexpr double kNano = 1e-9;
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + kNano * static_cast<double>(now.tv_nsec);
}

/// Measures time since its construction.
class Stopwatch {
  public:
    /// Wall-clock time.
    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }
    /// Processor time of this process, all threads.
    [[nodiscard]] double cpu_seconds() const { return process_cpu_seconds() - cpu_start_; }

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    double cpu_start_ = process_cpu_seconds();
};

}  // namespace quasimc
