#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "resultio/read_rows.h"
#include "runfile/run_file.h"
#include "text/json.h"
#include "window/window_data.h"
#include "window/window_organs.h"
#include "window/window_parts.h"

namespace quasimc {

/// The query for all columns of a run, at its point of a sweep.
[[nodiscard]] RowsQuery window_query(const RunFile& run, const std::vector<WindowColumn>& columns);

/// A result that is subtracted from another one. Times are matched by their labels, organs by their
/// ids. Errors are those of independent results: the root of the sum of both variances.
class WindowDifference {
  public:
    /// @param organs   organs and sensors of the first result
    /// @param columns  the columns of the first result
    /// @throws InputError  if no organ is in both results
    WindowDifference(
        const WindowOrgans& organs,
        const std::vector<WindowColumn>& columns,
        const ReadResult& minus);

    /// The first result minus the other one; unknown for organs that the latter lacks, empty
    /// columns where it has no such time or column. @param first  columns of the first result
    [[nodiscard]] RowColumns of(const RowsPosition& position, const RowColumns& first) const;

    /// Its title, the other result without its organs (`head`), a sentence on errors, and the
    /// numbers of organs that only one result has.
    [[nodiscard]] Json json() const;

  private:
    std::string title_;
    Node head_;
    std::vector<std::size_t> index_;  ///< [organ]: its index in the other result, or kNone
    std::size_t only_first_ = 0, only_other_ = 0;
    std::map<std::pair<std::string, std::string>, RowColumns> others_;  ///< by part and label
};

}  // namespace quasimc
