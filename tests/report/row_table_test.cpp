#include "report/row_table.h"

#include "report/example.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sward::report {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

std::vector<std::string> names(const RowTable& table) {
  std::vector<std::string> out;
  for (const TableColumn& column : table.columns) {
    out.push_back(column.name + (column.unit.empty() ? "" : " " + column.unit));
  }
  return out;
}

const TableColumn& column(const RowTable& table, const std::string& name) {
  for (const TableColumn& candidate : table.columns) {
    if (candidate.name == name) return candidate;
  }
  throw std::runtime_error("no column " + name);
}

TEST(RowTable, OnlyColumnsThatSomeRowHas) {
  const auto tables = rowTables(test::exampleSections()[1].rows);
  ASSERT_EQ(tables.size(), 1u) << "a parameter more does not part a method from those it is compared with";
  EXPECT_THAT(names(tables[0]), ElementsAre("method", "sun", "parameters", "time ms", "spread", "light data KiB",
                                            "total MiB", "RMSE", "PSNR dB", "bias", "max error"));
  EXPECT_THAT(tables[0].alike,
              ElementsAre(Pair("lights", "32"), Pair("slices", "16"), Pair("reference", "32 held-out lights")));
  EXPECT_EQ(column(tables[0], "parameters").cells[9].text, "voxels 64");
  EXPECT_TRUE(column(tables[0], "parameters").cells[0].text.empty());
  EXPECT_EQ(column(tables[0], "method").cells[3].notes, std::vector<std::size_t>{0});
  EXPECT_THAT(tables[0].notes, ElementsAre(HasSubstr("no ridge")));
}

TEST(RowTable, NumbersOfAColumnLineUp) {
  const auto tables = rowTables(test::exampleSections()[1].rows);
  const TableColumn& rmse = column(tables[0], "RMSE");
  EXPECT_EQ(rmse.cells[0].text, "0.195");
  EXPECT_EQ(rmse.cells[9].text, "0.104");
  EXPECT_DOUBLE_EQ(*rmse.cells[9].number, 0.104);
  EXPECT_EQ(column(tables[0], "light data").cells[0].text, "256");
  EXPECT_EQ(column(tables[0], "light data").cells[0].hint, "262144 bytes");
  EXPECT_EQ(column(tables[0], "time").cells[9].text, "41.00");
  EXPECT_EQ(column(tables[0], "spread").cells[9].text, "38.9 – 49.2");
}

TEST(RowTable, ValuesTooSmallForTheColumnKeepTheirDigits) {
  std::vector<Row> rows(4);
  const double values[] = {1.25, 2.5, 3.75, 1e-9};
  for (std::size_t i = 0; i < 4; ++i) rows[i].error = {{"bias", values[i]}};
  EXPECT_EQ(column(rowTables(rows)[0], "bias").cells[3].text, "1e-9");
  EXPECT_EQ(column(rowTables(rows)[0], "bias").cells[0].text, "1.25");
}

Row storageRow(int bits) {
  Row row;
  row.method = "storage";
  row.numbersAndNames = {{"bits", std::to_string(bits)}, {"basis", "\"ptm\""}, {"texture_bytes", "3145728"}};
  row.bytes = 1;
  return row;
}

TEST(RowTable, UnlikeRowsComeInTablesOfTheirOwn) {
  std::vector<Row> rows = test::exampleSections()[0].rows;
  for (const int bits : {8, 16, 32}) rows.push_back(storageRow(bits));
  Row march;
  march.rate = 12.0;
  march.rateUnit = "frames";
  march.numbersAndNames = {{"slant_deg", "90"}, {"distance_m", "3.5"}};
  for (const char* method : {"march_down", "march_45", "march_grazing"}) {
    march.method = method;
    rows.push_back(march);
  }
  const auto tables = rowTables(rows);
  ASSERT_EQ(tables.size(), 3u);
  EXPECT_EQ(tables[0].columns[0].cells.size(), 2u);
  EXPECT_EQ(tables[0].title, "");
  EXPECT_EQ(tables[1].title, "Storage");
  EXPECT_THAT(names(tables[1]), ElementsAre("method", "bits", "light data bytes"));
  EXPECT_THAT(tables[1].alike, ElementsAre(Pair("basis", "ptm"), Pair("texture", "3145728 bytes")));
  EXPECT_EQ(tables[2].title, "March");
  EXPECT_THAT(tables[2].alike, ElementsAre(Pair("distance", "3.500 m"), Pair("slant", "90 °")));
}

TEST(RowTable, LongAndRareParametersShareAColumn) {
  std::vector<Row> rows(3);
  for (std::size_t i = 0; i < 3; ++i) {
    rows[i].numbersAndNames = {{"histogram", "[1,2,3,4,5,6,7,8,9,10,11,12,13,14,15," + std::to_string(i) + "]"},
                               {"on", i == 0 ? "true" : "false"}};
  }
  rows[0].numbersAndNames["rare_ms"] = "1.5";
  const auto tables = rowTables(rows);
  ASSERT_EQ(tables.size(), 1u);
  EXPECT_THAT(names(tables[0]), ElementsAre("method", "on", "parameters"));
  EXPECT_THAT(column(tables[0], "parameters").cells[0].text, HasSubstr("12,13,14,15,0], rare 1.500 ms"));
  EXPECT_EQ(column(tables[0], "on").cells[0].text, "yes");
}

TEST(RowTable, RatiosSayAgainstWhat) {
  std::vector<Row> rows(3);
  for (Row& row : rows) {
    row.ratio = 2.0;
    row.against = "a bare loop";
  }
  EXPECT_THAT(rowTables(rows)[0].alike, ElementsAre(Pair("ratio against", "a bare loop")));
  rows[1].against = "a limit";
  const auto tables = rowTables(rows);
  EXPECT_THAT(tables[0].notes, ElementsAre("Ratio against a bare loop", "Ratio against a limit"));
  EXPECT_EQ(column(tables[0], "ratio").cells[2].notes, std::vector<std::size_t>{0});
}

TEST(RowTable, NoRowsNoTable) {
  EXPECT_TRUE(rowTables({}).empty());
}

TEST(RowTable, NamesSayTheirUnits) {
  EXPECT_THAT(nameAndUnit("sparse_ms"), Pair("sparse", "ms"));
  EXPECT_THAT(nameAndUnit("sun_elevation_deg"), Pair("sun elevation", "°"));
  EXPECT_THAT(nameAndUnit("psnr_db"), Pair("psnr", "dB"));
  EXPECT_THAT(nameAndUnit("slices"), Pair("slices", ""));
  EXPECT_THAT(nameAndUnit("_s"), Pair(" s", ""));
}

}  // namespace
}  // namespace sward::report
