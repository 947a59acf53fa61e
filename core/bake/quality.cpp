#include "bake/quality.h"

#include "scene/lights.h"

#include <algorithm>
#include <utility>

namespace sward::bake {
namespace {

// Ten coefficients a column, of several layers. Measured on the meadow against 15 lights: with 10 traced ones the
// picture is some 8 % darker from the side, with 12 half of that.
constexpr int kCoarseLights = 12;
constexpr int kHalfLights = 12;
constexpr int kHalfDirections = 5;
constexpr int kCoarseSegments = 3;  ///< of a blade: its bend stays, and the time goes with the triangles

int lightCount(const scene::LightOptions& lights) {
  return lights.pattern == scene::LightPattern::List ? static_cast<int>(lights.directions.size()) : lights.count;
}

/// Lights that spread evenly over the hemisphere. Where they stand hardly shows once a polynomial is fitted to them.
scene::LightOptions evenLights(int count) {
  scene::LightOptions lights;
  lights.count = count;
  return lights;
}

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

/// Columns of a texel divided by a power of two, in whole bricks.
int dividedTexel(int resolution, int divisor) {
  constexpr int kBrick = 8, kFewest = 32;
  const int divided = resolution / divisor / kBrick * kBrick;
  return std::min(resolution, std::max(divided, kFewest));
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

bool setSliceResolution(project::Project& project, int resolution) {
  const int now = project.sampling.sliceResolution;
  if (resolution == now) return true;
  if (resolution < now) {
    const int divisor = now / std::max(resolution, 1);
    if (resolution * divisor != now || !divides(project, divisor)) return false;
    divide(project, divisor);
    return true;
  }
  const int factor = resolution / std::max(now, 1);
  if (now * factor != resolution) return false;
  project::Project larger = project;
  trace::SamplingOptions& s = larger.sampling;
  s.sliceResolution *= factor;
  s.bladeWidth *= factor;
  s.bladeHeight *= factor;
  larger.tiles.resolution *= factor;
  larger.tiles.overlap *= factor;
  if (!project::requireValid(larger).ok()) return false;
  project = std::move(larger);
  return true;
}

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
  trace::SamplingOptions& s = reduced.sampling;
  if (quality == Quality::Half) {
    reduced.wither.texel.resolution = dividedTexel(project.wither.texel.resolution, 2);
    divideAtMost(reduced, 2);
    s.sliceSubSamples = (s.sliceSubSamples + 1) / 2;
    s.bladeSubSamples = (s.bladeSubSamples + 1) / 2;
    s.visibilityDirections = std::min(s.visibilityDirections, kHalfDirections);
    s.bladeHeight = std::max(2 * s.bladeHeight / 3, 4);  // blades cost most of the rays and have the finest texels
    if (lightCount(reduced.lights) > kHalfLights) reduced.lights = evenLights(kHalfLights);
  } else if (quality == Quality::Coarse) {
    reduced.wither.texel.resolution = dividedTexel(project.wither.texel.resolution, 4);
    divideAtMost(reduced, 4);
    // Two, so that the outlines of texels as wide as a hand are not all or nothing.
    s.sliceSubSamples = std::min(s.sliceSubSamples, 2);
    s.bladeSubSamples = 1;
    if (s.sliceResolution % 2 == 0) s.bladeWidth = s.sliceResolution;
    s.bladeHeight = std::max(s.bladeHeight / 2, 4);
    reduced.lights = evenLights(kCoarseLights);
    s.visibilityDirections = kCoarseLights;  // seen from where it is lit
    for (project::Plant& plant : reduced.patch.plants) {
      plant.grass.segments = std::min(plant.grass.segments, kCoarseSegments);
    }
  }
  return reduced;
}

}  // namespace sward::bake
