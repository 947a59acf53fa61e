#pragma once

#include "bake/cache.h"
#include "bake/ground_bake.h"
#include "bake/quality.h"
#include "base/hash.h"
#include "bake/inspection.h"
#include "base/job.h"
#include "base/result.h"
#include "project/project.h"
#include "tiles/tile_set.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace sward::bake {

/// What happened to one node of the bake graph.
struct NodeReport {
  enum class State { Baked, FromMemory, FromDisk, Skipped };
  std::string kind;  ///< such as "hits", "luminance", "fit", "tiles"
  std::string what;  ///< such as "slices, light 3"
  State state = State::Baked;
  double seconds = 0.0;
  std::uint64_t bytes = 0;
};

struct BakeReport {
  std::vector<NodeReport> nodes;
  std::uint64_t raysNearest = 0, raysOcclusion = 0;
  double seconds = 0.0;
  std::vector<std::string> warnings;  ///< what went wrong without ending the bake, such as a full cache disk
};

/// A ground that is wanted.
struct GroundRequest {
  const project::Project& project;  ///< valid, as at full quality
  Quality quality = Quality::Full;
  /// Where the tiles' diamonds shall lie (layoutOf another ground), so that tiles do not jump between pictures; empty,
  /// or unfit for these tiles: they are chosen, as for a render.
  std::vector<glm::ivec2> layout{};
};
/// The places of a ground's diamonds, in slabs of blades from the patch's corner.
std::vector<glm::ivec2> layoutOf(const GroundBake& ground);

/// Walks the bake graph (design.md) from the ground's end: a node whose result is cached asks nothing of its inputs.
/// Holds the memory cache; the disk cache is optional. Not thread-safe: one per thread of work.
class Baker {
 public:
  struct Options {
    /// Of results held in memory. The default is enough for the results of two or three projects of ordinary size; a
    /// cold bake as a whole stays under 1 GiB.
    std::uint64_t memoryLimitBytes = std::uint64_t{192} << 20;
    /// Holds hits, visibility and fits in memory as well, so that colours are edited without the disk; for a program
    /// that bakes the same patch again and again.
    bool holdTraced = false;
    /// Stores finished texels on disk. Otherwise what they are aged from alone: for a program that asks for many
    /// moments of a season once each, whose texels would fill the cache. What is there is read in any case.
    bool storeTexels = true;
  };
  explicit Baker(std::optional<DiskCache> cache = {});
  Baker(std::optional<DiskCache> cache, const Options& options);
  ~Baker();
  Baker(Baker&&) noexcept;
  Baker& operator=(Baker&&) noexcept;

  /// The ground of a valid project at full quality. `report`, when given, is filled with what was done.
  Result<std::shared_ptr<const GroundBake>> ground(const project::Project& project, const JobContext& job,
                                                   BakeReport* report = nullptr);
  /// The same at any quality. Only what belongs to full quality is written to the disk cache.
  Result<std::shared_ptr<const GroundBake>> ground(const GroundRequest& request, const JobContext& job,
                                                   BakeReport* report = nullptr);
  /// The key of that ground, which two requests share exactly when they give the same bytes. Reads asset files; errors:
  /// the project is invalid, an asset is missing.
  Result<base::Hash128> key(const GroundRequest& request);
  /// Whether ground() would only have to look it up, in memory or on disk.
  bool holds(const base::Hash128& groundKey) const;
  /// What Inspection shows of the same ground: asked for apart, since no picture needs it. After ground() of the same
  /// project nothing is traced again.
  Result<std::shared_ptr<const Inspection>> inspection(const project::Project& project, const JobContext& job,
                                                       BakeReport* report = nullptr);
  Result<std::shared_ptr<const Inspection>> inspection(const GroundRequest& request, const JobContext& job,
                                                       BakeReport* report = nullptr);
  /// What the seams of the ground's tiles compare, an entry a column of the slices: for trying other tiles.
  Result<std::vector<tiles::SeamColumn>> seamColumns(const GroundRequest& request, const JobContext& job);
  /// Whether ground() would neither trace nor fit, since all of that is held in memory: true of a ground whose colours
  /// alone were edited (Options::holdTraced). Errors as key().
  Result<bool> tracesNothing(const GroundRequest& request);

 private:
  struct Impl;
  std::unique_ptr<Impl> m_impl;
};

}  // namespace sward::bake
