#pragma once

#include "bake/cache.h"
#include "bake/texel_bake.h"
#include "base/hash.h"
#include "base/job.h"
#include "base/result.h"
#include "project/project.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace sward::bake {

/// What a texel cost.
struct TexelReport {
  enum class Rest { Made, Held, FromDisk } rest = Rest::Made;
  double restSeconds = 0.0;   ///< growing, voxelising, points: what no curve changes; or finding it
  double ageSeconds = 0.0;    ///< ageing the points and making voxels of them
  double levelSeconds = 0.0;  ///< coarser levels and skylight
  std::size_t points = 0, voxels = 0;
  std::uint64_t bytes = 0;            ///< of the levels, in memory
  std::uint64_t restBytes = 0;        ///< as stored
  std::vector<std::string> warnings;  ///< such as a full cache disk
};

/// Makes the texels of projects and remembers what the last one is aged from, so that curves, mingling and the
/// weathering degree change a texel without growing or voxelising anything anew. Not thread-safe: one per thread of
/// work.
class TexelBaker {
 public:
  TexelBaker();
  ~TexelBaker();
  TexelBaker(TexelBaker&&) noexcept;
  TexelBaker& operator=(TexelBaker&&) noexcept;

  /// The texels of a valid project at its weathering degree. `disk`, or null: where what they are aged from is looked
  /// for and kept. Errors: a missing asset; Error::cancelled().
  Result<std::shared_ptr<const TexelBake>> texels(const project::Project& project, const JobContext& job,
                                                  TexelReport* report = nullptr, DiskCache* disk = nullptr);
  /// Equal for two projects exactly when their texels are. Errors: a missing asset.
  Result<base::Hash128> key(const project::Project& project);

 private:
  struct Impl;
  std::unique_ptr<Impl> m_impl;
};

/// A texel and its halves, finest first, with what of the sky they see. Errors: Error::cancelled().
Result<std::vector<TexelBake::Level>> texelLevels(wither::Texel finest, const JobContext& job);

/// The grid of a project's texel: its patch, voxels as nearly cubes as layers that can be halved to one brick allow.
wither::TexelGrid texelGridOf(double sideM, double heightM, int columns);

}  // namespace sward::bake
