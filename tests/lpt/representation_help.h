#pragma once

#include "lpt/representation.h"
#include "lpt/representation_kinds.h"
#include "samples.h"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <utility>

namespace sward::lpt::test {

using Pointer = std::unique_ptr<Representation>;

/// Hits that give a scene's columns the shape of an image of one row.
inline trace::LayerHits hitsOf(const Scene& scene) {
  trace::LayerHits hits;
  hits.shape = {scene.columns, 1, scene.layers};
  hits.columnStart = scene.columnStart;
  hits.layer = scene.layer;
  return hits;
}

inline Pointer made(detail::Represented result) {
  if (!result) throw std::runtime_error(result.error().text());
  return std::move(result).value();
}
inline Pointer represented(const Scene& scene, const FitOptions& options, bool quantised = false, int threads = 0) {
  const trace::LayerHits hits = hitsOf(scene);
  JobContext job;
  job.threads = threads;
  return made(represent({scene.input(), &hits, nullptr}, options, quantised, job));
}

inline int columnOf(const Scene& scene, std::size_t texel) {
  return static_cast<int>(std::upper_bound(scene.columnStart.begin(), scene.columnStart.end(), texel) -
                          scene.columnStart.begin()) -
         1;
}

inline const glm::dvec3 kSun = glm::normalize(glm::dvec3(0.3, -0.5, 0.4));

}  // namespace sward::lpt::test
