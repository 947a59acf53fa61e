#include "scene/patch.h"

#include "base/check.h"
#include "base/random.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

namespace sward::scene {
namespace {

/// Plants that one cluster gathers on average.
constexpr double kPlantsPerCluster = 12.0;
/// How far full clumping draws a plant toward its cluster's centre: between half of this and all of it.
constexpr double kClusterPull = 0.9;
constexpr double kSmallestScale = 0.05;

double wrapUnit(double x) {
  const double rest = x - std::floor(x);
  return rest < 1.0 ? rest : 0.0;
}

/// `count` points of the periodic unit square, one in each cell of rows whose cells differ by at most one in number:
/// stratified for any count. Rows are shifted against each other so that no columns show.
std::vector<glm::dvec2> stratifiedPoints(int count, base::Random& random) {
  std::vector<glm::dvec2> points;
  points.reserve(static_cast<std::size_t>(count));
  const int rows = std::max(1, static_cast<int>(std::lround(std::sqrt(static_cast<double>(count)))));
  const glm::dvec2 shift(random.uniform(), random.uniform());
  for (int row = 0; row < rows; ++row) {
    const auto before = static_cast<std::int64_t>(count) * row / rows;
    const auto cells = static_cast<std::int64_t>(count) * (row + 1) / rows - before;
    const double phase = random.uniform();
    for (std::int64_t cell = 0; cell < cells; ++cell) {
      const double x = (static_cast<double>(cell) + random.uniform() + phase) / static_cast<double>(cells);
      const double y = (row + random.uniform()) / rows;
      points.emplace_back(wrapUnit(x + shift.x), wrapUnit(y + shift.y));
    }
  }
  return points;
}

/// The shortest vector from a to b on the periodic unit square.
glm::dvec2 periodicOffset(const glm::dvec2& a, const glm::dvec2& b) {
  const glm::dvec2 d = b - a;
  return d - glm::round(d);
}

/// Draws every point toward the nearest of some random centres, by an amount that grows with `clumping`.
void clump(std::vector<glm::dvec2>& points, double clumping, base::Random& random) {
  if (clumping <= 0.0 || points.empty()) return;
  const auto clusters = std::max<std::int64_t>(1, std::llround(static_cast<double>(points.size()) / kPlantsPerCluster));
  std::vector<glm::dvec2> centres;
  for (std::int64_t i = 0; i < clusters; ++i) {
    const double x = random.uniform();
    centres.emplace_back(x, random.uniform());
  }
  for (glm::dvec2& point : points) {
    glm::dvec2 toNearest(0.0);
    double nearest = std::numeric_limits<double>::infinity();
    for (const glm::dvec2& centre : centres) {
      const glm::dvec2 offset = periodicOffset(point, centre);
      const double distance = glm::dot(offset, offset);
      if (distance < nearest) {
        nearest = distance;
        toNearest = offset;
      }
    }
    const double pull = std::min(clumping, 1.0) * kClusterPull * random.uniform(0.5, 1.0);
    point = {wrapUnit(point.x + pull * toNearest.x), wrapUnit(point.y + pull * toNearest.y)};
  }
}

/// 1 + variation times a standard normal, cut at two standard deviations.
double randomScale(double variation, base::Random& random) {
  double deviation = random.normal();
  while (std::abs(deviation) > 2.0) deviation = random.normal();
  return std::max(kSmallestScale, 1.0 + variation * deviation);
}

/// Keeps a foot inside [0, side) after rounding to float.
float footCoordinate(double unit, double side) {
  const auto at = static_cast<float>(unit * side);
  return at < static_cast<float>(side) ? at : 0.0f;
}

Instance randomInstance(const PlantScatter& plant, std::uint32_t model, const glm::dvec2& unitPlace, double sideM,
                        base::Random& random) {
  const double turn = random.uniform(0.0, 2.0 * std::numbers::pi);
  const double tilt = random.uniform(0.0, plant.tiltDeg) * std::numbers::pi / 180.0;
  const double tiltAzimuth = random.uniform(0.0, 2.0 * std::numbers::pi);
  const double scale = randomScale(plant.sizeVariation, random);
  const glm::dvec3 tiltAxis(-std::sin(tiltAzimuth), std::cos(tiltAzimuth), 0.0);
  glm::dmat4 rotation = glm::rotate(glm::dmat4(1.0), tilt, tiltAxis);
  rotation = glm::rotate(rotation, turn, glm::dvec3(0.0, 0.0, 1.0));
  Instance instance;
  instance.model = model;
  for (int column = 0; column < 3; ++column) {
    instance.worldFromModel[column] = glm::vec3(scale * glm::dvec3(rotation[column]));
  }
  instance.worldFromModel[3] = {footCoordinate(unitPlace.x, sideM), footCoordinate(unitPlace.y, sideM), 0.0f};
  return instance;
}

void scatterPlant(Patch& patch, const PlantScatter& plant, base::Random random) {
  std::vector<std::uint32_t> models;
  for (const std::uint32_t model : plant.models) {
    SWARD_CHECK_LT(model, patch.models.size());
    if (patch.models[model] && !patch.models[model]->empty()) models.push_back(model);
  }
  // The same number of draws whatever the count, so that the fraction is settled independently of the places.
  const double chance = random.uniform();
  if (models.empty() || !(plant.count > 0.0)) return;
  SWARD_CHECK_LT(plant.count, 1e8);
  const int count = static_cast<int>(std::floor(plant.count + chance));
  std::vector<glm::dvec2> places = stratifiedPoints(count, random);
  clump(places, plant.clumping, random);
  for (const glm::dvec2& place : places) {
    const std::uint32_t model = models[random.index(static_cast<std::uint32_t>(models.size()))];
    patch.instances.push_back(randomInstance(plant, model, place, patch.sideM, random));
  }
}

/// The vertices that triangles use, each once.
std::vector<glm::vec3> usedPositions(const mesh::Model& model) {
  std::vector<char> used(model.positions.size(), 0);
  for (const glm::uvec3& corner : model.triangles) used[corner.x] = used[corner.y] = used[corner.z] = 1;
  std::vector<glm::vec3> positions;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i] != 0) positions.push_back(model.positions[i]);
  }
  return positions;
}

