#include "mesh/procedural.h"

#include "mesh/ribbon.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sward::mesh {
namespace {

constexpr double kTau = 2.0 * std::numbers::pi;
constexpr double kGoldenAngle = 0.381966 * kTau;
enum : std::uint32_t { kGreenMaterial = 0, kPetalMaterial = 1, kCentreMaterial = 2 };

/// The frame of a head: `up` along the stem's end, two directions across.
struct HeadFrame {
  glm::dvec3 centre{0.0};
  glm::dvec3 up{0.0, 0.0, 1.0};
  glm::dvec3 x{1.0, 0.0, 0.0};
  glm::dvec3 y{0.0, 1.0, 0.0};

  glm::dvec3 outward(double azimuth) const { return std::cos(azimuth) * x + std::sin(azimuth) * y; }
};

double leafOutline(double s) {
  return std::pow(s, 0.35) * (1.0 - std::pow(s, 2.2)) * 1.32;
}

/// Narrow at the foot, broad beyond the middle, a blunt end.
double petalOutline(double s) {
  return (0.40 + 0.60 * std::sin(0.5 * std::numbers::pi * std::min(s / 0.62, 1.0))) *
         (s < 0.7 ? 1.0 : std::sqrt(std::max(1.0 - std::pow((s - 0.7) / 0.3, 2.0), 0.0) * 0.85 + 0.15));
}

void growLeaf(Model& model, const FlowerShape& shape, base::Random& random, const AxisRow& at, double azimuth,
              double length) {
  Axis axis;
  axis.foot = at.centre;
  axis.azimuth = azimuth;
  axis.drift = 0.15 * cutNormal(random);
  axis.lean = glm::radians(random.uniform(28.0, 48.0));
  axis.bend = glm::radians(random.uniform(35.0, 70.0));
  axis.power = 1.3;
  axis.length = length;
  axis.turn = 0.25 * cutNormal(random);
  axis.segments = 4;
  const glm::dvec3 colour = variedColour(random, shape.leafColour, shape.colourVariation);
  const std::vector<AxisRow> rows = axisRows(axis);
  appendRibbon(model,
               {rows, [&](double s) { return 0.5 * 0.17 * length * leafOutline(s); }, glm::radians(14.0),
                [&](double s, double across) { return colour * (0.82 + 0.25 * s) * (1.12 - 0.12 * std::abs(across)); },
                kGreenMaterial});
}

/// Stem with its leaves; returns where the head sits.
HeadFrame growStem(Model& model, const FlowerShape& shape, base::Random& random, const Axis& axis) {
  std::vector<AxisRow> rows = axisRows(axis);
  const glm::dvec3 colour = variedColour(random, shape.leafColour, shape.colourVariation);
  const double radius = 0.5 * shape.stemWidthM;
  const double cup = std::max(0.75 * shape.centreRadiusM, radius);
  // The cup under the head opens over its own width only.
  AxisRow neck = rows.back();
  neck.centre -= neck.tangent * std::min(1.1 * cup, 0.05 * axis.length);
  neck.s = 0.99;
  rows.insert(rows.end() - 1, neck);
  appendTube(model, {rows, [&](double s) { return s < 0.995 ? radius * (1.0 - 0.35 * s) : cup; }, 4,
                     [&](double s, double) { return colour * (0.75 + 0.25 * s); }, kGreenMaterial});
  double azimuth = kTau * random.uniform();
  for (int i = 0; i < shape.leaves; ++i) {
    // From the ground to six tenths of the stem; the higher, the smaller.
    const double height = shape.leaves > 1 ? 0.62 * i / (shape.leaves - 1) : 0.2;
    const auto row = static_cast<std::size_t>(height * static_cast<double>(rows.size() - 1));
    const double part = height * static_cast<double>(rows.size() - 1) - static_cast<double>(row);
    AxisRow at = rows[row];
    at.centre = glm::mix(rows[row].centre, rows[std::min(row + 1, rows.size() - 1)].centre, part);
    azimuth += kGoldenAngle + random.uniform(-0.3, 0.3);
    growLeaf(model, shape, random, at, azimuth, shape.leafLengthM * (1.0 - 0.55 * height) * random.uniform(0.85, 1.15));
  }
  const AxisRow& top = rows.back();
  return {top.centre, top.tangent, top.side, glm::cross(top.tangent, top.side)};
}

void growPetal(Model& model, const FlowerShape& shape, base::Random& random, const HeadFrame& head, double azimuth,
               double raise) {
  const glm::dvec3 outward = head.outward(azimuth);
  const glm::dvec3 side = glm::cross(head.up, outward);
  const double length = shape.petalLengthM * random.uniform(0.92, 1.06);
  const double rise = glm::radians(raise + random.uniform(-5.0, 5.0));
  const double droop = glm::radians(random.uniform(18.0, 38.0));
  const int segments = 4;
  std::vector<AxisRow> rows;
  glm::dvec3 centre = head.centre + outward * (0.8 * shape.centreRadiusM);
  for (int i = 0; i <= segments; ++i) {
    const double s = static_cast<double>(i) / segments;
    const double angle = rise - droop * s;  // above the head's plane
    const glm::dvec3 tangent = std::cos(angle) * outward + std::sin(angle) * head.up;
    rows.push_back({centre, tangent, -side, s});
    centre += tangent * (length / segments);
  }
  const glm::dvec3 colour = variedColour(random, shape.petalColour, 0.5 * shape.colourVariation);
  appendRibbon(model, {rows, [&](double s) { return 0.5 * shape.petalWidthM * petalOutline(s); }, glm::radians(9.0),
                       [&](double s, double across) {
                         return colour * (0.80 + 0.20 * std::min(s / 0.4, 1.0)) * (0.94 + 0.06 * std::abs(across));
                       },
                       kPetalMaterial});
}

/// A dome of rings over the head, its florets hinted by a darker rim and middle.
void growCentre(Model& model, const FlowerShape& shape, base::Random& random, const HeadFrame& head) {
  const glm::dvec3 colour = variedColour(random, shape.centreColour, shape.colourVariation);
  std::vector<AxisRow> rows;
  constexpr int kRings = 4;
  const double height = 0.75 * shape.centreRadiusM;
  for (int i = 0; i <= kRings; ++i) {
    const double angle = 0.5 * std::numbers::pi * i / kRings;
    rows.push_back(
        {head.centre + head.up * (height * std::sin(angle)), head.up, head.x, static_cast<double>(i) / kRings});
  }
  const std::size_t first = model.positions.size();
  appendTube(model, {rows, [&](double s) { return shape.centreRadiusM * std::cos(0.5 * std::numbers::pi * s); }, 9,
                     [&](double s, double) { return colour * (s < 0.2 ? 0.7 : 1.08 - 0.25 * s); }, kCentreMaterial});
  // A tube's normals point sideways; a dome's point away from its middle.
  const glm::vec3 middle(head.centre - head.up * (0.2 * height));
  for (std::size_t i = first; i < model.positions.size(); ++i) {
    model.normals[i] = glm::normalize(model.positions[i] - middle);
  }
}

}  // namespace

