#include "methods.h"

#include "lpt/representation.h"
#include "project/nearest.h"
#include "project/words.h"

#include <optional>

namespace sward::editor {
namespace {

std::vector<std::string> allNames() {
  std::vector<std::string> names;
  for (const auto& word : project::words(render::GroundMethod{})) names.emplace_back(word.text);
  for (const lpt::Method& method : lpt::kMethods) names.emplace_back(method.name);
  return names;
}

Result<void> applyMethod(const std::string& name, project::Project& project, bool& drawGiven, bool& fitGiven) {
  const Error twice = Error::badInput("two methods of the same kind are given, the second is \"" + name + "\"",
                                      "--method", "Give one way to draw and one fit at most.");
  if (const auto draw = project::fromWord<render::GroundMethod>(name)) {
    if (std::exchange(drawGiven, true)) return twice;
    project.render.method = *draw;
    return {};
  }
  if (const lpt::Method* method = lpt::findMethod(name)) {
    if (std::exchange(fitGiven, true)) return twice;
    project.fit = method->options(project.fit);
    return {};
  }
  const std::string nearest = project::nearestName(name, allNames());
  return Error::badInput(
      "there is no method \"" + name + "\"", "--method",
      (nearest.empty() ? "" : "Did you mean \"" + nearest + "\"? ") + ("Methods: " + methodNames() + "."));
}

}  // namespace

std::string methodNames() {
  std::string text;
  for (const std::string& name : allNames()) text += (text.empty() ? "" : ", ") + name;
  return text;
}

Result<void> applyMethods(const std::vector<std::string>& methods, project::Project& project) {
  bool drawGiven = false, fitGiven = false;
  for (const std::string& name : methods) SWARD_TRY(applyMethod(name, project, drawGiven, fitGiven));
  return {};
}

}  // namespace sward::editor
