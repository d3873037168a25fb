#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "quasimc/file.h"

namespace quasimc {

/// How the values of an object or a list stand.
enum class JsonLayout {
    rows,     ///< each on a line of its own
    pretty,   ///< so, and indented
    spaced,   ///< on one line, a blank after ':' and ','
    compact,  ///< on one line, without blanks
};

/// Writes JSON piece by piece: no document need fit in memory. The caller sees to it that every
/// value of an object has a key.
class JsonStream {
  public:
    /// @param sink  takes the text in pieces; without one it is kept for take()
    explicit JsonStream(TextSink sink = {}) : sink_(std::move(sink)) {}

    void begin_object(JsonLayout layout) { begin('{', layout); }
    void end_object() { end('}'); }
    void begin_list(JsonLayout layout) { begin('[', layout); }
    void end_list() { end(']'); }
    /// Of the next value.
    void key(std::string_view name);
    /// The same of a name that quoted() gave.
    void quoted_key(std::string_view name);

    void text(std::string_view value);
    void boolean(bool value) { raw(value ? "true" : "false"); }
    void integer(std::int64_t value);
    void count(std::uint64_t value);
    void null() { raw("null"); }
    /// The shortest text; null if it is not finite.
    void number(double value);
    /// The same with a point or an exponent, so that a reader who tells integers from other numbers
    /// does not take it for an integer: "1.0".
    void real(double value);
    // The same with a key.
    void text(std::string_view name, std::string_view value) {
        key(name);
        text(value);
    }
    void boolean(std::string_view name, bool value) {
        key(name);
        boolean(value);
    }
    void count(std::string_view name, std::uint64_t value) {
        key(name);
        count(value);
    }
    void number(std::string_view name, double value) {
        key(name);
        number(value);
    }
    void real(std::string_view name, double value) {
        key(name);
        real(value);
    }

    /// A value that is JSON already.
    void raw(std::string_view json);
    /// More of the text of that value.
    void raw_continued(std::string_view json);
    /// Gives the sink all that was written.
    void flush();

    /// What was written, of a stream without a sink; the stream is then empty.
    [[nodiscard]] std::string take();

    /// A text as JSON; what is no UTF-8 is replaced.
    [[nodiscard]] static std::string quoted(std::string_view text);

  private:
    struct Level {
        JsonLayout layout;
        bool is_empty = true;
    };

    void begin(char bracket, JsonLayout layout);
    void end(char bracket);
    void separate();
    void break_line();
    void flush_when_long();

    TextSink sink_;
    std::string out_;
    std::vector<Level> levels_;
    std::size_t indent_ = 0;  // of the values of the innermost pretty level
    bool has_key_ = false;    // the next value follows its key
};

}  // namespace quasimc
