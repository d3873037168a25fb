#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace quasimc {

/// The tags of an XML text, one after the other, with their lines. Comments, processing
/// instructions and declarations are passed over; entities stay as they are (see xml_text).
/// Nothing is kept of what was read, so that a long file costs no more memory than a short one.
class XmlScanner {
  public:
    enum class Kind { open, close, end, broken };

    explicit XmlScanner(std::string_view text);

    /// Goes to the next tag. A tag that closes itself is told as two, open and close.
    Kind next();

    [[nodiscard]] std::string_view name() const { return name_; }
    /// An attribute of an opening tag, if it has that one.
    [[nodiscard]] std::optional<std::string_view> attribute(std::string_view key) const;
    /// All attributes of an opening tag.
    [[nodiscard]] const std::vector<std::pair<std::string_view, std::string_view>>& attributes()
        const {
        return attributes_;
    }
    /// What stands before the tag, after the tag before.
    [[nodiscard]] std::string_view text() const { return text_; }
    /// The line of the tag, from 1.
    [[nodiscard]] std::uint32_t line() const { return line_; }
    /// Where the tag begins and ends in the text (without its byte-order mark), in bytes. The
    /// second one of a tag that closes itself begins where it ends.
    [[nodiscard]] std::size_t tag_begin() const { return tag_begin_; }
    [[nodiscard]] std::size_t tag_end() const { return tag_end_; }
    /// Whether an opening tag closes itself.
    [[nodiscard]] bool closes_itself() const { return closes_itself_; }
    /// The line where the text before the tag starts.
    [[nodiscard]] std::uint32_t text_line() const { return text_line_; }
    /// After `broken`: what is wrong.
    [[nodiscard]] std::string_view problem() const { return problem_; }

  private:
    void pass(std::size_t count);
    bool pass_markup(std::string_view begin, std::string_view end);
    Kind read_tag(std::string_view tag);
    bool read_attributes(std::string_view rest);
    Kind fail(std::string_view problem);

    std::string_view rest_, name_, text_, problem_;
    std::size_t size_ = 0, tag_begin_ = 0, tag_end_ = 0;
    std::vector<std::pair<std::string_view, std::string_view>> attributes_;
    std::uint32_t line_ = 1, passed_ = 1, text_line_ = 1;
    bool closes_itself_ = false;
};

/// An XML text in UTF-8 if it is not, but says that it is in Latin-1 (ISO 8859-1, or Windows-1252
/// where that is the same); else nothing.
[[nodiscard]] std::optional<std::string> xml_from_latin1(std::string_view text);

/// A text with its five named entities (&amp; &lt; &gt; &quot; &apos;) replaced, without blanks at
/// its ends.
[[nodiscard]] std::string xml_text(std::string_view text);

}  // namespace quasimc
