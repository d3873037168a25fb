#pragma once

// Estimates, and the sums of a run that they are made of.

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <string_view>

namespace quasimc {

/// A number estimated from independent randomizations.
struct Estimate {
    double mean = 0;
    double standard_error =
        0;  ///< of the mean; NaN when it can't be told (one replicate, or nothing was hit)
    double ci95_low = 0;  ///< ends of the 95 % confidence interval
    double ci95_high = 0;
};

/// The estimate of a number of which nothing is known: all NaN.
inline constexpr Estimate kUnknownEstimate{
    std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN(),
    std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};

/// The estimate of a number times `factor` >= 0.
[[nodiscard]] constexpr Estimate scaled(const Estimate& e, double factor) {
    return {e.mean * factor, e.standard_error * factor, e.ci95_low * factor, e.ci95_high * factor};
}

struct SumData;  // sums/sum_data.h

/// Sums hold the light that a run, or a part of it, has summed, exactly, and what the numbers mean:
/// a value that can be added to, kept and sent. evaluate_run() turns it into a Result.
class Sums {
  public:
    Sums();  ///< of nothing
    explicit Sums(SumData data);
    Sums(const Sums& other);
    Sums(Sums&& other) noexcept;  ///< what was moved from is of nothing
    Sums& operator=(const Sums& other);
    Sums& operator=(Sums&& other) noexcept;
    ~Sums();

    /// Adds the sums of other paths of the same run.
    /// @throws std::invalid_argument  if the two are not of one run: inputs, methods, units or
    ///         numbers of replicates differ
    Sums& operator+=(const Sums& other);
    /// Adds the sums of another share of the same paths.
    /// @throws std::invalid_argument  if the two are not of one run, or not of as many paths
    Sums& add_share(const Sums& other);

    [[nodiscard]] std::uint64_t paths() const;  ///< done, per replicate
    [[nodiscard]] std::uint64_t rays() const;   ///< cast in all replicates
    [[nodiscard]] std::uint64_t digest()
        const;  ///< of scene, sources and specification; 0: unknown

    /// The engine reads and writes the content; SumData is its own.
    [[nodiscard]] const SumData& operator*() const { return *data_; }
    [[nodiscard]] SumData& operator*() { return *data_; }
    [[nodiscard]] const SumData* operator->() const { return data_.get(); }
    [[nodiscard]] SumData* operator->() { return data_.get(); }
    friend bool operator==(const Sums& a, const Sums& b);

  private:
    std::unique_ptr<SumData> data_;
};

/// Sums as bytes, for files and other machines: the same on every machine of one byte order.
[[nodiscard]] std::string save_sums(const Sums& sums);
/// @throws std::invalid_argument  if these are not the bytes of sums: cut off, changed, of another
///         version or byte order
[[nodiscard]] Sums load_sums(std::string_view bytes);

}  // namespace quasimc
