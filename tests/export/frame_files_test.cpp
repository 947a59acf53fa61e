#include "export/frame_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace sward::exporting {
namespace {

TEST(FrameFiles, RangesAreTakenOrRefused) {
  EXPECT_EQ(parseFrames("0:119", 120).value(), (FrameRange{0, 119}));
  EXPECT_EQ(parseFrames("7:7", 120).value(), (FrameRange{7, 7}));
  for (const char* wrong : {"", ":", "5", "5:", ":5", "5-9", "9:5", "0:120", "-1:5", "0:5 ", " 0:5", "0x1:5", "1:2:3",
                            "1.5:3", "99999999999:5"}) {
    const auto range = parseFrames(wrong, 120);
    ASSERT_FALSE(range.ok()) << wrong;
    EXPECT_EQ(range.error().kind, ErrorKind::BadInput) << wrong;
    EXPECT_EQ(range.error().where, "--frames") << wrong;
    EXPECT_NE(range.error().remedy.find("0:119"), std::string::npos) << wrong;
  }
}

TEST(FrameFiles, ShardsShareTheFramesOut) {
  const FrameRange range{3, 17};
  for (const int count : {1, 2, 4, 15, 40}) {
    std::vector<int> all;
    std::size_t least = 1000, most = 0;
    for (int index = 1; index <= count; ++index) {
      const std::vector<int> own = framesOf(range, {index, count});
      EXPECT_TRUE(std::is_sorted(own.begin(), own.end()));
      least = std::min(least, own.size());
      most = std::max(most, own.size());
      all.insert(all.end(), own.begin(), own.end());
    }
    std::sort(all.begin(), all.end());
    ASSERT_EQ(all.size(), 15u) << count;
    for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i], 3 + static_cast<int>(i));
    EXPECT_LE(most - least, 1u) << count;
  }
  // Counting on from the last of many shards does not overflow.
  EXPECT_TRUE(framesOf({0, 99}, {2147483647, 2147483647}).empty());
  for (const char* wrong : {"0/4", "5/4", "1/0", "-1/4", "1/-4", "1", "1/", "/4", "1:4", "1/4x", "1/99999999999"}) {
    EXPECT_FALSE(parseShard(wrong).ok()) << wrong;
  }
  EXPECT_EQ(parseShard("4/4").value(), (Shard{4, 4}));
}

TEST(FrameFiles, PatternsGiveNames) {
  const auto pattern = FramePattern::parse("out/autumn_%04d.png").value();
  EXPECT_EQ(pattern.fileOf(7), "out/autumn_0007.png");
  EXPECT_EQ(pattern.fileOf(12345), "out/autumn_12345.png");  // wider than asked for, never cut
  EXPECT_EQ(pattern.manifest(), "out/autumn.frames.json");
  EXPECT_EQ(FramePattern::parse("%d.exr").value().fileOf(7), "7.exr");
  EXPECT_EQ(FramePattern::parse("%d.exr").value().manifest(), "sequence.frames.json");
  EXPECT_EQ(FramePattern::parse("a%%b.%03d.c.png").value().fileOf(7), "a%b.007.c.png");
  EXPECT_EQ(FramePattern::parse("50%/f%03d.png").value().fileOf(1), "50%/f001.png");
}

TEST(FrameFiles, PatternsThatCannotBe) {
  for (const char* wrong : {"a.png", "", "a%04d_%04d.png", "a%s.png", "a%4d.png", "a%n.png", "a%", "a%00d.png",
                            "a%010d.png", "a%0.png", "f_%04d/a.png", "f_%04d/a_%04d.png", "a%%.png", "out/"}) {
    const auto pattern = FramePattern::parse(wrong);
    ASSERT_FALSE(pattern.ok()) << wrong;
    EXPECT_EQ(pattern.error().kind, ErrorKind::BadInput);
  }
  EXPECT_TRUE(FramePattern::isOne("a_%04d.png"));
  EXPECT_FALSE(FramePattern::isOne("a_100%.png"));
  EXPECT_FALSE(FramePattern::isOne("%04d/a.png"));
}

}  // namespace
}  // namespace sward::exporting
