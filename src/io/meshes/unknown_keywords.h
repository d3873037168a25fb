#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "io/runfile/table_reader.h"

namespace quasimc {

/// Counts words that are not known where they stand: what is misspelled must not be passed over in
/// silence.
class UnknownKeywords {
  public:
    /// @param where  "line 5", "mesh 2"
    /// @param known  the words that may stand there
    void check(
        std::string_view word, std::string_view where, std::span<const std::string_view> known);
    /// Warns of them, if there were any. @param what  "objects that PlantGL does not know"
    void warn(std::string_view what, Reporter& reporter) const;

  private:
    std::size_t count_ = 0;
    std::string first_;
};

}  // namespace quasimc
