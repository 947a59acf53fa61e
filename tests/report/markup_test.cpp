#include "report/markup.h"

#include "report/example.h"
#include "report/markup_check.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace sward::report {
namespace {

using test::MarkupKind;
using test::markupProblem;

TEST(Markup, TheCheckerOfTheseTestsFindsWhatIsWrong) {
  EXPECT_EQ(markupProblem("<a b=\"c\">d &amp; e<f/></a>", MarkupKind::Xml), "");
  for (const char* wrong :
       {"<a>", "<a></b>", "</a>", "<a b=c/>", "<a b/>", "<a>&</a>", "<a>&nbsp;</a>", "<a>\x01</a>", "<a>\xff</a>",
        "<a>1 < 2</a>", "<a b=\"<\"/>", "<a b=\"", "<a", "<p id=\"x\"/><p id=\"x\"/>", "<a href=\"#none\"/>"}) {
    EXPECT_NE(markupProblem(wrong, MarkupKind::Xml), "") << wrong;
  }
  EXPECT_EQ(markupProblem("<!DOCTYPE html><p data-none>x<img alt=\"\"></p><script>1<2&&3</script>", MarkupKind::Html),
            "");
}

TEST(Markup, EscapesWhatMarkupReads) {
  EXPECT_EQ(escaped("a<b>&\"c\"'d'"), "a&lt;b&gt;&amp;&quot;c&quot;&#39;d&#39;");
  EXPECT_EQ(escaped("Gräser, 草, 🌱"), "Gräser, 草, 🌱");
  EXPECT_EQ(escaped(std::string_view("a\0b\x1f\x7f\t\n", 7)),
            "a\xef\xbf\xbd"
            "b\xef\xbf\xbd\x7f\t\n");
  const std::string text = "<p title=\"" + escaped(test::kHostile) + "\">" + escaped(test::kHostile) + "</p>";
  EXPECT_EQ(markupProblem(text, MarkupKind::Xml), "");
}

TEST(Markup, BytesThatAreNoUtf8BecomeReplacements) {
  const std::string bad = "\xef\xbf\xbd";
  EXPECT_EQ(escaped("\xff"), bad);
  EXPECT_EQ(escaped("\xc3"), bad);                      // cut short
  EXPECT_EQ(escaped("\xc0\xaf"), bad + bad);            // '/' in more bytes than it needs
  EXPECT_EQ(escaped("\xed\xa0\x80"), bad + bad + bad);  // a surrogate
  EXPECT_EQ(escaped("\xf4\x90\x80\x80"), bad + bad + bad + bad);
  EXPECT_EQ(escaped("\xef\xbf\xbf"), bad + bad + bad);  // U+FFFF, which XML does not have
  EXPECT_EQ(escaped("\xc3<"), bad + "&lt;");
}

TEST(Markup, Base64OfTheStandard) {
  const auto encoded = [](std::string_view text) { return base64(std::as_bytes(std::span(text.data(), text.size()))); };
  EXPECT_EQ(encoded(""), "");
  EXPECT_EQ(encoded("f"), "Zg==");
  EXPECT_EQ(encoded("fo"), "Zm8=");
  EXPECT_EQ(encoded("foo"), "Zm9v");
  EXPECT_EQ(encoded("foob"), "Zm9vYg==");
  EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
  EXPECT_EQ(encoded("\xff\xfe\xfd"), "//79");
}

TEST(Markup, FiguresHaveSensibleDigits) {
  EXPECT_EQ(figureText(0.0), "0");
  EXPECT_EQ(figureText(0.012345), "0.0123");
  EXPECT_EQ(figureText(0.09996), "0.100");
  EXPECT_EQ(figureText(35.16), "35.2");
  EXPECT_EQ(figureText(-1.5), "-1.50");
  EXPECT_EQ(figureText(1280.0), "1280");
  EXPECT_EQ(figureText(1234.5), "1234");
  EXPECT_EQ(figureText(2.1e-7), "2.1e-7");
  EXPECT_EQ(figureText(1e8), "1e8");
  EXPECT_EQ(figureText(std::nan("")), "not finite");
  EXPECT_EQ(figureText(std::numeric_limits<double>::max()), "1.8e308");
  EXPECT_EQ(fixedText(-0.0001, 2), "0.00");
  EXPECT_EQ(prefixedText(4552455.0), "4.55 M");
  EXPECT_EQ(prefixedText(999.7), "1.00 k");
  EXPECT_EQ(prefixedText(34.14), "34.1 ");
}

TEST(Markup, CountsCodePoints) {
  EXPECT_EQ(codePoints("Gräser"), 6u);
  EXPECT_EQ(codePoints("草🌱"), 2u);
}

}  // namespace
}  // namespace sward::report
