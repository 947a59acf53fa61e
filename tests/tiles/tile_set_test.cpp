#include "tiles/tile_set.h"

#include "tiles/synthetic_patch.h"

#include <chrono>
#include <limits>
#include <map>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

namespace sward::tiles {
namespace {

using testing::colourOf;
using testing::isCorner;
using testing::ownerIndex;
using testing::stepped;
using testing::strokePatch;
using testing::tileCount;

constexpr int kPatch = 256;
constexpr int kPitch = 32;

const std::vector<SeamColumn>& patch() {
  static const std::vector<SeamColumn> columns = strokePatch(kPatch, 1200, 7);
  return columns;
}

TileSet make(const TileOptions& options, int pitch = kPitch) {
  auto set = makeTileSet(patch(), kPatch, pitch, options, {});
  EXPECT_TRUE(set.ok()) << set.error().text();
  return std::move(set).value();
}

TileOptions smallOptions() {
  TileOptions options;
  options.resolution = 16;
  options.overlap = 4;
  options.apron = 4;
  return options;
}

TEST(TileSet, EveryEdgeTexelBelongsToItsEdge) {
  for (const SeamMethod method : {SeamMethod::DynamicProgramming, SeamMethod::GraphCut}) {
    TileOptions options;
    options.seam = method;
    const TileSet set = make(options);
    const int last = set.resolution - 1;
    for (int tile = 0; tile < tileCount(set); ++tile) {
      for (int i = 1; i < last; ++i) {
        ASSERT_EQ(set.owner[ownerIndex(set, tile, i, 0)], kSouth);
        ASSERT_EQ(set.owner[ownerIndex(set, tile, i, last)], kNorth);
        ASSERT_EQ(set.owner[ownerIndex(set, tile, 0, i)], kWest);
        ASSERT_EQ(set.owner[ownerIndex(set, tile, last, i)], kEast);
      }
      // A corner texel lies on two edges and belongs to one of them.
      EXPECT_EQ(set.owner[ownerIndex(set, tile, 0, 0)], kSouth);
      EXPECT_EQ(set.owner[ownerIndex(set, tile, last, 0)], kEast);
      EXPECT_EQ(set.owner[ownerIndex(set, tile, last, last)], kNorth);
      EXPECT_EQ(set.owner[ownerIndex(set, tile, 0, last)], kWest);
    }
  }
}

TEST(TileSet, EveryMatchingPairContinuesAcrossItsEdge) {
  const TileSet set = make({});
  const int last = set.resolution - 1;
  int pairs = 0;
  for (int a = 0; a < tileCount(set); ++a) {
    for (int b = 0; b < tileCount(set); ++b) {
      if (colourOf(set, a, kEast) == colourOf(set, b, kWest)) {
        ++pairs;
        for (int y = 1; y < last; ++y) {
          ASSERT_EQ(stepped(set, set.patchColumn(a, last, y), 1, 0), set.patchColumn(b, 0, y)) << a << ' ' << b;
        }
      }
      if (colourOf(set, a, kNorth) == colourOf(set, b, kSouth)) {
        ++pairs;
        for (int x = 1; x < last; ++x) {
          ASSERT_EQ(stepped(set, set.patchColumn(a, x, last), 0, 1), set.patchColumn(b, x, 0)) << a << ' ' << b;
        }
      }
    }
  }
  EXPECT_EQ(pairs, 2 * 18 * 6);
}

TEST(TileSet, OwnersStayInTheirWidenedHalfDiamonds) {
  TileOptions options;
  options.seam = SeamMethod::GraphCut;
  const TileSet set = make(options);
  const int size = set.resolution;
  for (int tile = 0; tile < tileCount(set); ++tile) {
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        const int distance[4] = {y, x, size - 1 - y, size - 1 - x};
        const std::size_t owner = set.owner[ownerIndex(set, tile, x, y)];
        for (const std::size_t beside : {(owner + 1) % 4, (owner + 3) % 4}) {
          // Past the diagonal by no more than the overlap, nor than the other edge is far.
          const int past = distance[owner] - distance[beside];
          ASSERT_LE(past, std::min(options.overlap, distance[beside])) << tile << ": " << x << ' ' << y;
        }
      }
    }
  }
}