/// Top of the highest instance.
double patchHeight(const Patch& patch) {
  std::vector<std::vector<glm::vec3>> positions;
  std::vector<float> reach;  // farthest vertex from the foot: an upper bound of the height that saves the exact one
  for (const auto& model : patch.models) {
    positions.push_back(model ? usedPositions(*model) : std::vector<glm::vec3>{});
    float farthest = 0.0f;
    for (const glm::vec3& p : positions.back()) farthest = std::max(farthest, glm::length(p));
    reach.push_back(farthest);
  }
  float top = 0.0f;
  for (const Instance& instance : patch.instances) {
    const glm::mat4x3& m = instance.worldFromModel;
    const glm::vec3 zRow(m[0].z, m[1].z, m[2].z);
    if (m[3].z + 1.0001f * glm::length(zRow) * reach[instance.model] <= top) continue;
    for (const glm::vec3& p : positions[instance.model]) top = std::max(top, (m * glm::vec4(p, 1.0f)).z);
  }
  return static_cast<double>(top);
}

}  // namespace

Patch scatter(double sideM, std::vector<std::shared_ptr<const mesh::Model>> models,
              const std::vector<PlantScatter>& plants, std::uint64_t seed) {
  SWARD_CHECK_GT(sideM, 0.0);
  Patch patch;
  patch.sideM = sideM;
  patch.models = std::move(models);
  for (std::size_t kind = 0; kind < plants.size(); ++kind) {
    // A stream of its own for each kind: adding a plant does not move the others.
    scatterPlant(patch, plants[kind], base::Random(base::mix64(seed, kind)));
  }
  patch.heightM = patchHeight(patch);
  return patch;
}

}  // namespace sward::scene
