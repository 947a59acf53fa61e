#include "render/pass_view.h"

#include "render/macro_map.h"
#include "render/programs.h"
#include "scene/ground_look.h"

#include <algorithm>
#include <cmath>

namespace sward::render {
namespace {

constexpr double kMacroFadePixels = 2.0;  ///< of the macro scale to a pixel where it has faded out

double radicalInverse(unsigned index, unsigned base) {
  double value = 0.0, digit = 1.0 / base;
  for (; index > 0; index /= base, digit /= base) value += digit * (index % base);
  return value;
}

/// A tent over [-1, 1] from a uniform number (its inverse distribution).
double tent(double u) {
  return u < 0.5 ? std::sqrt(2.0 * u) - 1.0 : 1.0 - std::sqrt(2.0 - 2.0 * u);
}

/// Place of a sample in its pixel, from the centre, in pixels: tent-distributed, so that a plain mean filters with a
/// tent two pixels wide (Ernst et al. 2006, filter importance sampling).
glm::dvec2 samplePlace(int sample, int samples) {
  if (samples <= 1) return glm::dvec2(0.0);
  const auto index = static_cast<unsigned>(sample + 1);
  return {tent(radicalInverse(index, 2)), tent(radicalInverse(index, 3))};
}

/// The generalised golden ratio sequence in three dimensions (Roberts 2018).
glm::vec3 sampleShift(int sample) {
  constexpr double g = 1.22074408460575947536;
  const double n = sample;
  const auto part = [&](double rate) { return static_cast<float>(n * rate - std::floor(n * rate)); };
  return {part(1.0 / g), part(1.0 / (g * g)), part(1.0 / (g * g * g))};
}

double positiveModulo(double value, double period) {
  return value - period * std::floor(value / period);
}

}  // namespace

glm::dvec2 sampleOffset(const Frame& frame, int sample) {
  return samplePlace(sample, frame.options.samples) * glm::dvec2(2.0 / frame.width, 2.0 / frame.height);
}

void setView(gpu::Program& program, const Frame& frame, int sample) {
  const scene::Camera& camera = frame.camera;
  const glm::dvec2 scale(2.0 / frame.width, 2.0 / frame.height);
  const double aspect = static_cast<double>(frame.width) / frame.height;
  setIfUsed(program, "u_pixelScale", glm::vec2(scale));
  setIfUsed(program, "u_pixelOffset", glm::vec2(sampleOffset(frame, sample) - 1.0));
  setIfUsed(program, "u_viewRight", glm::vec3(camera.right * camera.tanHalfWidth));
  setIfUsed(program, "u_viewUp", glm::vec3(camera.up * (camera.tanHalfWidth / aspect)));
  setIfUsed(program, "u_viewForward", glm::vec3(camera.forward));
  setIfUsed(program, "u_sampleShift", sampleShift(sample));
  setIfUsed(program, "u_pixelAngle", static_cast<float>(2.0 * camera.tanHalfWidth / frame.width));
}

void setPlace(gpu::Program& program, const bake::GroundBake& ground, const Frame& frame) {
  const double side = ground.tileSideM();
  const glm::dvec2 eye = glm::dvec2(frame.camera.position) / side;
  const glm::dvec2 cell = glm::floor(eye);
  const double pixelAngle = 2.0 * frame.camera.tanHalfWidth / frame.width;
  setIfUsed(program, "u_eyeTiles", glm::vec2(eye - cell));
  setIfUsed(program, "u_eyeM", static_cast<float>(std::max(frame.camera.position.z, 1e-3)));
  setIfUsed(program, "u_tilesPerM", static_cast<float>(1.0 / side));
  setIfUsed(program, "u_heightM", static_cast<float>(std::max(ground.heightM, 1e-4)));
  setIfUsed(program, "u_mapSize", glm::vec2(ground.map.width, ground.map.height));
  setIfUsed(program, "u_mapBorder", static_cast<float>(kMapBorder));
  setIfUsed(program, "u_mapStride", static_cast<float>(ground.map.width + 2 * kMapBorder));
  setIfUsed(program, "u_mapInverse", 1.0f / glm::vec2(ground.map.width, ground.map.height));
  setIfUsed(program, "u_mapOffset",
            glm::vec2(positiveModulo(cell.x + ground.map.width / 2, ground.map.width),
                      positiveModulo(cell.y + ground.map.height / 2, ground.map.height)));
  setIfUsed(program, "u_gridBendTiles", static_cast<float>(frame.options.gridBendM / side));
  setIfUsed(program, "u_bendTurns", static_cast<float>(side / scene::kBendM));
  const glm::dvec2 turns = cell * (side / scene::kBendM);
  setIfUsed(program, "u_bendPhase",
            glm::vec2(positiveModulo(turns.y, 1.0), positiveModulo(turns.x + scene::kBendPhaseTurns, 1.0)));
  setIfUsed(program, "u_macroFadePerM",
            static_cast<float>(kMacroFadePixels * pixelAngle / std::max(frame.options.macroScaleM, side)));
}

}  // namespace sward::render
