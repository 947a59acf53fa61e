#pragma once

#include "live/reference_service.h"

#include "bake/asset_hashes.h"
#include "base/hash.h"
#include "base/job.h"
#include "render/options.h"
#include "scene/patch.h"
#include "trace/ground_plan.h"
#include "trace/patch_scene.h"
#include "trace/reference.h"

#include <memory>
#include <optional>

namespace sward::editor {

/// Whether two requests show the same picture, whatever their haste.
bool sameReference(const ReferenceRequest& a, const ReferenceRequest& b);

/// What ReferenceService does on its thread: requests become batches of samples. Keeps what two requests have in
/// common: the tree of the plants, and the picture so far.
class ReferenceTracer {
 public:
  explicit ReferenceTracer(int samples) : m_samples(samples) {}

  /// Adds a batch to the picture of a request, begun anew where it shows something else than the last one; nothing when
  /// there is none left to add. Cancelled: Error::cancelled(), and the picture stays as it was. Errors: assets that
  /// cannot be read, a view that gives no camera.
  Result<std::shared_ptr<const ReferencePicture>> addBatch(const ReferenceRequest& request, const JobContext& job);
  /// Nothing is left to add to the picture of a request.
  bool complete(const ReferenceRequest& request) const;
  /// Lets go of everything.
  void clear();
  int trees() const { return m_trees; }

 private:
  Result<void> growTree(const ReferenceRequest& request, const JobContext& job);
  Result<void> begin(bool half);
  std::shared_ptr<const ReferencePicture> picture() const;

  int m_samples;
  bake::AssetHashes m_assets;
  base::Hash128 m_treeKey{};
  std::unique_ptr<trace::PatchScene> m_tree;
  int m_trees = 0;
  std::optional<ReferenceRequest> m_request;  ///< that m_plan and m_reference are of
  trace::GroundPlan m_plan;
  render::ViewTransform m_transform{};
  bool m_half = false;
  std::unique_ptr<trace::Reference> m_reference;  ///< last: it looks into the tree and the plan
};

}  // namespace sward::editor
