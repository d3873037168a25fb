#pragma once

// JSON that is written: values are those of the library, long documents are put together from the
// texts of their parts, so that none need fit in memory.

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "quasimc/error.h"

namespace quasimc {

/// A value whose members keep their order.
using Json = nlohmann::ordered_json;

/// The text of a value, on one line; what is no UTF-8 in it is replaced.
[[nodiscard]] std::string json_text(const Json& value);

/// The text of an object with one more member, whose text is JSON already.
[[nodiscard]] std::string json_text_with(
    const Json& object, std::string_view key, std::string_view value);

/// Adds the text of a value to those of a list, with a comma between.
void append_json(std::string& list, const Json& value);

/// Writes a long document: objects and lists whose members stand on lines of their own. The caller
/// sees to it that each member of an object has a key.
class JsonLines {
  public:
    explicit JsonLines(TextSink sink) : sink_(std::move(sink)) {}

    /// @param bracket  of the object or list that begins, as a member
    void begin(char bracket, std::string_view key = {});
    void end(char bracket);
    /// A member that is JSON already, with its key if it needs one.
    void line(std::string_view json);
    /// Members, each on a line; what they hold is indented.
    void members(const Json& object);
    /// Text that follows what was written.
    void text(std::string_view text);
    /// Gives the sink all that was written.
    void flush();

  private:
    void separate();

    TextSink sink_;
    std::string out_;
    bool is_begun_ = false;
    bool is_first_ = true;  // of its object or list
};

}  // namespace quasimc
