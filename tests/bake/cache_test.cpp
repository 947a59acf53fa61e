#include "bake/cache.h"
#include "bake/memory_cache.h"

#include "base/file.h"

#include "bake/temporary_folder.h"

#include <cstdlib>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace sward::bake {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;

base::Hash128 key(std::uint64_t number) {
  return {number, ~number};
}

std::vector<std::byte> payload(std::size_t size, int seed) {
  std::vector<std::byte> data(size);
  for (std::size_t i = 0; i < size; ++i)
    data[i] = static_cast<std::byte>((i * 31 + static_cast<std::size_t>(seed)) & 255);
  return data;
}

fs::path onlyEntry(const fs::path& folder) {
  fs::path found;
  int count = 0;
  for (const auto& item : fs::recursive_directory_iterator(folder)) {
    if (!item.is_regular_file()) continue;
    found = item.path();
    ++count;
  }
  EXPECT_EQ(count, 1);
  return found;
}

TEST(DiskCache, GivesBackWhatWasPut) {
  const TemporaryFolder folder("cache");
  auto cache = DiskCache::open(folder.path() / "new" / "folders");
  ASSERT_TRUE(cache.ok());
  EXPECT_FALSE(cache->get("hits", key(1)).has_value());
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{100000}}) {
    ASSERT_TRUE(cache->put("hits", key(size), payload(size, 3)).ok());
    EXPECT_EQ(cache->get("hits", key(size)), payload(size, 3));
    EXPECT_FALSE(cache->get("fit", key(size)).has_value()) << "kinds are apart";
  }
  ASSERT_TRUE(cache->put("hits", key(1), payload(5, 9)).ok());
  EXPECT_EQ(cache->get("hits", key(1)), payload(5, 9)) << "a later entry replaces the one before";
  EXPECT_GT(cache->size(), 100000u);
}

TEST(DiskCache, EveryTruncationIsAbsentAndRemoved) {
  const TemporaryFolder folder("cache-cut");
  DiskCache cache = DiskCache::open(folder.path()).value();
  ASSERT_TRUE(cache.put("fit", key(1), payload(200, 1)).ok());
  const fs::path entry = onlyEntry(folder.path());
  const auto whole = base::readFile(entry).value();
  for (std::size_t length = 0; length < whole.size(); ++length) {
    ASSERT_TRUE(base::writeFileAtomically(entry, std::span(whole).first(length)).ok());
    EXPECT_FALSE(cache.get("fit", key(1)).has_value()) << length;
    EXPECT_FALSE(fs::exists(entry)) << length;
  }
}

TEST(DiskCache, EveryFlippedBitIsNoticed) {
  const TemporaryFolder folder("cache-flip");
  DiskCache cache = DiskCache::open(folder.path()).value();
  ASSERT_TRUE(cache.put("fit", key(1), payload(60, 1)).ok());
  const fs::path entry = onlyEntry(folder.path());
  const auto whole = base::readFile(entry).value();
  for (std::size_t bit = 0; bit < whole.size() * 8; ++bit) {
    auto damaged = whole;
    damaged[bit / 8] ^= static_cast<std::byte>(1u << (bit % 8));
    ASSERT_TRUE(base::writeFileAtomically(entry, damaged).ok());
    EXPECT_FALSE(cache.get("fit", key(1)).has_value()) << bit;
  }
}

TEST(DiskCache, TheLeastRecentlyUsedGo) {
  const TemporaryFolder folder("cache-trim");
  DiskCache cache = DiskCache::open(folder.path(), 10000).value();
  for (std::uint64_t i = 0; i < 8; ++i) {
    ASSERT_TRUE(cache.put("fit", key(i), payload(1000, 1)).ok());
    std::this_thread::sleep_for(std::chrono::milliseconds(15));
  }
  EXPECT_TRUE(cache.get("fit", key(0)).has_value()) << "a read counts as a use";
  std::this_thread::sleep_for(std::chrono::milliseconds(15));
  for (std::uint64_t i = 8; i < 12; ++i) {
    ASSERT_TRUE(cache.put("fit", key(i), payload(1000, 1)).ok());
    std::this_thread::sleep_for(std::chrono::milliseconds(15));
  }
  EXPECT_LE(cache.size(), 10000u);
  EXPECT_TRUE(cache.get("fit", key(0)).has_value());
  EXPECT_FALSE(cache.get("fit", key(1)).has_value());
  EXPECT_TRUE(cache.get("fit", key(11)).has_value());
}

