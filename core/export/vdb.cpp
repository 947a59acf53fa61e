#include "export/vdb.h"

#include "base/file.h"
#include "base/hash.h"

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <new>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <string_view>

namespace sward::exporting {
namespace {

constexpr std::uint64_t kMostBytes = std::uint64_t{4} << 30;
constexpr std::uint64_t kMostVoxels = std::uint64_t{1} << 26;
constexpr std::size_t kHeaderBytes = 4096;  ///< the metadata of a file stand within so many
constexpr int kBrick = wither::TexelGrid::kBrick;

using wither::Voxel;

openvdb::Vec3s toVdb(const glm::vec3& v) {
  return {v.x, v.y, v.z};
}
glm::vec3 fromVdb(const openvdb::Vec3s& v) {
  return {v.x(), v.y(), v.z()};
}
openvdb::Vec3s diagonal(const Voxel& v) {
  return {v.spread[0], v.spread[3], v.spread[5]};
}
openvdb::Vec3s offDiagonal(const Voxel& v) {
  return {v.spread[1], v.spread[2], v.spread[4]};
}

/// The archive writes to any stream in the form of a file, whose grids are found by their offsets.
class FileArchive : public openvdb::io::Archive {
 public:
  void writeTo(std::ostream& out, const openvdb::GridCPtrVec& grids, const openvdb::MetaMap& metadata) const {
    Archive::write(out, grids, true, metadata);
  }
};

template <typename Grid, typename Of>
typename Grid::Ptr gridOf(const wither::Texel& texel, const char* name, bool half, const Of& of) {
  auto grid = Grid::create();
  grid->setName(name);
  grid->setSaveFloatAsHalf(half);
  const glm::dvec3 size = texel.grid().voxelM();
  auto transform = std::make_shared<openvdb::math::Transform>(openvdb::math::MapBase::Ptr(
      new openvdb::math::ScaleTranslateMap({size.x, size.y, size.z}, {0.5 * size.x, 0.5 * size.y, 0.5 * size.z})));
  grid->setTransform(transform);
  auto accessor = grid->getAccessor();
  for (std::size_t i = 0; i < texel.size(); ++i) {
    const glm::u16vec3& at = texel.places()[i];
    accessor.setValue({at.x, at.y, at.z}, of(texel.voxels()[i]));
  }
  return grid;
}

openvdb::GridCPtrVec gridsOf(const wither::Texel& texel, bool half) {
  using openvdb::FloatGrid;
  using openvdb::Vec3SGrid;
  openvdb::GridCPtrVec grids;
  auto density = gridOf<FloatGrid>(texel, "density", false, [](const Voxel& v) { return v.density; });
  density->setGridClass(openvdb::GRID_FOG_VOLUME);
  grids.push_back(density);
  auto normal = gridOf<Vec3SGrid>(texel, "normal", half, [](const Voxel& v) { return toVdb(v.normal); });
  normal->setVectorType(openvdb::VEC_COVARIANT_NORMALIZE);
  grids.push_back(normal);
  auto tangent = gridOf<Vec3SGrid>(texel, "tangent", half, [](const Voxel& v) { return toVdb(v.tangent); });
  tangent->setVectorType(openvdb::VEC_CONTRAVARIANT_RELATIVE);
  grids.push_back(tangent);
  grids.push_back(gridOf<Vec3SGrid>(texel, "Cd", half, [](const Voxel& v) { return toVdb(v.diffuse); }));
  grids.push_back(gridOf<Vec3SGrid>(texel, "transmitted", half, [](const Voxel& v) { return toVdb(v.transmitted); }));
  grids.push_back(gridOf<FloatGrid>(texel, "specular", half, [](const Voxel& v) { return v.specular; }));
  // Of S the range is the density's.
  grids.push_back(gridOf<Vec3SGrid>(texel, "spread_diag", false, diagonal));
  grids.push_back(gridOf<Vec3SGrid>(texel, "spread_off", false, offDiagonal));
  return grids;
}

openvdb::MetaMap metadataOf(const wither::Texel& texel) {
  openvdb::MetaMap metadata;
  metadata.insertMeta("creator", openvdb::StringMetadata("Sward"));
  metadata.insertMeta("up_axis", openvdb::StringMetadata("z"));
  metadata.insertMeta("sward_columns", openvdb::Int32Metadata(texel.grid().columns));
  metadata.insertMeta("sward_layers", openvdb::Int32Metadata(texel.grid().layers));
  metadata.insertMeta("sward_side_m", openvdb::DoubleMetadata(texel.grid().sideM));
  metadata.insertMeta("sward_height_m", openvdb::DoubleMetadata(texel.grid().heightM));
  return metadata;
}

Error damaged(const std::filesystem::path& path, const std::string& why) {
  return Error::badInput("the OpenVDB file cannot be read: " + why, path.string(),
                         "It may be cut short, or damaged: write it again.");
}

/// OpenVDB throws, and so does the stream that it reads from or writes to; both become errors here.
template <typename Value, typename Work>
Result<Value> guarded(const std::filesystem::path& path, const Work& work) {
  try {
    openvdb::initialize();
    return work();
  } catch (const std::bad_alloc&) {
    return damaged(path, "it asks for more memory than there is");
  } catch (const std::exception& error) {
    return damaged(path, error.what());
  }
}

/// The grids of a file, as far as they are known here.
struct Grids {
  openvdb::FloatGrid::ConstPtr density, specular;
  openvdb::Vec3SGrid::ConstPtr normal, tangent, diffuse, transmitted, diagonal, offDiagonal;
  openvdb::MetaMap::ConstPtr metadata;
};

template <typename Grid>
Result<typename Grid::ConstPtr> pick(const openvdb::GridPtrVec& grids, const char* name,
                                     const std::filesystem::path& path) {
  for (const openvdb::GridBase::Ptr& grid : grids) {
    if (!grid || grid->getName() != name) continue;
    if (auto typed = openvdb::gridConstPtrCast<Grid>(grid)) return typename Grid::ConstPtr(typed);
    return Error::badInput(
        "its grid " + std::string(name) + " is of type " + grid->valueType(), path.string(),
        "A grid of type " + std::string(openvdb::typeNameAsString<typename Grid::ValueType>()) + " is needed.");
  }
  return typename Grid::ConstPtr();
}

/// Follows a file's grids, where other readers do not look: OpenVDB writes beyond its memory when it reads some damaged
/// files, so what was written here is compared with its hash before OpenVDB sees it.
constexpr std::string_view kSealName = "sward-xxh3:";
std::string sealOf(std::string_view bytes) {
  return std::string(kSealName) + base::hashBytes(std::as_bytes(std::span(bytes))).hex();
}

Result<void> checkBytes(std::string_view bytes, const std::filesystem::path& path) {
  constexpr std::string_view kMagic("\x20\x42\x44\x56\x00\x00\x00\x00", 8);
  std::uint32_t version = 0;
  if (!bytes.starts_with(kMagic) || bytes.size() < kMagic.size() + sizeof(version)) {
    return Error::badInput("this is not an OpenVDB file", path.string(), "Give a file of the type .vdb.");
  }
  std::memcpy(&version, bytes.data() + kMagic.size(), sizeof(version));
  if (version > openvdb::OPENVDB_FILE_VERSION) {
    return damaged(path, "its version " + std::to_string(version) + " is unknown");
  }
  const std::size_t sealSize = sealOf({}).size();
  const std::string_view seal = bytes.substr(bytes.size() - std::min(sealSize, bytes.size()));
  const bool sealed = seal.starts_with(kSealName);
  const bool ours = sealed || bytes.substr(0, kHeaderBytes).find("sward_columns") != std::string_view::npos;
  if (!ours || (sealed && seal == sealOf(bytes.substr(0, bytes.size() - sealSize)))) return {};
  return damaged(path, "it is not as it was written");
}

Result<Grids> readGrids(const std::filesystem::path& path) {
  SWARD_ASSIGN(const std::string bytes, base::readTextFile(path, kMostBytes));
  SWARD_TRY(checkBytes(bytes, path));
  std::istringstream in(bytes);
  // Without this a file that is cut short reads as zeros.
  in.exceptions(std::ios::failbit | std::ios::badbit | std::ios::eofbit);
  openvdb::io::Stream stream(in, false);
  const openvdb::GridPtrVecPtr all = stream.getGrids();
  Grids grids;
  grids.metadata = stream.getMetadata();
  SWARD_ASSIGN(grids.density, pick<openvdb::FloatGrid>(*all, "density", path));
  SWARD_ASSIGN(grids.specular, pick<openvdb::FloatGrid>(*all, "specular", path));
  SWARD_ASSIGN(grids.normal, pick<openvdb::Vec3SGrid>(*all, "normal", path));
  SWARD_ASSIGN(grids.tangent, pick<openvdb::Vec3SGrid>(*all, "tangent", path));
  SWARD_ASSIGN(grids.diffuse, pick<openvdb::Vec3SGrid>(*all, "Cd", path));
  SWARD_ASSIGN(grids.transmitted, pick<openvdb::Vec3SGrid>(*all, "transmitted", path));
  SWARD_ASSIGN(grids.diagonal, pick<openvdb::Vec3SGrid>(*all, "spread_diag", path));
  SWARD_ASSIGN(grids.offDiagonal, pick<openvdb::Vec3SGrid>(*all, "spread_off", path));
  if (grids.density) return grids;
  return Error::badInput("it has no grid named density", path.string(), "Name the leaf area's density, 1/m, density.");
}

/// Where the voxels of a file are, as a texel.
struct Block {
  wither::TexelGrid grid;
  openvdb::Coord origin;
};

Result<glm::dvec3> voxelSize(const openvdb::GridBase& grid, const std::filesystem::path& path) {
  const openvdb::Mat4R matrix =
      grid.transform().isLinear() ? grid.transform().baseMap()->getAffineMap()->getMat4() : openvdb::Mat4R::zero();
  bool plain = grid.transform().isLinear();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) plain = plain && (i == j || matrix(i, j) == 0.0);
    plain = plain && std::isfinite(matrix(i, i)) && matrix(i, i) > 0.0;
  }
  plain = plain && std::abs(matrix(0, 0) - matrix(1, 1)) <= 1e-6 * matrix(0, 0);
  if (plain) return glm::dvec3(matrix(0, 0), matrix(1, 1), matrix(2, 2));
  return Error::badInput("its voxels are turned, sheared, or not square in x and y", path.string(),
                         "Resample it to voxels along the axes, of one size in x and y.");
}

