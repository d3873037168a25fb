#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/notices.h"
#include "files/input_files.h"

namespace quasimc {

/// A line of a source file.
struct SourceLine {
    std::uint32_t file = 0;  ///< in PreprocessedText::files
    std::uint32_t line = 0;  ///< from 1
};

/// The text of a file after the preprocessor, and the source of each of its lines.
struct PreprocessedText {
    std::string text;
    std::vector<SourceLine> lines;
    std::vector<std::string> files;

    /// "file:line" of a line, from 0.
    [[nodiscard]] std::string where(std::size_t line) const;
};

/// Runs a traditional C preprocessor: comments, #define, #undef, #include, #if, #ifdef, #ifndef,
/// #elif, #else, #endif; newlines after a backslash are removed. Line breaks are kept, as they have
/// a meaning in models.
/// @param path  of the file, relative to the folder of `files`; included files are relative to the
///        file that names them
/// @throws InputError  with all faults: a missing file, a comment or call of a macro that is not
///         closed, a file that includes itself, more than 64 MiB of text
[[nodiscard]] PreprocessedText preprocess(
    const std::string& path, InputFiles& files, Notices& notices);

}  // namespace quasimc