TEST(DiskCache, StaleTemporariesAreRemovedAndFreshOnesKept) {
  const TemporaryFolder folder("cache-temp");
  DiskCache cache = DiskCache::open(folder.path(), 1000).value();
  const fs::path stale = folder.path() / ".dead.tmp1-1.bake", fresh = folder.path() / ".live.tmp2-1.bake";
  for (const fs::path& path : {stale, fresh}) ASSERT_TRUE(base::writeFileAtomically(path, std::string("x")).ok());
  const timespec old[2] = {{1000, 0}, {1000, 0}};
  ASSERT_EQ(::utimensat(AT_FDCWD, stale.c_str(), old, 0), 0);
  ASSERT_TRUE(cache.put("fit", key(1), payload(100, 1)).ok());
  EXPECT_FALSE(fs::exists(stale));
  EXPECT_TRUE(fs::exists(fresh));
}

TEST(DiskCache, AFolderThatIsAFileOrFullIsAnError) {
  const TemporaryFolder folder("cache-bad");
  const fs::path file = folder.path() / "file";
  ASSERT_TRUE(base::writeFileAtomically(file, std::string("x")).ok());
  const auto cache = DiskCache::open(file);
  ASSERT_FALSE(cache.ok());
  EXPECT_EQ(cache.error().kind, ErrorKind::Failed);
  EXPECT_THAT(cache.error().remedy, testing::HasSubstr("--cache"));
  EXPECT_FALSE(DiskCache::open("/dev/full").ok());
  // An entry's folder that cannot be made: the put fails, the cache lives.
  DiskCache good = DiskCache::open(folder.path() / "good").value();
  ASSERT_TRUE(base::writeFileAtomically(folder.path() / "good" / "fit", std::string("x")).ok());
  EXPECT_FALSE(good.put("fit", key(1), payload(10, 1)).ok());
  EXPECT_TRUE(good.put("hits", key(1), payload(10, 1)).ok());
}

TEST(DiskCache, ProcessesAndThreadsShareAFolder) {
  const TemporaryFolder folder("cache-share");
  const auto work = [&](int seed) {
    DiskCache cache = DiskCache::open(folder.path(), 200000).value();
    for (int round = 0; round < 150; ++round) {
      const auto number = static_cast<std::uint64_t>((round * 7 + seed) % 40);
      const auto expected = payload(4000 + number, static_cast<int>(number));
      const auto got = cache.get("fit", key(number));
      if (got && *got != expected) return false;
      if (!cache.put("fit", key(number), expected).ok()) return false;
    }
    return true;
  };
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) ::_exit(work(11) ? 0 : 1);
  bool ok[2] = {false, false};
  {
    std::jthread a([&] { ok[0] = work(0); }), b([&] { ok[1] = work(5); });
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(ok[0]);
  EXPECT_TRUE(ok[1]);
  EXPECT_EQ(status, 0);
}

TEST(DiskCache, TheFolderFollowsTheXdgSpecification) {
  const char* before = std::getenv("XDG_CACHE_HOME");
  const std::string saved = before == nullptr ? "" : before;
  ::setenv("XDG_CACHE_HOME", "/somewhere/cache", 1);
  EXPECT_EQ(defaultCacheFolder(), "/somewhere/cache/sward");
  ::setenv("XDG_CACHE_HOME", "relative", 1);
  EXPECT_NE(defaultCacheFolder(), "relative/sward");
  if (before == nullptr) {
    ::unsetenv("XDG_CACHE_HOME");
  } else {
    ::setenv("XDG_CACHE_HOME", saved.c_str(), 1);
  }
}

TEST(MemoryCache, KeepsTheRecentlyUsedWithinItsLimit) {
  MemoryCache cache(100);
  for (std::uint64_t i = 0; i < 4; ++i) cache.put(key(i), std::make_shared<const int>(static_cast<int>(i)), 25);
  EXPECT_EQ(*cache.get<int>(key(0)), 0);
  cache.put(key(4), std::make_shared<const int>(4), 30);
  EXPECT_EQ(cache.get<int>(key(1)), nullptr);
  EXPECT_EQ(cache.get<int>(key(2)), nullptr);
  EXPECT_EQ(*cache.get<int>(key(0)), 0);
  EXPECT_LE(cache.size(), 100u);
  cache.put(key(5), std::make_shared<const int>(5), 101);
  EXPECT_EQ(cache.get<int>(key(5)), nullptr);
  EXPECT_EQ(*cache.get<int>(key(4)), 4) << "what does not fit drives nothing out";
  cache.put(key(4), std::make_shared<const int>(44), 40);
  EXPECT_EQ(*cache.get<int>(key(4)), 44);
}

}  // namespace
}  // namespace sward::bake
