#include "export/frame_manifest.h"

#include "base/file.h"

#include "bake/temporary_folder.h"

#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

namespace sward::exporting {
namespace {

namespace fs = std::filesystem;

/// A folder with one file that stands for a frame.
class FrameManifestTest : public testing::Test {
 protected:
  FrameManifestTest() : m_folder("manifest") {
    EXPECT_TRUE(base::writeFileAtomically(picture(), std::string("pixels")).ok());
  }
  fs::path folder() const { return m_folder.path(); }
  fs::path picture() const { return folder() / "f_0003.png"; }
  fs::path manifest() const { return folder() / "f.frames.json"; }
  FrameEntry entry(int frame = 3) const { return entryOf(picture(), frame, 0.25, "key", "device").value(); }

 private:
  test::TemporaryFolder m_folder;
};

TEST_F(FrameManifestTest, GivesBackWhatWasRecorded) {
  ASSERT_TRUE(record(manifest(), R"({"view": "main"})", entry()).ok());
  const FrameManifest read = readManifest(manifest());
  ASSERT_EQ(read.frames.size(), 1u);
  EXPECT_EQ(read.frames.at(3), entry());
  EXPECT_EQ(read.settings, R"({"view":"main"})");
  EXPECT_TRUE(isWhole(folder(), read.frames.at(3)));
}

TEST_F(FrameManifestTest, AnOlderEntryOfAFrameIsReplacedAndOthersStay) {
  ASSERT_TRUE(record(manifest(), "{}", entry(3)).ok());
  ASSERT_TRUE(record(manifest(), "{}", entry(1)).ok());
  FrameEntry newer = entry(3);
  newer.key = "another";
  ASSERT_TRUE(record(manifest(), "{}", newer).ok());
  const FrameManifest read = readManifest(manifest());
  EXPECT_EQ(read.frames.size(), 2u);
  EXPECT_EQ(read.frames.at(3).key, "another");
}

TEST_F(FrameManifestTest, TheOrderOfRecordingDoesNotShow) {
  for (const int frame : {5, 1, 4}) ASSERT_TRUE(record(manifest(), "{}", entry(frame)).ok());
  const fs::path other = folder() / "g.frames.json";
  for (const int frame : {1, 4, 5}) ASSERT_TRUE(record(other, "{}", entry(frame)).ok());
  EXPECT_EQ(base::readTextFile(manifest()).value(), base::readTextFile(other).value());
}

TEST_F(FrameManifestTest, AFileThatIsNotWholeIsFoundOut) {
  const FrameEntry known = entry();
  EXPECT_TRUE(isWhole(folder(), known));
  ASSERT_TRUE(base::writeFileAtomically(picture(), std::string("pixelz")).ok());  // as long, other bytes
  EXPECT_FALSE(isWhole(folder(), known));
  ASSERT_TRUE(base::writeFileAtomically(picture(), std::string("pix")).ok());
  EXPECT_FALSE(isWhole(folder(), known));
  fs::remove(picture());
  EXPECT_FALSE(isWhole(folder(), known));
  FrameEntry elsewhere = known;
  elsewhere.file = "../f_0003.png";
  EXPECT_FALSE(isWhole(folder(), elsewhere));
  elsewhere.file.clear();
  EXPECT_FALSE(isWhole(folder(), elsewhere));
}

TEST_F(FrameManifestTest, DamagedManifestsHoldNothingAndAreMended) {
  ASSERT_TRUE(record(manifest(), "{}", entry()).ok());
  const std::string text = base::readTextFile(manifest()).value();
  for (std::size_t length = 0; length + 2 < text.size(); length += 7) {
    ASSERT_TRUE(base::writeFileAtomically(manifest(), text.substr(0, length)).ok());
    EXPECT_TRUE(readManifest(manifest()).frames.empty()) << length;
  }
  for (const char* wrong : {"[]", "{\"format\": 1}", "{\"format\": 2, \"settings\": {}, \"frames\": []}",
                            R"({"format": 1, "settings": {}, "frames": [{"frame": "3"}]})", "null"}) {
    ASSERT_TRUE(base::writeFileAtomically(manifest(), std::string(wrong)).ok());
    EXPECT_TRUE(readManifest(manifest()).frames.empty()) << wrong;
  }
  ASSERT_TRUE(record(manifest(), "{}", entry()).ok());
  EXPECT_EQ(readManifest(manifest()).frames.size(), 1u);
  EXPECT_TRUE(readManifest(folder() / "none.json").frames.empty());
}

TEST_F(FrameManifestTest, ManyWritersLoseNothing) {
  constexpr int kWriters = 4, kEach = 12;
  std::vector<std::thread> writers;
  for (int writer = 0; writer < kWriters; ++writer) {
    writers.emplace_back([this, writer] {
      for (int i = 0; i < kEach; ++i) {
        FrameEntry own = entry();
        own.frame = writer + kWriters * i;
        EXPECT_TRUE(record(manifest(), "{}", own).ok());
      }
    });
  }
  for (std::thread& writer : writers) writer.join();
  EXPECT_EQ(readManifest(manifest()).frames.size(), static_cast<std::size_t>(kWriters * kEach));
}

}  // namespace
}  // namespace sward::exporting