TEST(TileSet, ColoursAreBalancedForEveryCount) {
  for (int colours = 1; colours <= 4; ++colours) {
    for (int perPair = 1; perPair <= colours * colours; ++perPair) {
      TileOptions options = smallOptions();
      options.coloursPerAxis = colours;
      options.tilesPerPair = perPair;
      const TileSet set = make(options, 8);
      ASSERT_EQ(tileCount(set), colours * colours * perPair);
      EXPECT_EQ(set.diamonds.size(), static_cast<std::size_t>(2 * colours));
      std::set<std::array<std::uint8_t, 4>> distinct;
      std::map<std::pair<int, int>, int> southWest;
      std::map<std::pair<int, int>, int> onSide;
      for (const Tile& tile : set.tiles) {
        distinct.insert(tile.edges);
        ++southWest[{tile.edges[kSouth], tile.edges[kWest]}];
        for (int edge = 0; edge < 4; ++edge) ++onSide[{edge, tile.edges[static_cast<std::size_t>(edge)]}];
      }
      EXPECT_EQ(static_cast<int>(distinct.size()), tileCount(set));
      EXPECT_EQ(static_cast<int>(southWest.size()), colours * colours);
      for (const auto& entry : southWest) EXPECT_EQ(entry.second, perPair);
      EXPECT_EQ(static_cast<int>(onSide.size()), 4 * colours);
      for (const auto& entry : onSide) EXPECT_EQ(entry.second, colours * perPair);
    }
  }
}

TEST(TileSet, DiamondsLieApartOnTheBladesGrid) {
  const TileSet set = make({});
  for (std::size_t i = 0; i < set.diamonds.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const glm::ivec2 d = glm::abs(set.diamonds[i] - set.diamonds[j]);
      const int apart = std::min(d.x, kPatch - d.x) + std::min(d.y, kPatch - d.y);
      // Farther than a tile: no two half-diamonds of a tile show the same place.
      EXPECT_GT(apart, set.resolution);
    }
  }
  for (int tile = 0; tile < tileCount(set); ++tile) {
    for (const Edge edge : {kSouth, kWest, kNorth, kEast}) {
      const glm::ivec2 offset = set.patchOffset(tile, edge);
      EXPECT_EQ(offset.x % kPitch, 0);
      EXPECT_EQ(offset.y % kPitch, 0);
    }
  }
}

TEST(TileSet, BladesFollowTheOwners) {
  const TileSet set = make({});
  constexpr int kBlades = kPatch / kPitch;
  const int slabs = set.resolution / kPitch;
  const std::vector<BladeOwner> owners = bladeOwners(set, kBlades);
  ASSERT_EQ(owners.size(), 2U * set.tiles.size() * static_cast<std::size_t>(slabs * set.resolution));
  std::size_t at = 0;
  for (int axis = 0; axis < 2; ++axis) {
    for (int tile = 0; tile < tileCount(set); ++tile) {
      for (int slab = 0; slab < slabs; ++slab) {
        for (int along = 0; along < set.resolution; ++along, ++at) {
          const int middle = slab * kPitch + kPitch / 2;
          const auto ownerAt = [&](int across) {
            return axis == 0 ? set.owner[ownerIndex(set, tile, across, along)]
                             : set.owner[ownerIndex(set, tile, along, across)];
          };
          // Every texel across the slab that has the middle's owner lies in the same place of the patch's slab.
          for (int across = slab * kPitch; across < (slab + 1) * kPitch; ++across) {
            if (ownerAt(across) != ownerAt(middle)) continue;
            const std::uint32_t column =
                axis == 0 ? set.patchColumn(tile, across, along) : set.patchColumn(tile, along, across);
            const int patchAcross = static_cast<int>(axis == 0 ? column % kPatch : column / kPatch);
            const int patchAlong = static_cast<int>(axis == 0 ? column / kPatch : column % kPatch);
            ASSERT_EQ(patchAcross, owners[at].slab * kPitch + across - slab * kPitch);
            ASSERT_EQ(patchAlong, owners[at].position);
          }
        }
      }
    }
  }
}

