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
    /// @param path  of the stored result; one whose rows do not stand on lines of their own
    /// (another program wrote it anew) has none
    explicit RowComparison(const std::string& path) : stored_(path, std::ios::binary) {}

    /// More of the text of the result that is written.
    void add(std::string_view text);

    /// How many rows differ, in words; "" if none, or if they have not as many rows (of other
    /// times). Numbers that one of them leaves out don't count. To be asked at the end.
    [[nodiscard]] std::string difference();

  private:
    [[nodiscard]] bool next_stored(std::string& row);
    void compare(std::string_view line);

    std::ifstream stored_;
    std::string begun_;  // a line that is written
    std::size_t rows_ = 0, stored_rows_ = 0, differing_ = 0;
};

}  // namespace quasimc
