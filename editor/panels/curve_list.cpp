#include "panels/curve_list.h"

#include "document/edits.h"
#include "mesh/procedural.h"
#include "project/schema.h"
#include "wither/season.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <string_view>
#include <utility>

namespace sward::editor {
namespace {

using project::describe;  // structs of other folders are described there

/// The archive that visits every curve in use with its path.
class CurveVisitor {
 public:
  template <typename T>
  using Ref = T&;
  using Visit = std::function<void(const std::string& path, base::Curve& curve, const project::Spec& spec)>;

  CurveVisitor(std::string path, const Visit& visit) : m_path(std::move(path)), m_visit(visit) {}

  void version(int) {}
  template <typename T>
  void field(const char* name, T& value, const project::Spec& spec = {}) {
    walk(m_path.empty() ? std::string(name) : m_path + "." + name, value, spec);
  }
  template <typename T>
  void field(const char* name, std::optional<T>& value, const project::Spec& spec = {}) {
    if (value.has_value()) field(name, *value, spec);
  }
  template <typename T>
  void choice(const char* name, T& value, bool used, const project::Spec& spec = {}) {
    if (used) field(name, value, spec);
  }

 private:
  template <typename T>
  void walk(const std::string& path, T& value, const project::Spec&) {
    if constexpr (requires(CurveVisitor & inner) { describe(inner, value); }) {
      CurveVisitor inner(path, m_visit);
      describe(inner, value);
    }
  }
  template <typename T>
  void walk(const std::string& path, std::vector<T>& values, const project::Spec& spec) {
    for (std::size_t i = 0; i < values.size(); ++i) walk(path + "[" + std::to_string(i) + "]", values[i], spec);
  }
  void walk(const std::string& path, base::Curve& curve, const project::Spec& spec) { m_visit(path, curve, spec); }

  std::string m_path;
  const Visit& m_visit;
};

constexpr std::string_view kWater = "wither.ageing.water", kChlorophyll = "wither.ageing.chlorophyll";

/// Degrees of weathering over time or over one another.
bool mayNotFall(std::string_view path) {
  return path.starts_with("wither.") && path != kWater && path != kChlorophyll;
}

base::Curve neverFalling(const base::Curve& curve) {
  std::vector<base::CurvePoint> points = curve.points();
  for (std::size_t i = 1; i < points.size(); ++i) points[i].y = std::max(points[i].y, points[i - 1].y);
  return base::Curve::fromPoints(std::move(points)).value();  // x and finiteness are as they were
}

base::Curve diagonal() {
  return base::Curve::fromPoints({{0.0, 0.0}, {1.0, 1.0}}).value();
}

std::string ownerOf(const std::string& path) {
  if (path.starts_with("wither.") || path.starts_with("sequence.")) return "wither";
  const std::size_t bracket = path.find(']');
  return bracket == std::string::npos ? "" : path.substr(0, bracket + 1);
}

std::string labelOf(const project::Project& project, const std::string& path, const project::Spec& spec) {
  for (std::size_t i = 0; i < project.wither.mingle.size(); ++i) {
    if (path == "wither.mingle[" + std::to_string(i) + "].ageing") return project.wither.mingle[i].name;
  }
  return spec.label;
}

/// What holds without a curve of its own.
base::Curve builtInOf(const project::Project& project, const std::string& path, const std::string& owner) {
  if (path == kWater) return wither::waterCurve(project.wither.ageing);
  if (path == kChlorophyll) return wither::chlorophyllCurve(project.wither.ageing);
  if (mayNotFall(path) || path == "sequence.season") return diagonal();
  if (path == "sequence.hourUtc") return base::Curve::constant(project.sun.moment.hourUtc);
  for (std::size_t i = 0; i < project.patch.plants.size(); ++i) {
    if (owner != "patch.plants[" + std::to_string(i) + "]") continue;
    if (path.ends_with(".grass.profile")) return mesh::builtInProfile();
    if (path.ends_with(".grass.colourAlong")) return mesh::builtInColourAlong();
    if (path.ends_with(".grass.heightDistribution"))
      return mesh::builtInHeightDistribution(project.patch.plants[i].grass.heightVariation);
  }
  return {};
}

}  // namespace

std::vector<CurveEntry> curvesOf(const project::Project& project) {
  std::vector<CurveEntry> curves;
  project::Project copy = project;
  const CurveVisitor::Visit visit = [&](const std::string& path, base::Curve& curve, const project::Spec& spec) {
    const std::string owner = ownerOf(path);
    CurveEntry entry{path, owner, labelOf(project, path, spec), spec, curve, builtInOf(project, path, owner)};
    // Own curves rest while the autumn is another one, whose points can be taken hold of all the same.
    const bool ofAutumn = path == kWater || path == kChlorophyll;
    if (ofAutumn && project.wither.ageing.autumn != wither::Autumn::Custom) entry.curve = entry.builtIn;
    curves.push_back(std::move(entry));
  };
  CurveVisitor visitor("", visit);
  describe(visitor, copy);
  return curves;
}

bool setCurve(project::Project& project, const std::string& path, const base::Curve& curve) {
  if (path == kWater) setWater(project, curve);
  if (path == kChlorophyll) setChlorophyll(project, curve);
  if (path == kWater || path == kChlorophyll) return true;
  bool found = false;
  const CurveVisitor::Visit visit = [&](const std::string& at, base::Curve& place, const project::Spec&) {
    if (at != path) return;
    place = mayNotFall(path) ? neverFalling(curve) : curve;
    found = true;
  };
  CurveVisitor visitor("", visit);
  describe(visitor, project);
  return found;
}

}  // namespace sward::editor
