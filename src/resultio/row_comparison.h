#pragma once

#include <cstddef>
#include <fstream>
#include <string>
#include <string_view>

namespace quasimc {

/// Compares the rows of a JSON result that is being written (organs, groups) with those of one that
/// is stored, in their order. Neither needs to fit in memory.
class RowComparison {
  public:
    /// @param path  stored result; if its rows are not one per line (rewritten by another
    /// program), it has none
    explicit RowComparison(const std::string& path) : stored_(path, std::ios::binary) {}

    /// Adds text of the result that is being written.
    void add(std::string_view text);

    /// The number of rows that differ, as text; "" if none, or if the numbers of rows differ (other
    /// times). Values that only one of them has are ignored. To be called at the end.
    [[nodiscard]] std::string difference();

  private:
    [[nodiscard]] bool next_stored(std::string& row);
    void compare(std::string_view line);

    std::ifstream stored_;
    std::string begun_;  // a line that is written
    std::size_t rows_ = 0, stored_rows_ = 0, differing_ = 0;
};

}  // namespace quasimc
