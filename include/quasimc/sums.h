#pragma once

// Estimates, and the sums of a run from which they are computed.

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
        0;  ///< standard error of the mean; NaN if unknown (one replicate, or zero contributions)
    double ci95_low = 0;  ///< ends of the 95 % confidence interval
    double ci95_high = 0;
};

/// The estimate of an unknown number: all NaN.
inline constexpr Estimate kUnknownEstimate{
    std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN(),
    std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};

/// The estimate of a number times `factor` >= 0.
[[nodiscard]] constexpr Estimate scaled(const Estimate& e, double factor) {
    return {e.mean * factor, e.standard_error * factor, e.ci95_low * factor, e.ci95_high * factor};
}

struct SumData;  // sums/sum_data.h

/// The exact sums of light of a run, or of a part of it, and their meaning: a value that can be
/// added to, stored and sent. evaluate_run() turns it into a Result.
class Sums {
  public:
    Sums();  ///< no sums
    explicit Sums(SumData data);
    Sums(const Sums& other);
    Sums(Sums&& other) noexcept;  ///< leaves no sums in `other`
    Sums& operator=(const Sums& other);
    Sums& operator=(Sums&& other) noexcept;
    ~Sums();

    /// Adds the sums of other paths of the same run.
    /// @throws std::invalid_argument  if the two belong to different runs: inputs, methods, units
    /// or numbers of replicates differ
    Sums& operator+=(const Sums& other);
    /// Adds the sums of another share of the same paths.
    /// @throws std::invalid_argument  if the two belong to different runs, or have different
    /// numbers of paths
    Sums& add_share(const Sums& other);

    [[nodiscard]] std::uint64_t paths() const;  ///< completed, per replicate
    [[nodiscard]] std::uint64_t rays() const;   ///< cast in all replicates
    [[nodiscard]] std::uint64_t digest()
        const;  ///< hash of scene, sources and specification; 0: unknown

    /// Content for the library itself: SumData is private.
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
/// @throws std::invalid_argument  if these are not the bytes of sums: truncated, changed, of
/// another version or byte order
[[nodiscard]] Sums load_sums(std::string_view bytes);

}  // namespace quasimc