TEST(TileSet, DegenerateSettings) {
  TileOptions options = smallOptions();
  options.overlap = 0;
  const TileSet straight = make(options, 8);
  for (int tile = 0; tile < tileCount(straight); ++tile) {
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 16; ++x) {
        const int distance[4] = {y, x, 15 - y, 15 - x};
        ASSERT_EQ(distance[straight.owner[ownerIndex(straight, tile, x, y)]],
                  *std::min_element(distance, distance + 4));
      }
    }
  }
  options = smallOptions();
  options.coloursPerAxis = 1;
  options.tilesPerPair = 1;
  options.apron = 0;
  const TileSet one = make(options, 8);
  EXPECT_EQ(tileCount(one), 1);
  options = {};
  options.domain = SeamDomain::Square;
  EXPECT_GT(make(options).seamCosts[0], 0.0);
}

TEST(TileSet, ConstantColumnsCostNothing) {
  SeamColumn column;
  column.coverage = 1.0f;
  column.meanColour = {glm::vec3(0.2f, 0.5f, 0.1f), glm::vec3(0.1f)};
  for (auto& response : column.coefficients) response.fill(0.3f);
  const std::vector<SeamColumn> columns(static_cast<std::size_t>(kPatch * kPatch), column);
  for (const SeamMethod method : {SeamMethod::DynamicProgramming, SeamMethod::GraphCut}) {
    TileOptions options;
    options.seam = method;
    const auto set = makeTileSet(columns, kPatch, kPitch, options, {});
    ASSERT_TRUE(set.ok());
    for (const double cost : set->seamCosts) EXPECT_EQ(cost, 0.0);
  }
}

TEST(TileSet, ColumnsThatAreNotNumbersDoNoHarm) {
  std::vector<SeamColumn> columns = strokePatch(kPatch, 300, 3);
  for (std::size_t i = 0; i < columns.size(); i += 97) {
    columns[i].coverage = i % 2 == 0 ? 1.0f : std::numeric_limits<float>::quiet_NaN();
    columns[i].coefficients[0][3] = std::numeric_limits<float>::quiet_NaN();
    columns[i].meanColour[1].x = std::numeric_limits<float>::infinity();
  }
  const auto set = makeTileSet(columns, kPatch, kPitch, {}, {});
  ASSERT_TRUE(set.ok());
  for (const double cost : set->seamCosts) EXPECT_TRUE(std::isfinite(cost));
}

void expectError(const TileOptions& options, int patchResolution, int pitch, const std::string& says) {
  const std::vector<SeamColumn> columns(static_cast<std::size_t>(patchResolution * patchResolution));
  const auto set = makeTileSet(columns, patchResolution, pitch, options, {});
  ASSERT_FALSE(set.ok()) << says;
  EXPECT_EQ(set.error().kind, ErrorKind::BadInput);
  EXPECT_NE(set.error().what.find(says), std::string::npos) << set.error().text();
  EXPECT_FALSE(set.error().remedy.empty());
}

TEST(TileSet, WrongSettingsAreNamed) {
  const auto with = [](auto change) {
    TileOptions options;
    change(options);
    return options;
  };
  expectError({}, 64, 32, "smaller than a diamond");
  expectError(with([](auto& o) { o.resolution = 63; }), 256, 32, "63");
  expectError(with([](auto& o) { o.resolution = 0; }), 256, 32, "resolution is 0");
  expectError(with([](auto& o) { o.resolution = -64; }), 256, 32, "-64");
  expectError(with([](auto& o) { o.resolution = 1000000; }), 256, 32, "1000000");
  expectError(with([](auto& o) { o.overlap = 17; }), 256, 32, "overlap of 17");
  expectError(with([](auto& o) { o.overlap = -1; }), 256, 32, "overlap of -1");
  expectError(with([](auto& o) { o.apron = 33; }), 256, 32, "apron of 33");
  expectError(with([](auto& o) { o.coloursPerAxis = 5; }), 256, 32, "coloursPerAxis is 5");
  expectError(with([](auto& o) { o.coloursPerAxis = 0; }), 256, 32, "coloursPerAxis is 0");
  expectError(with([](auto& o) { o.tilesPerPair = 10; }), 256, 32, "tilesPerPair is 10");
  expectError({}, 256, 64, "half a tile, 32 of 64 texels, is not a multiple of the blade slabs' 64 texels");
  expectError({}, 256, 0, "do not divide");
  expectError({}, 250, 32, "do not divide");
}

