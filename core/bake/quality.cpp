#include "bake/quality.h"

#include "scene/lights.h"

#include <algorithm>

namespace sward::bake {
namespace {

/// Sizes of the sampling and the tiles divided by a power of two.
void divide(project::Project& project, int divisor) {
  trace::SamplingOptions& s = project.sampling;
  tiles::TileOptions& t = project.tiles;
  s.sliceResolution /= divisor;
  s.bladeWidth /= divisor;
  s.bladeHeight = std::max(s.bladeHeight / divisor, 4);
  t.resolution /= divisor;
  t.overlap /= divisor;
  t.apron = std::max(t.apron / divisor, 1);
}

/// Whether a project may be divided: sizes stay whole, and large enough for the schema and the tiles.
bool divides(const project::Project& project, int divisor) {
  const trace::SamplingOptions& s = project.sampling;
  const tiles::TileOptions& t = project.tiles;
  return s.sliceResolution % divisor == 0 && s.bladeWidth % (2 * divisor) == 0 && t.resolution % (2 * divisor) == 0 &&
         s.blades > 0 && (s.sliceResolution / divisor) % s.blades == 0 && s.sliceResolution / divisor >= 16 &&
         t.resolution / divisor >= 8;
}

void divideAtMost(project::Project& project, int most) {
  for (int divisor = most; divisor > 1; divisor /= 2) {
    if (divides(project, divisor)) return divide(project, divisor);
  }
}

}  // namespace

const char* qualityName(Quality quality) {
  switch (quality) {
    case Quality::Coarse:
      return "coarse";
    case Quality::Half:
      return "half";
    case Quality::Full:
      break;
  }
  return "full";
}

project::Project atQuality(const project::Project& project, Quality quality) {
  project::Project reduced = project;
  if (quality == Quality::Half) {
    divideAtMost(reduced, 2);
  } else if (quality == Quality::Coarse) {
    divideAtMost(reduced, 4);
    reduced.sampling.sliceSubSamples = 1;
    reduced.sampling.bladeSubSamples = 1;
  }
  return reduced;
}

}  // namespace sward::bake
