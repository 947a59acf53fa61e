#include "report/page.h"

#include "report/embed.h"
#include "report/example.h"
#include "report/markup_check.h"
#include "report/page_table.h"
#include "report/row_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

namespace sward::report {
namespace {

using testing::HasSubstr;
using testing::Not;

std::map<std::string, PagePicture> allPictures(const std::vector<Section>& sections) {
  std::map<std::string, PagePicture> pictures;
  for (const Section& section : sections)
    for (const Strip& strip : section.strips)
      for (const Picture& picture : strip.pictures) pictures[picture.name] = {"data:image/png;base64,AAAA", 750, 120};
  return pictures;
}

std::string pageOf(const std::vector<Section>& sections, const ReportHead& head = test::exampleHead()) {
  return pageHtml(head, sections, SeriesLooks(sections), allPictures(sections));
}

TEST(Page, IsWellFormedAndWhole) {
  const std::string page = pageOf(test::exampleSections());
  EXPECT_EQ(test::markupProblem(page, test::MarkupKind::Html), "");
  for (const char* part :
       {"<h1>Example: speed against error</h1>", "id=\"speed\"", "id=\"lpt_fit\"", "href=\"#lpt_fit\"",
        "A second paragraph", "<code>sward report fields/example.sward <span class=\"word\">-o</span> report</code>",
        "0.0.test", "llvmpipe", "lpt_fit 12.2", "in all 48.8", "Lower left is better", "Low suns are harder",
        "pictures/fit_lpt8.exr", "tables/lpt_fit_truth_0.npy", "2 × 3", "prefers-color-scheme"}) {
    EXPECT_THAT(page, HasSubstr(part));
  }
  EXPECT_THAT(page, Not(HasSubstr("pictures/fit_difference.exr"))) << "there is none";
  EXPECT_EQ(page, pageOf(test::exampleSections())) << "the same report, the same bytes";
}

TEST(Page, NeedsNothingFromElsewhere) {
  const std::string page = pageOf(test::exampleSections());
  EXPECT_FALSE(std::regex_search(page, std::regex("(src|href)=\"(https?:)?//"))) << "no addresses of other places";
  EXPECT_FALSE(std::regex_search(page, std::regex("src=\"(?!data:image/png;base64,)")));
  EXPECT_THAT(page, Not(HasSubstr("@import")));
  EXPECT_THAT(page, Not(HasSubstr("url(")));
}

TEST(Page, NoTextBecomesMarkup) {
  ReportHead head = test::exampleHead();
  head.version = head.project = head.title = head.commandLine = test::kHostile;
  head.machine.cpu = head.machine.device.renderer = test::kHostile;
  head.settings = {{test::kHostile, test::kHostile}};
  auto sections = test::hostileSections();
  sections.push_back(sections[0]);
  sections.back().name = "failed";
  sections.back().failure = test::kHostile;
  const std::string page = pageOf(sections, head);
  EXPECT_EQ(test::markupProblem(page, test::MarkupKind::Html), "");
  EXPECT_THAT(page, Not(HasSubstr("<b>\"")));
  // The only script that ends is the page's own.
  EXPECT_EQ(page.find("</script>"), page.rfind("</script>"));
  EXPECT_THAT(page, HasSubstr("Gräser"));
  EXPECT_THAT(page, HasSubstr("could not be measured"));
}

TEST(Page, AReportWithoutSectionsIsAPage) {
  EXPECT_EQ(test::markupProblem(pageOf({}), test::MarkupKind::Html), "");
}

TEST(Page, CellsHoldWhatIsSortedBy) {
  std::vector<Row> rows(3);
  rows[0].method = "a";
  rows[0].error = {{"rmse", 0.123456789012345}};
  rows[1].method = "b_c";
  rows[1].error = {{"rmse", -2.0}};
  rows[2].method = "d";
  rows[2].notes = "why";
  const std::string html = tableHtml(rowTables(rows)[0], "x", [](const std::string&) { return ""; });
  EXPECT_EQ(test::markupProblem(html, test::MarkupKind::Html), "");
  EXPECT_THAT(html, HasSubstr("data-value=\"0.123456789012345\"")) << "not the rounded one";
  EXPECT_THAT(html, HasSubstr("data-value=\"-2\""));
  EXPECT_THAT(html, HasSubstr("class=\"none number\" data-none>–</td>"));
  EXPECT_THAT(html, HasSubstr("<th scope=\"row\" class=\"text\">b_c</th>"));
  EXPECT_THAT(html, HasSubstr("id=\"x-note-1\">why"));
}

TEST(Page, RowsLeadToTheirPictures) {
  auto sections = test::exampleSections();
  for (Row& row : sections[1].rows) row.numbersAndNames["picture"] = "\"fit_lpt8\"";
  sections[1].rows[0].numbersAndNames["picture"] = "\"elsewhere\"";
  const std::string page = pageOf(sections);
  EXPECT_EQ(test::markupProblem(page, test::MarkupKind::Html), "");
  EXPECT_THAT(page, HasSubstr("<a href=\"#picture-fit_lpt8\">fit_lpt8</a>"));
  EXPECT_THAT(page, HasSubstr(">elsewhere<"));
}

TEST(Embed, ShrinksAsLightAddsUp) {
  image::Image checker(4, 5, 3);
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 4; ++x)
      for (int c = 0; c < 3; ++c) checker.at(x, y, c) = (x + y) % 2 == 0 ? 1.0f : 0.0f;
  const image::Image half = shrunk(checker, 2);
  ASSERT_EQ(half.width, 2);
  ASSERT_EQ(half.height, 2);
  // Half of white's light is sRGB 188 / 255 (IEC 61966-2-1), not 128.
  EXPECT_NEAR(half.at(1, 1, 2), 0.7354f, 1e-4f);
  EXPECT_EQ(shrunk(checker, 1).pixels, checker.pixels);
}

}  // namespace
}  // namespace sward::report
