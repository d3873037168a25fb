#pragma once

#include <cstdio>
#include <memory>
#include <string_view>

#include "quasimc/error.h"

namespace quasimc {

/// Keeps text that is written later than it is made, in a temporary file without a name: it may be
/// longer than fits in memory.
class Spool {
  public:
    /// @throws InputError  if there is no room for it
    void add(std::string_view text);
    /// All of the text, in pieces. Nothing is added afterwards. @throws InputError
    void copy_to(const TextSink& sink);

  private:
    struct Closer {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::unique_ptr<std::FILE, Closer> file_;  // none before the first text
};

}  // namespace quasimc
