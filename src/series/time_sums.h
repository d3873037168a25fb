#pragma once

#include <array>

#include "quasimc/sums.h"

namespace quasimc {

/// A sum of estimates with independent errors. Its interval is Student's t with the degrees of
/// freedom of Welch (1947) and Satterthwaite (1946); upper bounds of values without contributions
/// are added to its upper end.
class TimeSum {
  public:
    /// @param freedom  degrees of freedom of the error
    void add(const Estimate& estimate, double weight, double freedom);
    [[nodiscard]] Estimate estimate() const;

  private:
    friend class TimeQuotient;

    double mean_ = 0, variance_ = 0;
    double spread_ = 0;        // sum of variance^2 / degrees of freedom
    double unseen_ = 0;        // sum of upper bounds of values without contributions
    bool is_unknown_ = false;  // some part has an unknown error
};

/// The weight of a time in a quotient of sums.
struct TimeWeight {
    double part = 1, whole = 1;
};

/// A quotient of sums of amounts, part and whole: a share that each time has.
class TimeQuotient {
  public:
    /// @param share  part / whole of the time; its error is independent of that of the whole
    void add(
        const Estimate& share, const Estimate& whole, const TimeWeight& weight, double freedom);
    /// Adds a whole without a part.
    void add_whole(double whole) { whole_ += whole; }
    /// The error follows from the delta method: var(sum of part - R whole) / whole^2. Unknown if
    /// the whole is 0.
    [[nodiscard]] Estimate estimate() const;

  private:
    double part_ = 0, whole_ = 0;
    double variance_ = 0, spread_ = 0;  // of the part, for given wholes; as in TimeSum
    double unseen_ = 0;
    // Sums of (error of the whole)^2 that weigh the share 0, 1 and 2 times: shares differ between
    // times.
    std::array<double, 3> of_whole_{};
    bool is_unknown_ = false;
};

}  // namespace quasimc