template <typename Value>
std::optional<Value> metaOf(const openvdb::MetaMap& map, const char* name) {
  const auto typed = map.getMetadata<openvdb::TypedMetadata<Value>>(name);
  return typed ? std::optional<Value>(typed->value()) : std::nullopt;
}

Result<Block> blockOf(const Grids& grids, const std::filesystem::path& path) {
  SWARD_ASSIGN(const glm::dvec3 size, voxelSize(*grids.density, path));
  const std::uint64_t voxels = grids.density->activeVoxelCount();
  if (voxels > kMostVoxels) {
    return Error::badInput("it has " + std::to_string(voxels) + " voxels", path.string(), "At most 2^26 are read.");
  }
  Block block;
  const openvdb::MetaMap& map = *grids.metadata;
  const auto columns = metaOf<std::int32_t>(map, "sward_columns"), layers = metaOf<std::int32_t>(map, "sward_layers");
  const auto side = metaOf<double>(map, "sward_side_m"), height = metaOf<double>(map, "sward_height_m");
  if (columns && layers && side && height) {
    block.grid = {*columns, *layers, *side, *height};
  } else {
    const openvdb::CoordBBox box = grids.density->evalActiveVoxelBoundingBox();
    const auto whole = [](int count) { return (std::max(count, 1) + kBrick - 1) / kBrick * kBrick; };
    const openvdb::Coord dim = box.empty() ? openvdb::Coord(1, 1, 1) : box.dim();
    if (std::max({dim.x(), dim.y(), dim.z()}) > 4096) {
      return Error::badInput("its active box is over 4096 voxels long", path.string(),
                             "Cut out a part, or resample it.");
    }
    block.grid.columns = whole(std::max(dim.x(), dim.y()));
    block.grid.layers = whole(dim.z());
    block.grid.sideM = block.grid.columns * size.x;
    block.grid.heightM = block.grid.layers * size.z;
    if (!box.empty()) block.origin = box.min();
  }
  SWARD_TRY(wither::checkGrid(block.grid));
  return block;
}

