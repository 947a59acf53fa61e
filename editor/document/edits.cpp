#include "document/edits.h"

#include "project/limits.h"
#include "wither/season.h"

#include <algorithm>
#include <cmath>

namespace sward::editor {
namespace {

constexpr std::size_t kMaxMingleSamples = 64;  ///< as the schema says

using project::Plant;
using project::Project;
using scene::SunAngles;
using scene::View;

template <typename T>
std::vector<std::string> namesOf(const std::vector<T>& list, std::size_t except = kAtEnd) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (i != except) names.push_back(list[i].name);
  }
  return names;
}

template <typename T>
std::optional<std::size_t> insertAfter(std::vector<T>& list, T entry, std::size_t after, std::size_t limit,
                                       const std::string& fallback) {
  if (list.size() >= limit) return std::nullopt;
  entry.name = uniqueName(entry.name, namesOf(list), fallback);
  const std::size_t index = after < list.size() ? after + 1 : list.size();
  list.insert(list.begin() + static_cast<std::ptrdiff_t>(index), std::move(entry));
  return index;
}

template <typename T>
bool removeAt(std::vector<T>& list, std::size_t index) {
  if (index >= list.size()) return false;
  list.erase(list.begin() + static_cast<std::ptrdiff_t>(index));
  return true;
}

template <typename T>
bool moveEntry(std::vector<T>& list, std::size_t from, std::size_t to) {
  if (from >= list.size()) return false;
  to = std::min(to, list.size() - 1);
  const auto at = [&](std::size_t i) { return list.begin() + static_cast<std::ptrdiff_t>(i); };
  if (from < to) std::rotate(at(from), at(from + 1), at(to + 1));
  if (to < from) std::rotate(at(to), at(from), at(from + 1));
  return from != to;
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

template <typename T>
std::string renameAt(std::vector<T>& list, std::size_t index, const std::string& name) {
  if (index >= list.size()) return {};
  const std::string wanted = trimmed(name);
  if (!wanted.empty()) list[index].name = uniqueName(wanted, namesOf(list, index), wanted);
  return list[index].name;
}

SunAngles inRange(const SunAngles& angles) {
  SunAngles result{std::fmod(angles.azimuthDeg, 360.0), std::clamp(angles.elevationDeg, 0.0, 90.0)};
  if (result.azimuthDeg < 0.0) result.azimuthDeg += 360.0;
  if (result.azimuthDeg >= 360.0) result.azimuthDeg = 0.0;  // a tiny negative angle rounds up to the full turn
  return result;
}

bool isFinite(const SunAngles& angles) {
  return std::isfinite(angles.azimuthDeg) && std::isfinite(angles.elevationDeg);
}

}  // namespace

std::string uniqueName(const std::string& name, const std::vector<std::string>& taken, const std::string& fallback) {
  std::string wanted = trimmed(name);
  if (wanted.empty()) wanted = fallback;
  const auto isTaken = [&](const std::string& n) { return std::find(taken.begin(), taken.end(), n) != taken.end(); };
  if (!isTaken(wanted)) return wanted;
  // "daisies 2" counts on as "daisies 3"; seven digits are a name of their own, not a count.
  const std::size_t space = wanted.find_last_of(' ');
  unsigned long number = 2;
  if (space != std::string::npos && space > 0 && space + 1 < wanted.size() && wanted.size() - space <= 7 &&
      wanted.find_first_not_of("0123456789", space + 1) == std::string::npos) {
    number = std::stoul(wanted.substr(space + 1)) + 1;
    wanted.resize(space);
  }
  while (isTaken(wanted + " " + std::to_string(number))) ++number;
  return wanted + " " + std::to_string(number);
}

std::optional<std::size_t> addPlant(Project& project, Plant plant, std::size_t after) {
  std::vector<Plant>& plants = project.patch.plants;
  if (!(plant.share > 0.0)) {
    double sum = 0.0;
    for (const Plant& other : plants) sum += other.share;
    plant.share = sum > 0.0 ? sum / static_cast<double>(plants.size()) : 1.0;
  }
  return insertAfter(plants, std::move(plant), after, project::kMaxPlantKinds, "plant");
}

std::optional<std::size_t> duplicatePlant(Project& project, std::size_t index) {
  if (index >= project.patch.plants.size()) return std::nullopt;
  return insertAfter(project.patch.plants, project.patch.plants[index], index, project::kMaxPlantKinds, "plant");
}

bool removePlant(Project& project, std::size_t index) {
  return removeAt(project.patch.plants, index);
}

bool movePlant(Project& project, std::size_t from, std::size_t to) {
  return moveEntry(project.patch.plants, from, to);
}

std::string renamePlant(Project& project, std::size_t index, const std::string& name) {
  return renameAt(project.patch.plants, index, name);
}

std::optional<std::size_t> addView(Project& project, View view, std::size_t after) {
  return insertAfter(project.views, std::move(view), after, project::kMaxViews, "view");
}

