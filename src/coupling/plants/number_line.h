#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "coupling/vlab/comm_file.h"

namespace quasimc {

/// Appends a number with six significant digits, as printf's "%g" writes it.
void append_six_digits(std::string& text, double value);

/// The number that its text with six digits has.
[[nodiscard]] double six_digits(double value);

/// A line of numbers by a format of printf, written without printf: its conversions are %f, %e and
/// %g with flags, width and precision.
class NumberLine {
  public:
    /// The line of a turtle field, empty if it is not sent.
    /// @param max_numbers  number of conversions that the field has values for
    /// @param faults  receives the fault of an invalid format
    NumberLine(const TurtleLine& line, std::size_t max_numbers, Faults& faults);

    [[nodiscard]] bool is_sent() const { return !numbers_.empty(); }
    /// Appends the line with its end. @param values  at least as many as conversions
    void append(std::string& text, std::span<const double> values) const;

  private:
    struct Number {
        std::string text_before;
        char conversion = 'g';
        int precision = 6;
        std::size_t width = 0;
        bool is_left = false, has_zeros = false;
        std::string plus = {};  ///< sign of a positive number: "+", " " or none
    };
    class Parser;

    static void append_number(std::string& text, const Number& number, double value);

    std::vector<Number> numbers_;
    std::string text_after_;
};

}  // namespace quasimc
