#pragma once

#include <cstdio>
#include <memory>
#include <string_view>

#include "quasimc/error.h"

namespace quasimc {

/// Buffers text in a temporary file without a name, as it may exceed the memory.
class Spool {
  public:
    /// @throws InputError  if the disk is full
    void add(std::string_view text);
    /// Sends all of the text, in pieces. Must be the last call. @throws InputError
    void copy_to(const TextSink& sink);

  private:
    struct Closer {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::unique_ptr<std::FILE, Closer> file_;  // none before the first text
};

}  // namespace quasimc
