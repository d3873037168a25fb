#include "io/xml_scanner.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "base/text.h"
#include "io/line_scanner.h"

namespace quasimc {
namespace {

constexpr std::string_view kXmlBlanks = " \t\r\n";

bool is_xml_name(std::string_view name) {
    return !name.empty() && name.find_first_of("<>&'\"=/") == std::string_view::npos;
}

}  // namespace

XmlScanner::XmlScanner(std::string_view text) : rest_(without_bom(text)), size_(rest_.size()) {}

void XmlScanner::pass(std::size_t count) {
    const std::string_view passed = rest_.substr(0, count);
    passed_ += static_cast<std::uint32_t>(std::count(passed.begin(), passed.end(), '\n'));
    rest_.remove_prefix(count);
}

/// Passes over what begins and ends so; false if the text does not begin so, or does not end.
bool XmlScanner::pass_markup(std::string_view begin, std::string_view end) {
    if (!rest_.starts_with(begin)) {
        return false;
    }
    const std::size_t at = rest_.find(end, begin.size());
    if (at != std::string_view::npos) {
        pass(at + end.size());
    }
    return at != std::string_view::npos;
}

XmlScanner::Kind XmlScanner::fail(std::string_view problem) {
    line_ = passed_;
    problem_ = problem;
    return Kind::broken;
}

XmlScanner::Kind XmlScanner::next() {
    text_ = {};
    if (closes_itself_) {
        closes_itself_ = false;
        tag_begin_ = tag_end_;
        return Kind::close;
    }
    text_line_ = passed_;
    while (true) {
        const std::size_t at = rest_.find('<');
        if (at == std::string_view::npos) {
            pass(rest_.size());
            line_ = passed_;
            return Kind::end;
        }
        text_ = rest_.substr(0, at);
        pass(at);
        line_ = passed_;
        if (pass_markup("<!--", "-->") || pass_markup("<?", "?>") || pass_markup("<!", ">")) {
            continue;
        }
        const std::size_t end = rest_.find('>');
        if (end == std::string_view::npos) {
            return fail("a tag does not end");
        }
        const std::string_view tag = rest_.substr(1, end - 1);
        tag_begin_ = size_ - rest_.size();
        pass(end + 1);
        tag_end_ = size_ - rest_.size();
        return read_tag(tag);
    }
}

XmlScanner::Kind XmlScanner::read_tag(std::string_view tag) {
    attributes_.clear();
    const bool is_close = tag.starts_with('/');
    closes_itself_ = tag.ends_with('/') && !is_close;
    tag = tag.substr(is_close ? 1 : 0);
    tag = tag.substr(0, tag.size() - (closes_itself_ ? 1 : 0));
    name_ = tag.substr(0, tag.find_first_of(kXmlBlanks));
    if (!is_xml_name(name_)) {
        return fail("a tag without a name");
    }
    if (!is_close && !read_attributes(tag.substr(name_.size()))) {
        return fail("a tag with an attribute that is not name=\"value\"");
    }
    return is_close ? Kind::close : Kind::open;
}

bool XmlScanner::read_attributes(std::string_view rest) {
    while (true) {
        rest = trimmed(rest);
        if (rest.empty()) {
            return true;
        }
        const std::size_t equal = rest.find('=');
        if (equal == std::string_view::npos) {
            return false;
        }
        const std::string_view key = trimmed(rest.substr(0, equal));
        rest = trimmed(rest.substr(equal + 1));
        const char quote = rest.empty() ? ' ' : rest.front();
        const std::size_t end = rest.find(quote, 1);
        if ((quote != '"' && quote != '\'') || end == std::string_view::npos || !is_xml_name(key)) {
            return false;
        }
        attributes_.emplace_back(key, rest.substr(1, end - 1));
        rest.remove_prefix(end + 1);
    }
}

std::optional<std::string_view> XmlScanner::attribute(std::string_view key) const {
    for (const auto& [name, value] : attributes_) {
        if (name == key) {
            return value;
        }
    }
    return std::nullopt;
}

std::optional<std::string> xml_from_latin1(std::string_view text) {
    constexpr std::array<std::string_view, 5> kLatin1{
        "iso-8859-1", "iso_8859-1", "latin1", "latin-1", "windows-1252"};
    const std::string_view head = text.substr(0, text.find("?>"));
    const std::size_t at = head.find("encoding");
    if (!head.starts_with("<?xml") || at == std::string_view::npos || is_utf8(text)) {
        return std::nullopt;
    }
    const std::size_t begin = std::min(head.find_first_of("\"'", at), head.size() - 1) + 1;
    std::string name(head.substr(begin, head.find_first_of("\"'", begin) - begin));
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) {
        return static_cast<char>(std::tolower(c));
    });
    const bool has_other = std::any_of(text.begin(), text.end(), [](unsigned char c) {
        return c >= 0x80 && c < 0xA0;  // Windows-1252 has letters there, Latin-1 control characters
    });
    if (has_other || std::find(kLatin1.begin(), kLatin1.end(), name) == kLatin1.end()) {
        return std::nullopt;
    }
    std::string recoded;
    for (const unsigned char c : text) {
        if (c < 0x80) {
            recoded += static_cast<char>(c);
        } else {
            recoded += static_cast<char>(0xC0 | (c >> 6));
            recoded += static_cast<char>(0x80 | (c & 0x3F));
        }
    }
    return recoded;
}

std::string xml_text(std::string_view text) {
    constexpr std::array<std::pair<std::string_view, char>, 5> kEntities{
        {{"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}}};
    text = trimmed(text);
    std::string plain;
    while (!text.empty()) {
        const auto found = std::find_if(
            kEntities.begin(), kEntities.end(),
            [&](const auto& entity) { return text.starts_with(entity.first); });
        plain += found == kEntities.end() ? text.front() : found->second;
        text.remove_prefix(found == kEntities.end() ? 1 : found->first.size());
    }
    return plain;
}

}  // namespace quasimc
