#include "mesh/procedural.h"

#include "base/curve_sampler.h"
#include "mesh/ribbon.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <optional>

namespace sward::mesh {
namespace {

constexpr double kTau = 2.0 * std::numbers::pi;
constexpr std::uint32_t kLeafMaterial = 0;
constexpr std::uint32_t kHeadMaterial = 1;

/// Built-in lanceolate outline: a sheath of 0.62, the full width at three tenths, a long point.
double lanceolate(double s) {
  const double rise = std::min(s / 0.3, 1.0);
  const double sheath = 0.62 + 0.38 * rise * rise * (3.0 - 2.0 * rise);
  return sheath * (1.0 - std::pow(s, 2.6));
}

/// The same, scaled so that its widest place is 1.
double builtInWidth(double s) {
  static const double widest = [] {
    double largest = 0.0;
    for (int i = 0; i <= 100; ++i) largest = std::max(largest, lanceolate(i / 100.0));
    return largest;
  }();
  return lanceolate(s) / widest;
}

double relativeWidth(const GrassShape& shape, double s) {
  return shape.profile.points().empty() ? builtInWidth(s) : std::max(shape.profile(s), 0.0);
}

/// Roots stay dark over the sheath, then the blade brightens.
double builtInTipPart(double s) {
  return std::pow(s, 0.8);
}

/// A built-in function as a curve through evenly spaced points, for people to start from.
base::Curve sampled(double low, double high, int count, const std::function<double(double)>& function) {
  std::vector<base::CurvePoint> points;
  for (int i = 0; i < count; ++i) {
    const double x = low + (high - low) * i / (count - 1);
    points.push_back({x, function(x)});
  }
  return base::Curve::fromPoints(std::move(points)).value();  // x increases and all is finite
}

/// Where one blade stands in the tuft.
struct Root {
  glm::dvec3 foot{0.0};
  double azimuth = 0.0;
  double offset = 0.0;  ///< 0 in the tuft's middle to 1 at its edge
};

Root placeRoot(const GrassShape& shape, base::Random& random, int index, int count) {
  // Azimuths are stratified so that no side of a small tuft is bare; the radius is uniform over the disc.
  const double stratum = (index + random.uniform()) / count;
  Root root;
  root.azimuth = kTau * stratum + 0.35 * cutNormal(random);
  root.offset = std::sqrt(random.uniform());
  const double around = root.azimuth + random.uniform(-0.6, 0.6);
  root.foot = shape.clumpRadiusM * root.offset * glm::dvec3(std::cos(around), std::sin(around), 0.0);
  return root;
}

/// Colours of one blade: its green, and how far from the tip downward it has dried (0: not at all).
struct BladeColour {
  const base::Curve* along = nullptr;  ///< part of the tip's colour; empty: the built-in rise
  glm::dvec3 root{0.0};
  glm::dvec3 tip{0.0};
  glm::dvec3 dry{0.0};
  double dryLength = 0.0;
  double dryAmount = 0.0;