std::optional<std::size_t> duplicateView(Project& project, std::size_t index) {
  if (index >= project.views.size()) return std::nullopt;
  return insertAfter(project.views, project.views[index], index, project::kMaxViews, "view");
}

bool removeView(Project& project, std::size_t index) {
  return removeAt(project.views, index);
}

bool moveView(Project& project, std::size_t from, std::size_t to) {
  return moveEntry(project.views, from, to);
}

std::string renameView(Project& project, std::size_t index, const std::string& name) {
  return renameAt(project.views, index, name);
}

bool updateView(Project& project, std::size_t index, const View& camera) {
  if (index >= project.views.size()) return false;
  std::string name = std::move(project.views[index].name);
  project.views[index] = camera;
  project.views[index].name = std::move(name);
  return true;
}

void chooseAutumn(Project& project, wither::Autumn autumn) {
  wither::AgeingOptions& ageing = project.wither.ageing;
  if (autumn == wither::Autumn::Custom && ageing.autumn != autumn) {
    if (ageing.water.points().empty()) ageing.water = wither::waterCurve(ageing);
    if (ageing.chlorophyll.points().empty()) ageing.chlorophyll = wither::chlorophyllCurve(ageing);
  }
  ageing.autumn = autumn;
}

void setWater(Project& project, const base::Curve& curve) {
  wither::AgeingOptions& ageing = project.wither.ageing;
  if (ageing.autumn != wither::Autumn::Custom) ageing.chlorophyll = wither::chlorophyllCurve(ageing);
  ageing.water = curve;
  ageing.autumn = wither::Autumn::Custom;
}

void setChlorophyll(Project& project, const base::Curve& curve) {
  wither::AgeingOptions& ageing = project.wither.ageing;
  if (ageing.autumn != wither::Autumn::Custom) ageing.water = wither::waterCurve(ageing);
  ageing.chlorophyll = curve;
  ageing.autumn = wither::Autumn::Custom;
}

std::optional<std::size_t> addMingleSample(Project& project) {
  std::vector<wither::MingleSample>& samples = project.wither.mingle;
  wither::MingleSample sample;
  if (samples.empty()) {
    sample.name = "rest";
    samples.push_back(sample);
  }
  double sum = 0.0;
  for (const wither::MingleSample& other : samples) sum += other.share;
  sample.name = "sample";
  // As many blades as the others have on average, so that it is seen.
  sample.share = sum > 0.0 ? sum / static_cast<double>(samples.size()) : 1.0;
  return insertAfter(samples, sample, kAtEnd, kMaxMingleSamples, "sample");
}

void mingleGreenTurningStraw(Project& project) {
  const auto curve = [](std::vector<base::CurvePoint> points) {
    return base::Curve::fromPoints(std::move(points)).value();  // x increases and all is finite
  };
  project.wither.mingle = {{"green", 0.4, 1.0, curve({{0.0, 0.0}, {0.5, 0.05}, {1.0, 0.35}})},
                           {"turning", 0.35, 1.0, curve({{0.0, 0.0}, {1.0, 1.0}})},
                           {"straw", 0.25, 1.0, curve({{0.0, 0.0}, {0.2, 0.6}, {0.4, 0.9}, {1.0, 1.0}})}};
}

bool removeMingleSample(Project& project, std::size_t index) {
  return removeAt(project.wither.mingle, index);
}

bool convertToList(Project& project, const std::vector<SunAngles>& directions) {
  if (directions.empty() || directions.size() > std::size_t{project::kMaxLights}) return false;
  if (!std::all_of(directions.begin(), directions.end(), isFinite)) return false;
  project.lights.pattern = scene::LightPattern::List;
  project.lights.directions.clear();
  for (const SunAngles& angles : directions) project.lights.directions.push_back(inRange(angles));
  return true;
}

void usePattern(Project& project, scene::LightPattern pattern, int count) {
  project.lights.pattern = pattern;
  project.lights.count = std::clamp(count, 1, project::kMaxLights);
}

std::optional<std::size_t> addLight(Project& project, const SunAngles& angles) {
  scene::LightOptions& lights = project.lights;
  if (lights.pattern != scene::LightPattern::List || !isFinite(angles)) return std::nullopt;
  if (lights.directions.size() >= std::size_t{project::kMaxLights}) return std::nullopt;
  lights.directions.push_back(inRange(angles));
  return lights.directions.size() - 1;
}

bool moveLight(Project& project, std::size_t index, const SunAngles& angles) {
  scene::LightOptions& lights = project.lights;
  if (lights.pattern != scene::LightPattern::List || !isFinite(angles)) return false;
  if (index >= lights.directions.size()) return false;
  lights.directions[index] = inRange(angles);
  return true;
}

bool removeLight(Project& project, std::size_t index) {
  scene::LightOptions& lights = project.lights;
  if (lights.pattern != scene::LightPattern::List || lights.directions.size() < 2) return false;
  return removeAt(lights.directions, index);
}

}  // namespace sward::editor
