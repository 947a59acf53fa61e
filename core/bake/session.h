#pragma once

#include "bake/bake.h"
#include "bake/inspection.h"
#include "bake/keys.h"
#include "bake/memory_cache.h"
#include "bake/payload.h"
#include "bake/stacks.h"
#include "trace/canopy_light.h"
#include "trace/voxel_density.h"

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sward::bake {

struct HeldRepresentation;

/// One walk of the graph, from the ground down to what is missing. Lives for one call of Baker::ground.
class Session {
 public:
  /// What a session works on; must outlive it.
  struct Input {
    const project::Project& project;
    const std::vector<glm::dvec3>& lights;
    const GroundSettings& settings;
    const GroundKeys& keys;
    MemoryCache& memory;
    std::optional<DiskCache>& disk;
    bool holdTraced = false;  ///< Baker::Options
  };
  Session(const Input& input, const JobContext& job);

  Result<std::shared_ptr<const GroundBake>> ground();
  Result<std::shared_ptr<const Inspection>> inspection();
  /// What the seams of the tiles compare.
  Result<std::vector<tiles::SeamColumn>> seamColumns();
  BakeReport takeReport();

 private:
  template <typename T>
  using Shared = std::shared_ptr<const T>;
  using Clock = std::chrono::steady_clock;

  /// Where a node's result is looked for and kept. The memory cache holds what an editor asks for again; large results
  /// are only remembered while someone holds them.
  enum class Keep { WhileHeld, Memory, Disk, MemoryAndDisk };

  /// All nodes in the order of a cold bake, with their parts of the progress bar.
  void plan();
  void planNode(const std::string& kind, const std::string& what, double weight);

  /// The result of a node: what is held, else from memory, else from disk, else make(job of this node).
  template <typename T, typename Make>
  Result<Shared<T>> node(const std::string& kind, const std::string& what, const base::Hash128& key, Keep keep,
                         const Make& make);
  template <typename T>
  Shared<T> find(const std::string& kind, const base::Hash128& key, Keep keep, NodeReport& report);
  template <typename T>
  Shared<T> findOnDisk(const std::string& kind, const base::Hash128& key, Keep keep, NodeReport& report);
  template <typename T>
  void remember(const std::string& kind, const base::Hash128& key, Keep keep, const Shared<T>& value,
                NodeReport& report);
  std::size_t indexOf(const std::string& kind, const std::string& what) const;
  JobContext jobOf(std::size_t node) const;

  Result<Shared<scene::Patch>> patch();
  Result<Shared<mesh::Model>> model(std::size_t plant, int index);
  Result<const trace::PatchScene*> scene();
  Result<const trace::TriangleField*> field();
  Result<const trace::CanopyLight*> canopy();
  Result<trace::LayerHits> makeHits(trace::LayerSet set, const JobContext& job);
  Result<trace::LayerLuminance> makeLuminance(trace::LayerSet set, std::size_t light, const JobContext& job);
  Result<trace::LayerVisibility> makeVisibility(trace::LayerSet set, const JobContext& job);
  Result<const trace::ArrivingLight*> arriving(trace::LayerSet set);
  Keep keepTraced() const { return m_holdTraced ? Keep::MemoryAndDisk : Keep::Disk; }
  Result<Shared<trace::LayerHits>> hits(trace::LayerSet set);
  Result<Shared<trace::LayerSurface>> surface(trace::LayerSet set);
  Result<Shared<trace::LayerVisibility>> visibility(trace::LayerSet set);
  Result<Shared<trace::LayerLuminance>> luminance(trace::LayerSet set, std::size_t light);
  Result<Shared<trace::LayerLuminance>> sunLuminance(trace::LayerSet set);
  /// What fits of a set read, with all that it points to.
  struct LightSamples {
    Shared<trace::LayerHits> hits;
    Shared<trace::LayerVisibility> visibility;
    std::vector<Shared<trace::LayerLuminance>> lit;
    std::vector<float> coverage;
    lpt::FitInput input;
  };
  Result<LightSamples> lightSamples(trace::LayerSet set, bool withLights);
  Result<Shared<lpt::Fit>> fit(trace::LayerSet set);
  Result<Shared<lpt::Fit>> seamFit();
  Result<Shared<lpt::Fit>> fitWith(trace::LayerSet set, const lpt::FitOptions& options, const std::string& what,
                                   const base::Hash128& key);
  Result<lpt::Fit> makeFit(trace::LayerSet set, const lpt::FitOptions& options, const JobContext& job);
  Result<lpt::Fit> meanOfLights(const LightSamples& samples) const;
  Result<lpt::Fit> sunResponses(trace::LayerSet set, const lpt::FitOptions& options, const JobContext& job);
  Result<Shared<trace::VoxelDensity>> density();
  Result<Shared<HeldRepresentation>> representation(trace::LayerSet set, const lpt::FitOptions& options);
  Result<Shared<tiles::TileSet>> tileSet();
  Result<Shared<lpt::LayerStack>> stack(trace::LayerSet set);
  Result<Shared<tiles::TileMap>> map();
  Result<GroundBake> makeGround(const JobContext& job);
  Result<Inspection> makeInspection(const JobContext& job);

  const project::Project& m_project;
  const std::vector<glm::dvec3>& m_lights;
  const GroundSettings& m_settings;
  const GroundKeys& m_keys;
  const JobContext& m_job;
  MemoryCache& m_memory;
  std::optional<DiskCache>& m_disk;
  bool m_holdTraced;

  std::unique_ptr<trace::PatchScene> m_scene;
  Shared<trace::VoxelDensity> m_density;
  Shared<lpt::Fit> m_slicesFit;  ///< held from the seams to the stack
  // Of the sampler that passes over all triangles: all layer sets at once, since the passes share their cost.
  std::unique_ptr<trace::TriangleField> m_field;
  std::vector<trace::LayerHits> m_passed;
  std::unique_ptr<trace::CanopyLight> m_canopy;
  std::map<trace::LayerSet, trace::ArrivingLight> m_arriving;
  std::map<base::Hash128, std::weak_ptr<const void>> m_held;
  BakeReport m_report;
  std::vector<double> m_progressEnd;  ///< of each node, cumulated weights
  double m_childSeconds = 0.0;        ///< time that the running node's inputs took, so that each node's time is its own
  bool m_storeFailed = false;         ///< the disk cache refused an entry
  Clock::time_point m_start = Clock::now();
};

}  // namespace sward::bake
