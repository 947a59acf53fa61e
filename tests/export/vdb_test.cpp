#include "export/vdb.h"

#include "base/file.h"
#include "wither/texel_test_help.h"

#include <cstdio>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

namespace sward::exporting {
namespace {

namespace fs = std::filesystem;
using wither::Texel;
using wither::TexelGrid;
using wither::Voxel;
using wither::testing::cube;
using wither::testing::randomTexel;
using wither::testing::sameBytes;
using wither::testing::texelOf;

class Vdb : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    m_folder = fs::temp_directory_path() / ("sward_vdb_" + std::string(test->name()) + std::to_string(::getpid()));
    fs::create_directories(m_folder);
  }
  void TearDown() override { fs::remove_all(m_folder); }
  fs::path file(const std::string& name = "texel.vdb") const { return m_folder / name; }

 private:
  fs::path m_folder;
};

Texel roundTrip(const Texel& texel, const fs::path& path, const VdbOptions& options = {}) {
  const auto written = writeVdb(texel, path, options);
  EXPECT_TRUE(written.ok()) << (written.ok() ? "" : written.error().text());
  auto back = readVdb(path);
  EXPECT_TRUE(back.ok()) << (back.ok() ? "" : back.error().text());
  return back.ok() ? std::move(back).value() : Texel();
}

TEST_F(Vdb, GivesBackEveryByte) {
  const Texel texel = randomTexel({32, 16, 0.7, 0.4}, 0.1, 3);
  EXPECT_TRUE(sameBytes(roundTrip(texel, file()), texel));
  const Texel empty = texelOf(cube(16), {});
  EXPECT_TRUE(sameBytes(roundTrip(empty, file()), empty));
  const Texel one = texelOf(cube(8), {{{7, 0, 5}, randomTexel(cube(8), 1.0, 1).voxels()[0]}});
  EXPECT_TRUE(sameBytes(roundTrip(one, file()), one));
}

TEST_F(Vdb, HalvesKeepElevenBits) {
  const Texel texel = randomTexel(cube(16), 0.2, 4);
  const Texel back = roundTrip(texel, file(), {.half = true});
  ASSERT_EQ(back.size(), texel.size());
  for (std::size_t i = 0; i < texel.size(); ++i) {
    const Voxel &a = texel.voxels()[i], &b = back.voxels()[i];
    ASSERT_EQ(a.density, b.density);
    ASSERT_EQ(a.spread, b.spread);
    for (int c = 0; c < 3; ++c) {
      // Half an ulp of eleven bits; under 2^-14 they are 2^-24 apart.
      ASSERT_NEAR(a.normal[c], b.normal[c], std::abs(a.normal[c]) / 2048.0f + 1e-7f);
      ASSERT_NEAR(a.diffuse[c], b.diffuse[c], a.diffuse[c] / 2048.0f + 1e-7f);
    }
  }
  const auto full = fs::file_size(file());
  ASSERT_TRUE(writeVdb(texel, file()).ok());
  EXPECT_LT(full, fs::file_size(file()));
}

TEST_F(Vdb, AFileThatIsCutShortIsAnErrorAtEveryLength) {
  const Texel texel = randomTexel(cube(8), 0.05, 5);
  ASSERT_TRUE(writeVdb(texel, file()).ok());
  const auto bytes = base::readFile(file());
  ASSERT_TRUE(bytes.ok());
  for (std::size_t length = 0; length < bytes->size(); length += length < 600 ? 7 : 101) {
    ASSERT_TRUE(base::writeFileAtomically(file("cut.vdb"), std::span(*bytes).first(length)).ok());
    const auto result = readVdb(file("cut.vdb"));
    ASSERT_FALSE(result.ok()) << length << " of " << bytes->size();
    ASSERT_NE(result.error().text().find("cut.vdb"), std::string::npos);
  }
}

