#pragma once

// Writing of JSON. Values are those of the library; long documents are composed of the texts of
// their parts, so that they need not fit in memory.

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "quasimc/error.h"

namespace quasimc {

/// A value whose members keep their order.
using Json = nlohmann::ordered_json;

/// The text of a value on one line; invalid UTF-8 is replaced.
[[nodiscard]] std::string json_text(const Json& value);

/// The text of an object with an additional member, given as JSON text.
[[nodiscard]] std::string json_text_with(
    const Json& object, std::string_view key, std::string_view value);

/// Appends the text of a value to the items of a list, with a comma.
void append_json(std::string& list, const Json& value);

/// Writes a long document: objects and lists with one member per line. The caller must give each
/// member of an object a key.
class JsonLines {
  public:
    explicit JsonLines(TextSink sink) : sink_(std::move(sink)) {}

    /// @param bracket  of the object or list that begins
    void begin(char bracket, std::string_view key = {});
    void end(char bracket);
    /// Writes a member given as JSON text, with its key if it needs one.
    void line(std::string_view json);
    /// Writes the members of an object, each on a line; nested ones are indented.
    void members(const Json& object);
    /// Writes a text.
    void text(std::string_view text);
    /// Sends the buffered text to the sink.
    void flush();

  private:
    void separate();

    TextSink sink_;
    std::string out_;
    bool is_begun_ = false;
    bool is_first_ = true;  // in its object or list
};

}  // namespace quasimc
