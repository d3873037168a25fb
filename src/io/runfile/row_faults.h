#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "io/runfile/table_reader.h"

namespace quasimc {

/// Collects the faults of a table's rows, to report each kind of fault once.
class RowFaults {
  public:
    /// @param problem, why  name the kind, and must outlive this
    void add(std::uint32_t line, std::string_view problem, std::string_view why);
    /// Reports each kind at its first line, with the number of the other rows that have it.
    void report(Reporter& reporter) const;

  private:
    struct Kind {
        std::string_view problem, why;
        std::uint32_t first = 0;
        std::size_t more = 0;  // rows
    };
    std::vector<Kind> kinds_;
};

}  // namespace quasimc