Voxel voxelAt(const Grids& grids, const openvdb::Coord& at, float density) {
  constexpr glm::vec3 kPlain(0.105f, 0.160f, 0.034f);
  const auto value = [&](const openvdb::Vec3SGrid::ConstPtr& grid, const glm::vec3& otherwise) {
    return grid ? fromVdb(grid->tree().getValue(at)) : otherwise;
  };
  Voxel voxel;
  voxel.density = density;
  voxel.normal = value(grids.normal, glm::vec3(0.0f));
  voxel.tangent = value(grids.tangent, glm::vec3(0.0f));
  voxel.diffuse = value(grids.diffuse, kPlain);
  voxel.transmitted = value(grids.transmitted, glm::vec3(0.0f));
  voxel.specular = grids.specular ? grids.specular->tree().getValue(at) : 0.0f;
  const glm::vec3 along = value(grids.diagonal, glm::vec3(density / 3.0f));
  const glm::vec3 across = value(grids.offDiagonal, glm::vec3(0.0f));
  voxel.spread = {along.x, across.x, across.y, along.y, across.z, along.z};
  return voxel;
}

Result<wither::Texel> texelOf(const Grids& grids, const std::filesystem::path& path) {
  SWARD_ASSIGN(const Block block, blockOf(grids, path));
  std::vector<wither::Texel::Entry> entries;
  entries.reserve(grids.density->activeVoxelCount());
  for (auto it = grids.density->cbeginValueOn(); it; ++it) {
    const openvdb::CoordBBox box = it.getBoundingBox();  // one voxel, or a tile of one value
    for (auto at = box.begin(); at; ++at) {
      const openvdb::Coord place = *at - block.origin;
      entries.push_back({{place.x(), place.y(), place.z()}, voxelAt(grids, *at, *it)});
    }
  }
  auto texel = wither::Texel::fromEntries(block.grid, std::move(entries));
  if (texel.ok()) return texel;
  return Error::badInput(texel.error().what, path.string(),
                         "Densities are leaf area over volume, at least 0, inside the block.");
}

}  // namespace

Result<void> writeVdb(const wither::Texel& texel, const std::filesystem::path& path, const VdbOptions& options) {
  SWARD_TRY(wither::checkGrid(texel.grid()));
  std::string bytes;
  try {
    openvdb::initialize();
    std::ostringstream out;
    out.exceptions(std::ios::failbit | std::ios::badbit);
    FileArchive().writeTo(out, gridsOf(texel, options.half), metadataOf(texel));
    bytes = out.str();
  } catch (const std::exception& error) {
    return Error::failed("OpenVDB cannot write the texel: " + std::string(error.what()), path.string());
  }
  bytes += sealOf(bytes);
  return base::writeFileAtomically(path, bytes, base::Sync::Yes);
}

Result<wither::Texel> readVdb(const std::filesystem::path& path) {
  return guarded<wither::Texel>(path, [&]() -> Result<wither::Texel> {
    SWARD_ASSIGN(const Grids grids, readGrids(path));
    return texelOf(grids, path);
  });
}

}  // namespace sward::exporting