std::vector<std::byte> bytesOf(const TileSet& set) {
  base::ByteWriter out;
  save(out, set);
  return out.take();
}

TEST(TileSet, SameBytesOnAnyNumberOfThreads) {
  for (const SeamMethod method : {SeamMethod::DynamicProgramming, SeamMethod::GraphCut}) {
    TileOptions options;
    options.seam = method;
    std::vector<std::byte> first;
    for (const int threads : {1, 2, 5}) {
      JobContext job;
      job.threads = threads;
      const auto set = makeTileSet(patch(), kPatch, kPitch, options, job);
      ASSERT_TRUE(set.ok());
      if (first.empty()) first = bytesOf(*set);
      EXPECT_EQ(bytesOf(*set), first) << threads;
    }
    options.seed = 99;
    EXPECT_NE(bytesOf(make(options)), first);
  }
}

TEST(TileSet, CancelledJobSaysSo) {
  std::stop_source source;
  source.request_stop();
  JobContext job;
  job.stop = source.get_token();
  const auto set = makeTileSet(patch(), kPatch, kPitch, {}, job);
  ASSERT_FALSE(set.ok());
  EXPECT_EQ(set.error().kind, ErrorKind::Cancelled);
}

TEST(TileSet, DefaultTakesWellUnderASecond) {
  double best = std::numeric_limits<double>::infinity();
  for (int run = 0; run < 3; ++run) {
    const auto start = std::chrono::steady_clock::now();
    make({});
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  RecordProperty("make_tile_set_ms", static_cast<int>(1e3 * best));
  EXPECT_LT(best, 1.0);
}

TEST(TileSetBytes, RoundTrip) {
  const TileSet set = make({});
  const std::vector<std::byte> bytes = bytesOf(set);
  base::ByteReader in(bytes);
  TileSet read;
  ASSERT_TRUE(load(in, read));
  EXPECT_TRUE(in.finished());
  EXPECT_EQ(bytesOf(read), bytes);
  EXPECT_EQ(read.patchColumn(5, 12, 30), set.patchColumn(5, 12, 30));
}

TEST(TileSetBytes, DamageIsDetectedOrHarmless) {
  TileOptions options = smallOptions();
  options.coloursPerAxis = 2;
  const TileSet set = make(options, 8);
  const std::vector<std::byte> bytes = bytesOf(set);
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    base::ByteReader in(std::span<const std::byte>(bytes).first(length));
    TileSet read;
    ASSERT_FALSE(load(in, read)) << length;
    ASSERT_TRUE(read.tiles.empty());
  }
  base::Random random(11);
  int accepted = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    std::vector<std::byte> damaged = bytes;
    for (std::uint32_t hit = 0; hit <= random.index(3); ++hit) {
      // Half of the hits in the head, where sizes and colours stand.
      const std::size_t reach = random.index(2) == 0 ? 80 : damaged.size();
      damaged[random.index(static_cast<std::uint32_t>(reach))] = static_cast<std::byte>(random.index(256));
    }
    base::ByteReader in(damaged);
    TileSet read;
    if (!load(in, read)) continue;
    ++accepted;
    // What is accepted may be used without reading out of bounds.
    const auto side = static_cast<std::uint32_t>(read.patchResolution);
    const std::uint32_t limit = side * side;
    for (int tile = 0; tile < tileCount(read); ++tile) {
      for (int i = 0; i < read.resolution; ++i) ASSERT_LT(read.patchColumn(tile, i, i), limit);
      ASSERT_FALSE(texelSources(read, tile, -read.apron, read.resolution + read.apron - 1).empty());
    }
  }
  EXPECT_LT(accepted, 20000);
}

}  // namespace
}  // namespace sward::tiles