Model growFlower(const FlowerShape& shape, std::uint64_t seed) {
  Model model;
  model.name = "flower";
  model.materials.push_back(plantMaterial("green", shape.optics));
  LeafOptics petal = shape.optics;
  petal.transmissionTint = glm::dvec3(1.0);  // petals pass their own colour, not a leaf's yellow-green
  petal.translucency *= 0.8;
  model.materials.push_back(plantMaterial("petal", petal));
  LeafOptics solid = shape.optics;
  solid.translucency = 0.0;
  model.materials.push_back(plantMaterial("centre", solid));

  base::Random random(base::mix64(seed, 0x666c6f77));
  Axis axis;
  axis.azimuth = kTau * random.uniform();
  axis.drift = 0.4 * cutNormal(random);
  axis.lean = glm::radians(4.0) * std::abs(cutNormal(random));
  axis.bend = glm::radians(shape.bendDeg) * std::max(1.0 + 0.5 * cutNormal(random), 0.0);
  axis.power = 2.0;
  axis.length = variedLength(random, shape.heightM, shape.heightVariation);
  axis.segments = 6;
  const HeadFrame head = growStem(model, shape, random, axis);

  const int petals = std::max(shape.petals, 0);
  const int outer = petals > 20 ? (petals + 1) / 2 : petals;  // many petals stand in two rings
  for (int i = 0; i < petals; ++i) {
    const bool upper = i >= outer;
    const int ring = upper ? petals - outer : outer;
    const double azimuth = kTau * ((upper ? i - outer + 0.5 : i) + random.uniform(-0.12, 0.12)) / ring;
    // Neighbours overlap at different heights, so that they never lie in one plane.
    growPetal(model, shape, random, head, azimuth, (upper ? 34.0 : 16.0) + (i % 2 == 0 ? 4.0 : -4.0));
  }
  growCentre(model, shape, random, head);
  return model;
}

}  // namespace sward::mesh
