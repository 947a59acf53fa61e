#pragma once

#include "bake/ground_bake.h"
#include "base/result.h"
#include "image/bytes.h"
#include "project/project.h"
#include "scene/options.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

namespace sward::editor {

/// A view whose truth is wanted: the plants themselves, standing where the ground's tiles put them.
struct ReferenceRequest {
  std::shared_ptr<const project::Project> project;  ///< for its sun, sky, view transform and bend of the grid
  std::shared_ptr<const bake::GroundBake> ground;   ///< whose tiles and map are traced
  std::shared_ptr<const project::Project> planted;  ///< for the plants and soil: what `ground` was baked from
  scene::View view;
  int width = 1280, height = 720;
  bool moving = false;  ///< the camera or a slider moves: half the size (rounded up), one batch of samples
  bool held = false;    ///< something else needs the processor: nothing is traced, what there is stays
};

/// A reference as far as it is traced.
struct ReferencePicture {
  image::ByteImage bytes;  ///< as the viewport shows its own: exposure, view transform; no macro variation
  bool half = false;       ///< of half the request's size (rounded up)
  int samples = 0;
  double noise = 0.0;  ///< render::displayNoise
};

/// Traces references of the viewport on a thread of low priority: a first batch of samples at half size, then batch by
/// batch at full size up to a number. A request that shows something else ends the batch being traced; an equal one
/// changes nothing. The tree of the plants is kept while geometry and colours stay the same. Rests when the picture is
/// complete, while it is held, and when nothing is wanted. All calls come from one thread, the UI's, and never wait.
class ReferenceService {
 public:
  static constexpr int kBatch = 4;  ///< samples; a multiple of the reference's four sequences
  struct Options {
    int threads = 0;                  ///< 0: all of them, at the lowest priority
    int samples = 256;                ///< of a complete picture
    std::function<void()> onChanged;  ///< called from the service's thread when there is something new; may be empty
  };
  explicit ReferenceService(Options options);
  /// Cancels and joins; within a second.
  ~ReferenceService();
  ReferenceService(const ReferenceService&) = delete;
  ReferenceService& operator=(const ReferenceService&) = delete;

  void request(ReferenceRequest request);
  /// Stops, and lets go of the tree and all pictures.
  void close();
  /// Of the newest request, as far as it is; null before its first batch.
  std::shared_ptr<const ReferencePicture> picture() const;

  struct Status {
    bool running = false;        ///< something is traced or waits to be
    std::optional<Error> error;  ///< of the newest request: it stays without a picture
    int trees = 0;               ///< built so far
  };
  Status status() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> m_impl;
};

}  // namespace sward::editor
