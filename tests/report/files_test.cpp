#include "report/csv.h"
#include "report/npy.h"
#include "report/report.h"

#include "report/example.h"

#include <cmath>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace sward::report {
namespace {

using Json = nlohmann::json;

TEST(Csv, QuotesWhatNeedsIt) {
  EXPECT_EQ(csvField("plain 1.5"), "plain 1.5");
  EXPECT_EQ(csvField(""), "");
  EXPECT_EQ(csvField("a,b"), "\"a,b\"");
  EXPECT_EQ(csvField("say \"so\""), "\"say \"\"so\"\"\"");
  EXPECT_EQ(csvField("two\nlines"), "\"two\nlines\"");
  EXPECT_EQ(csvField("cr\r"), "\"cr\r\"");
  EXPECT_EQ(csvField(" blank"), "\" blank\"");
  EXPECT_EQ(csvField("Gräser"), "Gräser");
}

TEST(Csv, NumbersReadBackAsTheyWere) {
  EXPECT_EQ(csvNumber(0.1), "0.1");
  EXPECT_EQ(csvNumber(-3.0), "-3");
  for (const double value : {1.0 / 3.0, 1e-300, 0.1 + 0.2, -std::numeric_limits<double>::max()}) {
    EXPECT_EQ(std::stod(csvNumber(value)), value);
  }
}

TEST(Csv, EveryRowHasEveryColumn) {
  const Table table{"t", {"a", "b,c", "d"}, {{"1", "2", "3"}, {"4"}, {}}};
  EXPECT_EQ(csvText(table), "a,\"b,c\",d\n1,2,3\n4,,\n,,\n");
  EXPECT_ANY_THROW(csvText({"t", {"a"}, {{"1", "2"}}}));
}

std::string header(const Array& array) {
  const auto bytes = npyBytes(array);
  return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size() - 4 * array.values.size());
}

TEST(Npy, HeaderIsExactlyThatOfTheFormat) {
  // As numpy.lib.format.write_array (NumPy 1.24) writes float32 arrays of these shapes.
  const std::string magic("\x93NUMPY\x01\x00\x76\x00", 10);
  const std::string matrix = "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }";
  EXPECT_EQ(header({"a", {2, 3}, std::vector<float>(6)}),
            magic + matrix + std::string(117 - matrix.size(), ' ') + "\n");
  const std::string vector = "{'descr': '<f4', 'fortran_order': False, 'shape': (5,), }";
  EXPECT_EQ(header({"a", {5}, std::vector<float>(5)}), magic + vector + std::string(117 - vector.size(), ' ') + "\n");
  const std::string scalar = "{'descr': '<f4', 'fortran_order': False, 'shape': (), }";
  EXPECT_EQ(header({"a", {}, {1.0f}}), magic + scalar + std::string(117 - scalar.size(), ' ') + "\n");
  const std::string none = "{'descr': '<f4', 'fortran_order': False, 'shape': (0, 4), }";
  EXPECT_EQ(header({"a", {0, 4}, {}}), magic + none + std::string(117 - none.size(), ' ') + "\n");
  // A long shape takes the next 64 bytes.
  EXPECT_EQ(header({"a", std::vector<std::size_t>(30, 1), {1.0f}}).size() % 64, 0u);
}

TEST(Npy, ValuesFollowInOrder) {
  const Array array{"a", {2, 2}, {0.5f, -1.0f, std::numeric_limits<float>::infinity(), 1e-40f}};
  const auto bytes = npyBytes(array);
  ASSERT_EQ(bytes.size(), 128u + 16u);
  EXPECT_EQ(std::memcmp(bytes.data() + 128, array.values.data(), 16), 0);
  EXPECT_ANY_THROW(npyBytes({"a", {2, 3}, {1.0f}}));
}

TEST(ReportJson, HasTheFormThatIsDocumented) {
  const Json json = Json::parse(reportJson(test::exampleHead(), test::exampleSections()));
  EXPECT_EQ(json["sward"], "0.0.test");
  EXPECT_EQ(json["project"], "fields/example.sward");
  EXPECT_EQ(json["machine"]["cores"], 2);
  EXPECT_EQ(json["machine"]["gl"]["renderer"], "llvmpipe");
  ASSERT_EQ(json["sections"].size(), 2u);
  EXPECT_EQ(json["sections"]["lpt_fit"].size(), 1u) << "rows alone";
  const Json& rows = json["sections"]["lpt_fit"]["rows"];
  ASSERT_EQ(rows.size(), 20u);
  EXPECT_EQ(rows[3]["method"], "lpt_paper");
  EXPECT_EQ(rows[3]["parameters"], Json::parse(R"({"lights": 32, "slices": 16, "sun": "all"})"));
  EXPECT_EQ(rows[3]["time_ms"]["runs"], 5);
  EXPECT_EQ(rows[3]["bytes"], 160 * 1024);
  EXPECT_DOUBLE_EQ(rows[3]["error"]["rmse"], 0.231);
  EXPECT_EQ(rows[3]["reference"], "32 held-out lights");
  EXPECT_TRUE(rows[3].contains("notes"));
  for (const char* absent : {"rate", "ratio", "against", "bake_s"}) EXPECT_FALSE(rows[3].contains(absent)) << absent;
  const Json& speed = json["sections"]["speed"]["rows"];
  EXPECT_EQ(speed[0]["parameters"]["rate_unit"], "rays");
  EXPECT_FALSE(speed[1].contains("error"));
}

TEST(ReportJson, LeavesOutWhatIsNotFiniteAndWhatFailed) {
  auto sections = test::exampleSections();
  sections[0].failure = "no plants";
  sections[1].rows.resize(1);
  sections[1].rows[0].error = {
      {"rmse", 0.25}, {"psnr_db", std::numeric_limits<double>::infinity()}, {"x", std::nan("")}};
  sections[1].rows[0].ratio = std::nan("");
  const Json json = Json::parse(reportJson(test::exampleHead(), sections));
  EXPECT_FALSE(json["sections"].contains("speed"));
  const Json& row = json["sections"]["lpt_fit"]["rows"][0];
  EXPECT_EQ(row["error"], Json::parse(R"({"rmse": 0.25})"));
  EXPECT_FALSE(row.contains("ratio"));
}

TEST(ReportJson, HoldsAnyText) {
  const Json json = Json::parse(reportJson(test::exampleHead(), test::hostileSections()));
  const std::string method = json["sections"]["speed"]["rows"][0]["method"];
  EXPECT_EQ(method.substr(0, 30), std::string(test::kHostile).substr(0, 30));
}

}  // namespace
}  // namespace sward::report
