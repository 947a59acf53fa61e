#include "mesh/procedural.h"

#include "mesh/ribbon.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sward::mesh {
namespace {

constexpr double kTau = 2.0 * std::numbers::pi;
enum : std::uint32_t { kLeafMaterial = 0, kStemMaterial = 1, kHeadMaterial = 2 };

/// Obovate: wedge-shaped at the foot, broadest at two thirds, a rounded end.
double obovate(double s) {
  const double wedge = std::sin(0.5 * std::numbers::pi * std::min(s / 0.66, 1.0));
  const double past = std::clamp((s - 0.66) / 0.34, 0.0, 1.0);
  return wedge * std::sqrt(std::max(1.0 - 0.93 * past * past, 0.0));
}

void growLeaflet(Model& model, const CloverShape& shape, base::Random& random, const glm::dvec3& foot, double azimuth,
                 double tilt, const glm::dvec3& colour) {
  const double length = shape.leafletLengthM * random.uniform(0.92, 1.08);
  Axis axis;
  axis.foot = foot;
  axis.azimuth = azimuth;
  axis.lean = tilt;
  axis.bend = glm::radians(random.uniform(10.0, 26.0));
  axis.length = length;
  axis.turn = 0.12 * cutNormal(random);
  axis.segments = 5;
  const std::vector<AxisRow> rows = axisRows(axis);
  appendRibbon(model, {rows, [&](double s) { return 0.5 * 0.88 * length * obovate(s); }, glm::radians(9.0),
                       [&](double s, double across) {
                         // The pale chevron: nearer to the foot at the edges than at the midrib.
                         const double place = (s - (0.60 - 0.18 * std::abs(across))) / 0.13;
                         const double pale = 0.42 * std::exp(-place * place);
                         const glm::dvec3 green = colour * (0.85 + 0.2 * s);
                         return glm::mix(green, green * 1.2 + glm::dvec3(0.10, 0.12, 0.08), pale);
                       },
                       kLeafMaterial});
}

/// A ball of florets: the lower ones droop and have browned, the upper ones stand.
void growHead(Model& model, const CloverShape& shape, base::Random& random, const AxisRow& top) {
  const double radius = 0.62 * shape.leafletLengthM;
  const glm::dvec3 colour = variedColour(random, shape.headColour, shape.colourVariation);
  const glm::dvec3 withered = colour * glm::dvec3(0.62, 0.45, 0.32);
  const double age = random.uniform(0.0, 0.5);
  const glm::dvec3 other = glm::cross(top.tangent, top.side);
  const glm::dvec3 middle = top.centre + top.tangent * (0.55 * radius);
  constexpr int kFlorets = 44;
  for (int i = 0; i < kFlorets; ++i) {
    // Spiral points over the ball (Fibonacci), without its lowest tenth where the stem enters.
    const double z = 1.0 - 1.8 * (i + 0.5) / kFlorets;
    const double ring = std::sqrt(std::max(1.0 - z * z, 0.0));
    const double azimuth = kTau * 0.381966 * i;
    const glm::dvec3 outward = ring * (std::cos(azimuth) * top.side + std::sin(azimuth) * other) + z * top.tangent;
    const glm::dvec3 direction = glm::normalize(outward + 0.35 * top.tangent);
    const glm::dvec3 base = middle + 0.32 * radius * outward;
    const double dried = std::clamp((age - 0.5 * (z + 1.0)) * 4.0, 0.0, 1.0);
    const glm::dvec3 tip = glm::mix(colour * random.uniform(0.9, 1.12), withered, dried);
    const glm::dvec3 foot = glm::mix(tip * 0.72, shape.leafColour, 0.25);
    const glm::dvec3 face =
        glm::normalize(top.tangent - direction * glm::dot(direction, top.tangent) + 1e-6 * top.side);
    const std::size_t first = model.positions.size();
    appendScale(model, base, direction * (0.72 * radius * random.uniform(0.9, 1.1)), face, 0.20 * radius, foot, tip,
                kHeadMaterial);
    // The ball shades as a ball, not as so many facets.
    for (std::size_t v = first; v < model.positions.size(); ++v) {
      model.normals[v] = glm::normalize(model.positions[v] - glm::vec3(middle));
    }
  }
}

/// Three leaflets a third of a turn apart, nearly level, the whole leaf tilted a little toward the light at its side.
void growLeaf(Model& model, const CloverShape& shape, base::Random& random, const AxisRow& top) {
  const glm::dvec3 colour = variedColour(random, shape.leafColour, shape.colourVariation);
  const double first = kTau * random.uniform();
  const double level = glm::radians(random.uniform(66.0, 84.0));
  const double heading = kTau * random.uniform();
  for (int i = 0; i < 3; ++i) {
    const double azimuth = first + kTau * i / 3.0 + 0.12 * cutNormal(random);
    const double tilt = level + glm::radians(9.0) * std::cos(azimuth - heading) + 0.06 * cutNormal(random);
    growLeaflet(model, shape, random, top.centre, azimuth, tilt, colour);
  }
}

}  // namespace

Model growClover(const CloverShape& shape, std::uint64_t seed) {
  Model model;
  model.name = "clover";
  model.materials.push_back(plantMaterial("leaflet", shape.optics));
  LeafOptics thick = shape.optics;
  thick.translucency *= 0.4;
  model.materials.push_back(plantMaterial("stem", thick));
  LeafOptics petal = shape.optics;
  petal.transmissionTint = glm::dvec3(1.0);
  petal.translucency *= 0.7;
  model.materials.push_back(plantMaterial("head", petal));

  const int count = std::max(shape.stems, 1);
  base::Random dice(base::mix64(seed, 0x636c6f76));
  const int heads = std::clamp(static_cast<int>(std::floor(shape.headShare * count + dice.uniform())), 0, count);
  for (int i = 0; i < count; ++i) {
    base::Random random(base::mix64(seed, static_cast<std::uint64_t>(i) + 1));
    const bool head = i < heads;
    const double height = variedLength(random, shape.heightM, shape.heightVariation) * (head ? 1.3 : 1.0);
    // Creeping runners carry the stems: their feet lie over the inner part of the spread, their tops reach its edge.
    const double azimuth = kTau * (i + random.uniform()) / count;
    const double reach = shape.spreadM * std::sqrt(random.uniform());
    Axis axis;
    axis.azimuth = azimuth;
    axis.foot = 0.6 * reach * glm::dvec3(std::cos(azimuth), std::sin(azimuth), 0.0);
    axis.lean = std::atan2(0.4 * reach, height) * (head ? 0.5 : 1.2);
    axis.bend = glm::radians(head ? 6.0 : 14.0) * cutNormal(random);
    axis.drift = 0.4 * cutNormal(random);
    axis.length = height;
    axis.segments = 4;
    const std::vector<AxisRow> rows = axisRows(axis);
    const double radius = std::clamp(0.035 * shape.leafletLengthM, 0.0003, 0.001);
    const glm::dvec3 green = variedColour(random, shape.leafColour * 1.15, shape.colourVariation);
    appendTube(model, {rows, [&](double s) { return radius * (1.0 - 0.3 * s); }, 3,
                       [&](double s, double) { return green * (0.7 + 0.3 * s); }, kStemMaterial});
    if (head) {
      growHead(model, shape, random, rows.back());
    } else {
      growLeaf(model, shape, random, rows.back());
    }
  }
  return model;
}

}  // namespace sward::mesh
