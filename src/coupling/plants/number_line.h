#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "coupling/vlab/comm_file.h"

namespace quasimc {

/// Appends a number with six significant digits, as printf's "%g" writes it.
void append_six_digits(std::string& text, double value);

/// The number that its text with six digits has.
[[nodiscard]] double six_digits(double value);

/// A line of numbers by a format of printf, whose conversions are %f, %e and %g with flags, width
/// and precision.
class NumberLine {
  public:
    /// The line of a turtle field, empty if it is not sent.
    /// @param max_numbers  number of conversions that the field has values for
    /// @param faults  receives the fault of an invalid format
    NumberLine(const TurtleLine& line, std::size_t max_numbers, Faults& faults);

    [[nodiscard]] bool is_sent() const { return count_ > 0; }
    /// Appends the line with its end. @param values  at least as many as conversions
    void append(std::string& text, std::span<const double> values) const;

  private:
    std::string format_;
    std::size_t count_ = 0;  // of conversions
};

}  // namespace quasimc
