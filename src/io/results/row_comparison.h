#pragma once

#include <cstddef>
#include <fstream>
#include <functional>
#include <string>
#include <string_view>

namespace quasimc {

/// Splits text that comes in pieces into lines.
class LineSplitter {
  public:
    /// @param take  told of each line, without its end
    explicit LineSplitter(std::function<void(std::string_view)> take) : take_(std::move(take)) {}
    void add(std::string_view text);

  private:
    std::function<void(std::string_view)> take_;
    std::string begun_;
};

/// Compares the rows of a JSON result that is being written (organs, groups) with those of one that
/// is stored, in their order, digit by digit. Neither needs to fit in memory.
class RowComparison {
  public:
    /// @param path  of the stored result; one whose rows do not stand on lines of their own
    /// (another program wrote it anew) has none
    explicit RowComparison(const std::string& path);

    /// More of the text of the result that is written.
    void add(std::string_view text) { written_.add(text); }

    /// Where they differ, in words: how many rows, and the first number; "" if nowhere, or if they
    /// have not as many rows (of other times). Numbers that one of them leaves out don't count. To
    /// be asked at the end.
    [[nodiscard]] std::string difference();

  private:
    /// "organ 3 'leaf', 2024-06-21T12:00: absorbed_flux.PAR: 1 there, 2 here".
    [[nodiscard]] std::string words_of(std::string_view there, std::string_view here) const;
    [[nodiscard]] bool next_stored(std::string& row);
    void compare(std::string_view line);

    std::ifstream stored_;
    LineSplitter written_;
    std::string when_;  // the latest time or date written
    std::string first_;
    std::size_t rows_ = 0, stored_rows_ = 0, differing_ = 0;
};

}  // namespace quasimc
