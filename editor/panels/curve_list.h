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
  std::string owner;  ///< what it is shown with: a plant's path, "patch.plants[0]", or "wither"
  std::string label;  ///< the schema's, or the name of the sample that ages by it
  project::Spec spec;
  base::Curve curve;  ///< empty: the built-in one is in use; of water and chlorophyll the autumn's
  /// What holds while `curve` is empty, such as an autumn's water; empty where nothing is built in.
  base::Curve builtIn;
};

/// Every curve that is in use, in the order of the schema.
std::vector<CurveEntry> curvesOf(const project::Project& project);
/// Puts a curve in place; false when there is none at that path. Water and chlorophyll make the autumn one of own
/// curves; a curve that may not fall (weathering degrees) is lifted to where it does not.
bool setCurve(project::Project& project, const std::string& path, const base::Curve& curve);

}  // namespace sward::editor
