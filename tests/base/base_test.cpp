#include "base/bytes.h"
#include "base/check.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/job.h"
#include "base/parallel.h"
#include "base/random.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <unistd.h>

namespace sward::base {
namespace {

namespace fs = std::filesystem;

struct TemporaryFolder {
  fs::path path = fs::temp_directory_path() / ("sward-base-test-" + std::to_string(::getpid()));
  TemporaryFolder() { fs::create_directories(path); }
  ~TemporaryFolder() { fs::remove_all(path); }
};

TEST(ParallelFor, CoversEveryIndexOnceOnAnyNumberOfThreads) {
  for (const int threads : {1, 2, 7}) {
    JobContext job;
    job.threads = threads;
    std::vector<std::atomic<int>> seen(1003);
    parallelFor(job, seen.size(), 10, [&](std::size_t begin, std::size_t end) {
      EXPECT_EQ(begin % 10, 0u);
      for (std::size_t i = begin; i < end; ++i) ++seen[i];
    });
    for (const auto& count : seen) EXPECT_EQ(count.load(), 1);
  }
}

TEST(ParallelFor, StopsWhenCancelledAndPassesExceptionsOn) {
  std::stop_source source;
  JobContext job;
  job.stop = source.get_token();
  std::atomic<int> ran{0};
  parallelFor(job, 100000, 1, [&](std::size_t, std::size_t) {
    if (++ran == 10) source.request_stop();
  });
  EXPECT_LT(ran.load(), 1000);
  EXPECT_THROW(parallelFor({}, 4, 1, [](std::size_t, std::size_t) { throw std::runtime_error("x"); }),
               std::runtime_error);
}

TEST(Progress, RisesToOneAndReportsAtMostAHundredTimes) {
  JobContext job;
  std::vector<double> seen;
  job.onProgress = [&](const std::string& stage, double fraction) {
    EXPECT_EQ(stage, "stage");
    seen.push_back(fraction);
  };
  ProgressCounter counter(job, "stage", 100000);
  for (int i = 0; i < 100000; ++i) counter.add();
  EXPECT_LE(seen.size(), 101u);
  EXPECT_EQ(seen.back(), 1.0);
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
}

TEST(Hash, SeparatesValuesAndJoins) {
  EXPECT_NE(Hasher().add("ab").add("c").finish(), Hasher().add("a").add("bc").finish());
  EXPECT_EQ(Hasher().add(0.0).finish(), Hasher().add(-0.0).finish());
  EXPECT_NE(Hasher().add(1).finish(), Hasher().add(2).finish());
  EXPECT_EQ(Hasher().finish().hex().size(), 32u);
}

TEST(Random, IsUniform) {
  // Chi-square over 64 cells, 64000 draws: 63 degrees of freedom, 99.99 % quantile 113.5.
  std::array<int, 64> cells{};
  Random random(42);
  for (int i = 0; i < 64000; ++i) ++cells[random.index(64)];
  double chiSquare = 0.0;
  for (const int count : cells) chiSquare += (count - 1000.0) * (count - 1000.0) / 1000.0;
  EXPECT_LT(chiSquare, 113.5);
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < 100000; ++i) {
    const double value = random.normal();
    sum += value;
    squares += value * value;
  }
  EXPECT_NEAR(sum / 100000, 0.0, 0.015);  // five standard errors
  EXPECT_NEAR(squares / 100000, 1.0, 0.025);
}

TEST(Bytes, RoundTripAndEveryTruncationIsNoticed) {
  ByteWriter out;
  out.value(std::uint32_t{7});
  out.array(std::vector<float>{1.5f, -2.0f});
  out.text("grass");
  const std::vector<std::byte> data = out.take();
  for (std::size_t length = 0; length <= data.size(); ++length) {
    ByteReader in(std::span<const std::byte>(data).first(length));
    std::uint32_t number = 0;
    std::vector<float> values;
    std::string text;
    in.value(number);
    in.array(values);
    in.text(text);
    EXPECT_EQ(in.finished(), length == data.size());
    if (in.finished()) {
      EXPECT_EQ(number, 7u);
      EXPECT_EQ(values, (std::vector<float>{1.5f, -2.0f}));
      EXPECT_EQ(text, "grass");
    }
  }
}

TEST(Bytes, AnAbsurdCountAllocatesNothing) {
  ByteWriter out;
  out.value(std::uint64_t{1} << 60);
  const auto data = out.take();
  ByteReader in(data);
  std::vector<double> values;
  in.array(values);
  EXPECT_FALSE(in.ok());
  EXPECT_TRUE(values.empty());
}

TEST(File, WritesWholeFilesOrNothing) {
  const TemporaryFolder folder;
  const fs::path path = folder.path / "a.txt";
  ASSERT_TRUE(writeFileAtomically(path, std::string("one")).ok());
  ASSERT_TRUE(writeFileAtomically(path, std::string("two")).ok());
  EXPECT_EQ(readTextFile(path).value(), "two");
  const auto failed = writeThroughTemporary(path, [](const fs::path& temporary) -> Result<void> {
    EXPECT_TRUE(writeFileAtomically(temporary, std::string("half")).ok());
    return Error::failed("broken off");
  });
  EXPECT_FALSE(failed.ok());
  EXPECT_EQ(readTextFile(path).value(), "two");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path), fs::directory_iterator()), 1);
}

TEST(File, SaysWhatIsWrong) {
  const TemporaryFolder folder;
  const auto missing = readFile(folder.path / "missing");
  ASSERT_FALSE(missing.ok());
  EXPECT_EQ(missing.error().kind, ErrorKind::BadInput);
  EXPECT_NE(missing.error().where.find("missing"), std::string::npos);
  EXPECT_FALSE(readFile(folder.path).ok());
  EXPECT_FALSE(writeFileAtomically(folder.path / "no" / "folder", std::string("x")).ok());
  EXPECT_FALSE(writeFileAtomically(folder.path, std::string("x")).ok());
  ASSERT_TRUE(writeFileAtomically(folder.path / "big", std::string(5000, 'x')).ok());
  EXPECT_FALSE(readFile(folder.path / "big", 4999).ok());
  EXPECT_TRUE(readFile(folder.path / "big", 5000).ok());
}

TEST(Check, ShowsBothValues) {
  try {
    SWARD_CHECK_EQ(1 + 1, 3);
    FAIL();
  } catch (const ContractError& error) {
    EXPECT_NE(std::string(error.what()).find("2 vs 3"), std::string::npos);
  }
}

TEST(Error, ReadsAsOneSentence) {
  EXPECT_EQ(Error::badInput("no lights", "lights", "Give one.").text(), "lights: no lights. Give one.");
}

}  // namespace
}  // namespace sward::base