TEST_F(Vdb, AFileOfWhichAnyByteIsChangedIsAnError) {
  ASSERT_TRUE(writeVdb(randomTexel(cube(8), 0.05, 5), file()).ok());
  auto bytes = base::readFile(file());
  ASSERT_TRUE(bytes.ok());
  for (std::size_t at = 0; at < bytes->size(); at += at < 1000 ? 7 : 997) {
    (*bytes)[at] ^= std::byte{0x55};
    ASSERT_TRUE(base::writeFileAtomically(file("damaged.vdb"), *bytes).ok());
    ASSERT_FALSE(readVdb(file("damaged.vdb")).ok()) << at;
    (*bytes)[at] ^= std::byte{0x55};
  }
}

TEST_F(Vdb, ErrorsSayWhatIsWrong) {
  EXPECT_FALSE(readVdb(file("none.vdb")).ok());
  ASSERT_TRUE(base::writeFileAtomically(file("text.vdb"), std::string("hello")).ok());
  const auto text = readVdb(file("text.vdb"));
  ASSERT_FALSE(text.ok());
  EXPECT_NE(text.error().what.find("not an OpenVDB"), std::string::npos);
  EXPECT_FALSE(writeVdb(Texel(), file()).ok());
  EXPECT_FALSE(writeVdb(texelOf(cube(8), {}), file("no/such/folder.vdb")).ok());
  EXPECT_FALSE(fs::exists(file()));
}

/// What Debian's interpreter prints for a program that may use OpenVDB's module; nothing without the module.
std::string python(const std::string& program, const fs::path& folder, const std::string& argument) {
  const fs::path script = folder / "check.py";
  EXPECT_TRUE(base::writeFileAtomically(script,
                                        "import sys\n"
                                        "try:\n"
                                        "  import pyopenvdb as vdb\n"
                                        "except ImportError:\n"
                                        "  try:\n"
                                        "    import openvdb as vdb\n"
                                        "  except ImportError:\n"
                                        "    print('no module')\n"
                                        "    sys.exit(0)\n" +
                                            program)
                  .ok());
  std::FILE* pipe = ::popen(("/usr/bin/python3 '" + script.string() + "' '" + argument + "' 2>&1").c_str(), "r");
  if (pipe == nullptr) return "no module";
  std::string out;
  char buffer[4096];
  for (std::size_t got = 0; (got = std::fread(buffer, 1, sizeof(buffer), pipe)) > 0;) out.append(buffer, got);
  ::pclose(pipe);
  return out;
}

TEST_F(Vdb, AnotherReaderFindsTheSameSumsAndPlaces) {
  const Texel texel = randomTexel({24, 16, 0.6, 0.2}, 0.05, 8);
  ASSERT_TRUE(writeVdb(texel, file()).ok());
  const std::string out = python(R"(
grids, metadata = vdb.readAll(sys.argv[1])
print('up', metadata['up_axis'])
for g in grids:
  n = 0
  sums = [0.0, 0.0, 0.0]
  for v in g.citerOnValues():
    n += v.count
    value = v.value if isinstance(v.value, tuple) else (v.value, 0.0, 0.0)
    sums = [s + v.count * x for s, x in zip(sums, value)]
  middle = g.transform.indexToWorld((3, 4, 5))
  print(g.name, n, *[repr(s) for s in sums], *[repr(x) for x in middle])
)",
                                 file().parent_path(), file().string());
  if (out.find("no module") != std::string::npos) GTEST_SKIP() << "python3-openvdb is not installed";
  std::map<std::string, glm::dvec3> expected;
  for (const Voxel& v : texel.voxels()) {
    expected["density"] += glm::dvec3(static_cast<double>(v.density), 0.0, 0.0);
    expected["normal"] += glm::dvec3(v.normal);
    expected["tangent"] += glm::dvec3(v.tangent);
    expected["Cd"] += glm::dvec3(v.diffuse);
    expected["transmitted"] += glm::dvec3(v.transmitted);
    expected["specular"] += glm::dvec3(static_cast<double>(v.specular), 0.0, 0.0);
    expected["spread_diag"] += glm::dvec3(glm::vec3(v.spread[0], v.spread[3], v.spread[5]));
    expected["spread_off"] += glm::dvec3(glm::vec3(v.spread[1], v.spread[2], v.spread[4]));
  }
  std::istringstream lines(out);
  std::string word, up;
  lines >> word >> up;
  EXPECT_EQ(up, "z") << out;
  std::size_t grids = 0, count = 0;
  glm::dvec3 sum, middle;
  for (; lines >> word >> count >> sum.x >> sum.y >> sum.z >> middle.x >> middle.y >> middle.z; ++grids) {
    ASSERT_TRUE(expected.contains(word)) << word;
    EXPECT_EQ(count, texel.size());
    // Both sum the same floats in double, in another order.
    EXPECT_NEAR(glm::length(sum - expected[word]), 0.0, 1e-9 * (1.0 + glm::length(expected["density"]))) << word;
    EXPECT_NEAR(glm::length(middle - glm::dvec3(3.5, 4.5, 5.5) * texel.grid().voxelM()), 0.0, 1e-12);
  }
  EXPECT_EQ(grids, 8u) << out;
}

