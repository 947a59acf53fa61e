#pragma once

#include "base/curve.h"
#include "project/project.h"
#include "project/spec.h"

#include <string>
#include <vector>

namespace sward::editor {

/// One curve of a project: where it stands, what its axes mean.
struct CurveEntry {
  std::string path;   ///< "patch.plants[0].grass.profile"
  std::string owner;  ///< path of the plant or other struct that it belongs to: "patch.plants[0]"
  project::Spec spec;
  base::Curve curve;    ///< empty: the built-in one is in use
  base::Curve builtIn;  ///< what holds while `curve` is empty; empty where nothing is built in
};

/// Every curve that is in use, in the order of the schema.
std::vector<CurveEntry> curvesOf(const project::Project& project);
/// Puts a curve in place; false when there is none at that path.
bool setCurve(project::Project& project, const std::string& path, const base::Curve& curve);

}  // namespace sward::editor