  glm::dvec3 at(double s, double across) const {
    const double t = along->points().empty() ? builtInTipPart(s) : std::clamp((*along)(s), 0.0, 1.0);
    // The midrib is a little paler than the blade's halves.
    glm::dvec3 colour = glm::mix(root, tip, t) * (1.06 - 0.06 * std::abs(across));
    if (dryLength > 0.0) {
      const double reach = std::clamp((s - (1.0 - dryLength)) / std::max(0.5 * dryLength, 0.08), 0.0, 1.0);
      colour = glm::mix(colour, dry, dryAmount * reach * reach * (3.0 - 2.0 * reach));
    }
    return colour;
  }
};

BladeColour bladeColour(const GrassShape& shape, base::Random& random) {
  BladeColour colour;
  colour.along = &shape.colourAlong;
  const double v = shape.colourVariation;
  base::Random twin = random;  // root and tip of a blade vary together
  colour.root = variedColour(random, shape.rootColour, v);
  colour.tip = variedColour(twin, shape.tipColour, v);
  colour.dry = variedColour(random, dryColour(shape.tipColour), 0.5 * v);
  const double chance = random.uniform();
  const double amount = random.uniform(0.5, 0.95);
  const double length = random.uniform(0.08, 0.35);
  // A few blades are old straw all over, more have dry tips; both follow the variation that the user asks for.
  const bool old = chance < 0.5 * v;
  const bool dryTip = chance < 2.0 * v;
  colour.dryAmount = dryTip ? amount : 0.0;
  colour.dryLength = old ? 1.3 : (dryTip ? length : 0.0);
  return colour;
}

/// Heights of the blades of one tuft by the shape's curve, relative: one from each of as many strata of equal
/// probability, so that even a tuft of few blades follows the curve, in an order of their own.
std::vector<double> drawnHeights(const base::Curve& density, int count, std::uint64_t seed) {
  const base::CurveSampler sampler(density, 0.0, kHighestRelativeHeight);
  base::Random random(base::mix64(seed, 0x68656967));
  std::vector<int> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t i = order.size(); i > 1; --i) {
    std::swap(order[i - 1], order[random.index(static_cast<std::uint32_t>(i))]);
  }
  std::vector<double> heights;
  for (const int stratum : order) {
    heights.push_back(std::max(sampler((stratum + random.uniform()) / count), kLowestRelativeHeight));
  }
  return heights;
}

/// `relativeHeight` replaces the normal distribution; the blade's other traits stay the same with and without it.
void growBlade(Model& model, const GrassShape& shape, base::Random& random, const Root& root,
               std::optional<double> relativeHeight) {
  const double normal = variedLength(random, shape.heightM, shape.heightVariation);
  const double length = relativeHeight ? *relativeHeight * shape.heightM : normal;
  // Short blades are narrower, by less than they are shorter.
  const double width = shape.widthM * std::sqrt(length / shape.heightM);
  Axis axis;
  axis.foot = root.foot;
  axis.azimuth = root.azimuth;
  axis.drift = 0.30 * cutNormal(random);
  axis.lean = glm::radians(shape.leanDeg) * std::max(0.35 + 0.85 * root.offset + 0.35 * cutNormal(random), 0.0);
  axis.bend = glm::radians(shape.bendDeg) * std::max(1.0 + 0.35 * cutNormal(random), 0.1);
  axis.power = random.uniform(1.2, 2.2);
  axis.length = length;
  axis.turn = 0.35 * cutNormal(random);
  axis.twist = glm::radians(shape.twistDeg) * cutNormal(random);
  axis.segments = std::max(shape.segments, 1);
  const BladeColour colour = bladeColour(shape, random);
  const std::vector<AxisRow> rows = axisRows(axis);
  appendRibbon(
      model, {rows, [&](double s) { return 0.5 * width * relativeWidth(shape, s); }, 0.5 * glm::radians(shape.foldDeg),
              [&](double s, double across) { return colour.at(s, across); }, kLeafMaterial});
}

/// The spikelets of a narrow panicle along the upper part of a stem.
void growHead(Model& model, const GrassShape& shape, base::Random& random, std::span<const AxisRow> rows) {
  const double length = 0.16 * shape.heightM * random.uniform(0.8, 1.2);
  const double openness = random.uniform(0.3, 1.0);
  const glm::dvec3 colour = variedColour(random, shape.seedHeadColour, shape.colourVariation);
  const AxisRow& tip = rows.back();
  const int count = 26;
  const double spikelet = 0.17 * length;
  double azimuth = kTau * random.uniform();
  for (int i = 0; i < count; ++i) {
    const double along = static_cast<double>(i) / (count - 1);  // 0 at the lowest spikelet
    azimuth += kTau * 0.381966 + random.uniform(-0.3, 0.3);     // the golden angle leaves no gap
    const glm::dvec3 other = glm::cross(tip.tangent, tip.side);
    const glm::dvec3 outward = std::cos(azimuth) * tip.side + std::sin(azimuth) * other;
    const double reach = length * (0.10 + 0.13 * openness) * std::sin(std::numbers::pi * (0.18 + 0.78 * along));
    const glm::dvec3 base =
        tip.centre + tip.tangent * length * (along - 0.95) + outward * reach * random.uniform(0.2, 1.0);
    const double spread = glm::radians(12.0 + 22.0 * openness * (1.0 - along));
    const glm::dvec3 direction = std::cos(spread) * tip.tangent + std::sin(spread) * outward;
    const double size = spikelet * random.uniform(0.8, 1.2);
    const glm::dvec3 shade = colour * random.uniform(0.8, 1.15);
    appendScale(model, base, direction * size, outward, 0.17 * size, 0.75 * shade, shade, kHeadMaterial);
    const glm::dvec3 across = glm::normalize(glm::cross(direction, outward));
    appendScale(model, base, direction * size * 0.95, across, 0.15 * size, 0.75 * shade, shade, kHeadMaterial);
  }
}

void growStem(Model& model, const GrassShape& shape, base::Random& random, const Root& root) {
  Axis axis;
  axis.foot = 0.6 * root.foot;
  axis.azimuth = root.azimuth;
  axis.drift = 0.2 * cutNormal(random);
  axis.lean = glm::radians(shape.leanDeg) * std::max(0.35 + 0.2 * cutNormal(random), 0.0);
  axis.bend = glm::radians(shape.bendDeg) * std::max(0.35 + 0.2 * cutNormal(random), 0.05);
  axis.power = 2.5;
  axis.length = 1.28 * variedLength(random, shape.heightM, 0.5 * shape.heightVariation);
  axis.segments = 6;
  const std::vector<AxisRow> rows = axisRows(axis);
  const double radius = std::clamp(0.12 * shape.widthM, 0.0003, 0.0012);
  const glm::dvec3 foot = variedColour(random, shape.rootColour, shape.colourVariation);
  const glm::dvec3 top = glm::mix(shape.tipColour, shape.seedHeadColour, 0.55);
  appendTube(model, {rows, [&](double s) { return radius * (1.0 - 0.5 * s); }, 3,
                     [&](double s, double) { return glm::mix(foot, top, s); }, kHeadMaterial});
  growHead(model, shape, random, rows);
}

}  // namespace