TEST_F(Vdb, FilesOfAnotherProgram) {
  const std::string out = python(R"(
import os
folder = sys.argv[1]
def density(transform = None, value = 2.5):
  g = vdb.FloatGrid()
  g.name = 'density'
  g.fill((10, -4, 3), (19, 1, 5), value)
  if transform: g.transform = transform
  return g
def write(name, *grids): vdb.write(os.path.join(folder, name), grids = list(grids))
size = vdb.createLinearTransform(0.25)
write('plain.vdb', density(size))
tile = vdb.FloatGrid()
tile.name = 'density'
tile.fill((0, 0, 0), (15, 15, 15), 1.0)
write('tile.vdb', tile)
other = vdb.FloatGrid()
other.name = 'temperature'
write('other.vdb', other)
turned = vdb.createLinearTransform([[1, 1, 0, 0], [-1, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
write('turned.vdb', density(turned))
long = vdb.createLinearTransform([[1, 0, 0, 0], [0, 2, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
write('long.vdb', density(long))
write('negative.vdb', density(size, -1.0))
write('nan.vdb', density(size, float('nan')))
huge = vdb.FloatGrid()
huge.name = 'density'
huge.fill((0, 0, 0), (4095, 4095, 4095), 1.0)
write('huge.vdb', huge)
far = vdb.FloatGrid()
far.name = 'density'
far.fill((0, 0, 0), (0, 0, 0), 1.0)
far.fill((100000, 0, 0), (100000, 0, 0), 1.0)
write('far.vdb', far)
flag = vdb.BoolGrid()
flag.name = 'density'
write('bool.vdb', flag)
print('written')
)",
                                 file().parent_path(), file().parent_path().string());
  if (out.find("no module") != std::string::npos) GTEST_SKIP() << "python3-openvdb is not installed";
  ASSERT_NE(out.find("written"), std::string::npos) << out;
  const auto plain = readVdb(file("plain.vdb"));
  ASSERT_TRUE(plain.ok()) << plain.error().text();
  EXPECT_EQ(plain->grid(), (TexelGrid{16, 8, 4.0, 2.0}));
  EXPECT_EQ(plain->size(), 10u * 6u * 3u);
  ASSERT_NE(plain->at({9, 5, 2}), nullptr);
  EXPECT_EQ(plain->at({9, 5, 2})->density, 2.5f);
  EXPECT_EQ(plain->at({10, 5, 2}), nullptr);
  const auto tile = readVdb(file("tile.vdb"));
  ASSERT_TRUE(tile.ok()) << tile.error().text();
  EXPECT_EQ(tile->size(), 4096u);
  for (const auto& [name, why] : std::map<std::string, std::string>{{"other.vdb", "no grid named density"},
                                                                    {"turned.vdb", "turned"},
                                                                    {"long.vdb", "not square"},
                                                                    {"negative.vdb", "negative"},
                                                                    {"nan.vdb", "not finite"},
                                                                    {"huge.vdb", "voxels"},
                                                                    {"far.vdb", "4096"},
                                                                    {"bool.vdb", "type bool"}}) {
    const auto result = readVdb(file(name));
    ASSERT_FALSE(result.ok()) << name;
    EXPECT_NE(result.error().text().find(why), std::string::npos) << result.error().text();
    EXPECT_NE(result.error().text().find(name), std::string::npos);
  }
}

}  // namespace
}  // namespace sward::exporting
