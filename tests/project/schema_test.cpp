#include "project/field_list.h"
#include "project/project.h"

#include "base/file.h"

#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sward::project {
namespace {

/// A column of 150 pixels holds some 21 letters of the editor's font at its usual size.
constexpr std::size_t kLabelLetters = 20;
/// A tooltip is read while the pointer rests.
constexpr std::size_t kHelpLetters = 180;

void expectLabel(const std::string& label, const std::string& where) {
  ASSERT_FALSE(label.empty()) << where << " has no label";
  EXPECT_LE(label.size(), kLabelLetters) << where << ": \"" << label << "\"";
  EXPECT_TRUE(std::isupper(static_cast<unsigned char>(label.front()))) << where << ": \"" << label << "\"";
  EXPECT_TRUE(std::isalnum(static_cast<unsigned char>(label.back())) || label.back() == ')') << where << ": " << label;
}

void expectHelp(const std::string& help, const std::string& where) {
  ASSERT_FALSE(help.empty()) << where << " has no help";
  EXPECT_LE(help.size(), kHelpLetters) << where << ": \"" << help << "\"";
  EXPECT_TRUE(std::isupper(static_cast<unsigned char>(help.front())) ||
              std::isdigit(static_cast<unsigned char>(help.front())))
      << where << ": \"" << help << "\"";
  EXPECT_EQ(help.back(), '.') << where << ": \"" << help << "\"";
  EXPECT_EQ(help.find("  "), std::string::npos) << where << ": \"" << help << "\"";
}

bool isNumeric(const FieldInfo& field) {
  return field.kind == FieldKind::Whole || field.kind == FieldKind::Number || field.kind == FieldKind::Vector;
}

bool hasRange(const Spec& spec) {
  return spec.low > Spec::kLowest && spec.high < Spec::kHighest;
}

/// Every number of a default value.
std::vector<double> numbersIn(const std::string& json) {
  std::vector<double> numbers;
  for (const char* at = json.c_str(); *at != '\0';) {
    char* end = nullptr;
    const double value = std::strtod(at, &end);
    if (end == at) {
      ++at;
    } else {
      numbers.push_back(value);
      at = end;
    }
  }
  return numbers;
}

TEST(Schema, TheListHoldsFieldsOfEveryStruct) {
  std::set<std::string> paths;
  for (const FieldInfo& field : fieldList()) {
    EXPECT_TRUE(paths.insert(field.path).second) << field.path << " stands twice";
  }
  for (const char* path : {"version", "patch.plants[].grass.heightM", "patch.plants[].flower.optics.translucency",
                           "patch.plants[].gltf.material.alphaCutoff", "lights.directions[].elevationDeg",
                           "sun.moment.hourUtc", "tiles.map", "views[].focalLengthMm", "output.height"}) {
    EXPECT_TRUE(paths.contains(path)) << path;
  }
  EXPECT_GT(paths.size(), 140u);
}

TEST(Schema, EveryFieldHasALabelAndHelp) {
  std::map<std::string, std::set<std::string>> labels;
  for (const FieldInfo& field : fieldList()) {
    expectLabel(field.spec.label, field.path);
    expectHelp(field.spec.help, field.path);
    EXPECT_TRUE(labels[field.owner].insert(field.spec.label).second)
        << field.path << ": another field of " << field.owner << " is called \"" << field.spec.label << "\" too";
  }
}

TEST(Schema, EveryWordHasALabelAndHelp) {
  int count = 0;
  for (const FieldInfo& field : fieldList()) {
    EXPECT_EQ(field.kind == FieldKind::Word, !field.words.empty()) << field.path;
    std::set<std::string> labels;
    for (const FieldWord& word : field.words) {
      const std::string where = field.path + "=" + word.text;
      expectLabel(word.label, where);
      expectHelp(word.help, where);
      EXPECT_TRUE(labels.insert(word.label).second) << where << ": another word is called so too";
      ++count;
    }
  }
  EXPECT_GT(count, 15);
}

TEST(Schema, SlidersRunInsideTheHardRange) {
  for (const FieldInfo& field : fieldList()) {
    if (field.path == "version") continue;  // nobody slides it
    const Spec& spec = field.spec;
    EXPECT_TRUE(spec.softLow == Spec::kLowest || spec.softLow >= spec.low) << field.path;
    EXPECT_TRUE(spec.softHigh == Spec::kHighest || spec.softHigh <= spec.high) << field.path;
    EXPECT_LT(spec.sliderLow(), spec.sliderHigh()) << field.path;
    EXPECT_GE(spec.step, 0.0) << field.path;
    if (spec.logarithmic) {
      EXPECT_GT(spec.sliderLow(), 0.0) << field.path;
      EXPECT_GE(spec.sliderHigh() / spec.sliderLow(), 8.0) << field.path << " spans no decades";
    }
    if (!isNumeric(field) || !hasRange(spec) || field.optional) continue;
    const auto numbers = numbersIn(field.defaultValue);
    ASSERT_FALSE(numbers.empty()) << field.path << " " << field.defaultValue;
    for (const double number : numbers) {
      EXPECT_GE(number, spec.sliderLow()) << field.path << ": a slider cannot show the default";
      EXPECT_LE(number, spec.sliderHigh()) << field.path << ": a slider cannot show the default";
    }
  }
}

TEST(Schema, NumbersHaveRangesAndHintsFitTheirKinds) {
  for (const FieldInfo& field : fieldList()) {
    const Spec& spec = field.spec;
    const bool seed = field.name == "seed";  // 64 bits, all of them allowed
    EXPECT_TRUE(!isNumeric(field) || seed || hasRange(spec)) << field.path << " has no range";
    EXPECT_TRUE(!spec.isColour || field.kind == FieldKind::Vector) << field.path;
    EXPECT_LE(spec.isAngle + spec.isPercent + spec.isColour + spec.logarithmic, 1) << field.path;
    EXPECT_TRUE(*spec.files == '\0' || field.kind == FieldKind::Text) << field.path;
    EXPECT_TRUE(field.kind != FieldKind::Text || spec.role == Role::Label) << field.path;
    // The name in the file, the unit and the hints say the same.
    EXPECT_EQ(field.name.ends_with("Deg"), spec.isAngle) << field.path;
    EXPECT_EQ(spec.isAngle, std::string(spec.unit) == "degrees") << field.path;
    EXPECT_EQ(field.name.ends_with("olour") || field.name.ends_with("Tint"), spec.isColour) << field.path;
    EXPECT_TRUE(!field.name.ends_with("M") || std::string(spec.unit) == "m") << field.path;
    EXPECT_TRUE(!spec.isPercent || (spec.low >= 0.0 && spec.high <= 1.0)) << field.path;
  }
}

TEST(Schema, CurvesNameTheirAxes) {
  int curves = 0;
  for (const FieldInfo& field : fieldList()) {
    const Spec& spec = field.spec;
    const bool curve = field.kind == FieldKind::Curve;
    EXPECT_EQ(*spec.xLabel != '\0', curve) << field.path;
    EXPECT_EQ(*spec.yLabel != '\0', curve) << field.path;
    if (!curve) continue;
    ++curves;
    EXPECT_LT(spec.xLow, spec.xHigh) << field.path;
    EXPECT_TRUE(hasRange(spec)) << field.path;
  }
  EXPECT_GE(curves, 1);
}

/// docs/project-format.md is this text. To renew it: SWARD_WRITE_REFERENCE=1 test_project --gtest_filter=*Reference*
TEST(Schema, ReferenceInTheDocsIsUpToDate) {
  const std::filesystem::path file = std::filesystem::path(SWARD_SOURCE_DIR) / "docs" / "project-format.md";
  const std::string reference = fieldReference();
  if (std::getenv("SWARD_WRITE_REFERENCE") != nullptr) {
    std::filesystem::create_directories(file.parent_path());
    ASSERT_TRUE(base::writeFileAtomically(file, reference).ok());
  }
  const auto committed = base::readTextFile(file);
  ASSERT_TRUE(committed.ok()) << file;
  EXPECT_EQ(*committed, reference) << file << " is stale";
}

TEST(Schema, ReferenceNamesEveryField) {
  const std::string reference = fieldReference();
  for (const FieldInfo& field : fieldList()) {
    const std::size_t table = reference.find(field.owner.empty() ? "## The file" : "## `" + field.owner + "`\n");
    ASSERT_NE(table, std::string::npos) << field.path;
    const std::string rows = reference.substr(table, reference.find("\n## ", table + 1) - table);
    EXPECT_THAT(rows, testing::HasSubstr("| `" + field.name + "` |")) << field.path;
    EXPECT_THAT(rows, testing::HasSubstr(field.spec.help)) << field.path;
  }
  EXPECT_THAT(reference, testing::HasSubstr("0.002 to 20 m"));
}

/// A panel folds neighbours together; a group that came back later would fold twice.
TEST(Schema, FieldsOfAGroupAreNeighbours) {
  std::map<std::string, std::set<std::string>> seen;
  std::map<std::string, std::string> current;
  for (const FieldInfo& field : fieldList()) {
    const std::string group = field.spec.group;
    if (group == current[field.owner]) continue;
    current[field.owner] = group;
    if (group.empty()) continue;
    expectLabel(group, field.path + " (group)");
    EXPECT_TRUE(seen[field.owner].insert(group).second) << field.path << ": \"" << group << "\" was closed before";
  }
}

}  // namespace
}  // namespace sward::project
