#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "base/notices.h"
#include "base/range.h"
#include "files/input_files.h"
#include "growth/language/preprocessor.h"
#include "quasimc/mesh.h"
#include "text/line_scanner.h"

namespace quasimc {

// Limits of view files and of the files that they name.
inline constexpr double kMaxViewNumber = 1e30;    ///< largest magnitude of a number
inline constexpr int kMaxControlPoints = 10'000;  ///< in a function, curve or contour
inline constexpr int kMaxViewSamples = 10'000;    ///< in a function or curve
inline constexpr int kMaxFunctionsOfSet = 1000;   ///< in a file "function set:"
inline constexpr int kMaxPatchDivisions = 200;    ///< in one direction
inline constexpr std::size_t kMaxSurfaceTriangles = 500'000;
inline constexpr std::size_t kMaxViewFaults = 100;  ///< later faults are not reported

/// Separators of the values of view files.
inline constexpr Separators kBetweenViewValues = " \t\r\v\f,";

/// A file that a view file names.
struct NamedFile {
    std::string path, text;
};

/// The lines of a view file, or of a file that it names, without blank ones; and the words of each
/// line, from left to right. Its errors name the line.
class ViewLines {
  public:
    /// @param file  outlives it
    explicit ViewLines(const NamedFile& file) : scanner_(file.text), named_(&file) {}
    /// @param view_file  outlives it
    explicit ViewLines(const PreprocessedText& view_file)
        : scanner_(view_file.text), view_file_(&view_file) {}

    /// Goes to the next line; false at the end.
    bool next();
    /// Goes to the next line. @throws InputError  at the end; the text says what is expected
    void need(std::string_view expected);
    /// The line, without blanks around it.
    [[nodiscard]] std::string_view line() const { return line_; }

    /// Reads up to the next colon: lower case, one blank between words. Nothing without a colon.
    std::optional<std::string> take_label();
    /// Changes the separators of words, from here on.
    void separate_at(const Separators& separators) { separators_ = separators; }
    /// Reads the next word; "" at the end of the line.
    std::string_view word() { return take_word(rest_, separators_); }
    /// The next word, which remains unread.
    [[nodiscard]] std::string_view ahead() const { return ViewLines(*this).word(); }
    [[nodiscard]] bool has_word() const { return !ahead().empty(); }
    /// Ignores the rest of the line.
    void skip_words() { rest_ = {}; }

    /// Reads the next word as a number. @throws InputError
    double number(std::string_view what) { return parsed(word(), what); }
    /// Reads the next word as an integer. @param range  within that of int. @throws InputError
    int integer(std::string_view what, Range range) {
        return static_cast<int>(parsed(word(), what, range, true));
    }
    /// Reads three numbers. @throws InputError
    Vec3 vector(std::string_view what);
    /// A word as a number. @throws InputError
    [[nodiscard]] double parsed(
        std::string_view word,
        std::string_view what,
        Range range = {-kMaxViewNumber, kMaxViewNumber},
        bool is_integer = false) const;

    /// The path of the file of this line.
    [[nodiscard]] const std::string& path() const;
    /// "file:line".
    [[nodiscard]] std::string where() const;
    /// Throws an InputError for this line.
    [[noreturn]] void fail(
        std::string problem, std::string why = {}, std::string suggestion = {}) const;

  private:
    [[nodiscard]] SourceLine source() const;

    LineScanner scanner_;
    const NamedFile* named_ = nullptr;  // or:
    const PreprocessedText* view_file_ = nullptr;
    Separators separators_ = kBetweenViewValues;
    std::string_view line_, rest_;
};

/// A view file, with access to the files that it names.
class ViewFile : public ViewLines {
  public:
    /// @param text, files, notices  outlive it
    ViewFile(const PreprocessedText& text, InputFiles& files, Notices& notices)
        : ViewLines(text), files_(files), notices_(notices) {}

    /// Reads the file that the next word names, relative to the folder of this file. Nothing if it
    /// can't be read; then a notice says that `what` is ignored, and the line is.
    /// @throws InputError  if there is no name
    std::optional<NamedFile> named_file(const std::string& what);
    /// Sends a notice about this line.
    void warn(const std::string& text) { notices_.once(where() + ": " + text); }
    [[nodiscard]] Notices& notices() const { return notices_; }

  private:
    InputFiles& files_;
    Notices& notices_;
};

}  // namespace quasimc
