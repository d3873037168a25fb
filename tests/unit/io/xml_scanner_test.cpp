#include "io/xml_scanner.h"

#include <gtest/gtest.h>

namespace quasimc::test {
namespace {

using Kind = XmlScanner::Kind;

TEST(XmlScanner, GoesFromTagToTag) {
    XmlScanner xml("<?xml version='1.0'?>\n<!-- a <b> -->\n<a x = 'one' y=\"2\">t\nu<b/>v</a>\n");
    ASSERT_EQ(xml.next(), Kind::open);
    EXPECT_EQ(xml.name(), "a");
    EXPECT_EQ(xml.line(), 3U);
    EXPECT_EQ(xml.attribute("x"), "one");
    EXPECT_EQ(xml.attribute("y"), "2");
    EXPECT_EQ(xml.attribute("z"), std::nullopt);
    ASSERT_EQ(xml.next(), Kind::open);
    EXPECT_EQ(xml.name(), "b");
    EXPECT_EQ(xml.text(), "t\nu");
    EXPECT_EQ(xml.text_line(), 3U);
    EXPECT_EQ(xml.line(), 4U);
    ASSERT_EQ(xml.next(), Kind::close);
    EXPECT_EQ(xml.name(), "b");
    ASSERT_EQ(xml.next(), Kind::close);
    EXPECT_EQ(xml.name(), "a");
    EXPECT_EQ(xml.text(), "v");
    EXPECT_EQ(xml.next(), Kind::end);
}

TEST(XmlScanner, TellsWhatIsBroken) {
    for (const char* text : {"<", "<a", "< a>", "<>", "<a b>", "<a b=c>", "<a b='c>", "<!-- a"}) {
        EXPECT_EQ(XmlScanner(text).next(), Kind::broken) << text;
    }
}

TEST(XmlText, ReplacesEntities) {
    EXPECT_EQ(xml_text(" \n&lt;a&gt; &amp;lt; &quot;&apos; &x;"), "<a> &lt; \"' &x;");
}

TEST(XmlScanner, TellsWhereTagsStand) {
    const std::string text = "\xEF\xBB\xBF<a>x <!-- <c> --><b k=\"1\"/></a>";
    const std::string plain = text.substr(3);
    XmlScanner scanner(text);
    std::vector<std::string> tags;
    for (auto kind = scanner.next(); kind != XmlScanner::Kind::end; kind = scanner.next()) {
        tags.push_back(plain.substr(scanner.tag_begin(), scanner.tag_end() - scanner.tag_begin()));
    }
    EXPECT_EQ(tags, (std::vector<std::string>{"<a>", "<b k=\"1\"/>", "", "</a>"}));
}

}  // namespace
}  // namespace quasimc::test
