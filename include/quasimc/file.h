#pragma once

// Files that are read, and where text goes that is written.

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace quasimc {

/// A file that a run was made from.
struct InputFile {
    std::string path;      ///< as stated
    std::string resolved;  ///< absolute
    std::string sha256;    ///< of its bytes, 64 hexadecimal digits
    std::uint64_t bytes = 0;
    bool is_run_file = false;
};

/// Takes text in pieces.
using TextSink = std::function<void(std::string_view)>;

}  // namespace quasimc