Model growGrass(const GrassShape& shape, std::uint64_t seed) {
  Model model;
  model.name = "grass";
  model.materials.push_back(plantMaterial("blade", shape.optics));
  LeafOptics thick = shape.optics;
  thick.translucency *= 0.4;  // stems and spikelets are thicker than blades
  model.materials.push_back(plantMaterial("seed head", thick));

  const int count = std::max(shape.bladesPerPlant, 1);
  base::Random dice(base::mix64(seed, 0x67726173));
  // The share is met on average over many plants, also where it is less than one blade of this one.
  const int stems = std::clamp(static_cast<int>(std::floor(shape.seedHeadShare * count + dice.uniform())), 0, count);
  const bool drawn = !shape.heightDistribution.points().empty();
  const std::vector<double> heights =
      drawn ? drawnHeights(shape.heightDistribution, count, seed) : std::vector<double>{};
  for (int i = 0; i < count; ++i) {
    base::Random random(base::mix64(seed, static_cast<std::uint64_t>(i) + 1));
    const Root root = placeRoot(shape, random, i, count);
    // Stems are spread around the tuft rather than standing side by side.
    const bool stem = stems > 0 && (i * stems) % count < stems;
    if (stem) {
      growStem(model, shape, random, root);
    } else {
      growBlade(model, shape, random, root, drawn ? std::optional(heights[static_cast<std::size_t>(i)]) : std::nullopt);
    }
  }
  return model;
}

base::Curve builtInProfile() {
  return sampled(0.0, 1.0, 9, builtInWidth);
}

base::Curve builtInColourAlong() {
  return sampled(0.0, 1.0, 6, builtInTipPart);
}

base::Curve builtInHeightDistribution(double heightVariation) {
  // Without any variation a curve still needs some width.
  const double deviation = std::clamp(heightVariation, 0.01, 0.5);
  return sampled(1.0 - 2.0 * deviation, 1.0 + 2.0 * deviation, 9, [&](double x) {
    const double z = (x - 1.0) / deviation;
    // Zero at both ends, since a curve keeps the value of its last point beyond it.
    return std::abs(z) < 1.99 ? std::exp(-0.5 * z * z) : 0.0;
  });
}

}  // namespace sward::mesh
