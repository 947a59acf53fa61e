#include "document/selection.h"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <utility>

namespace sward::editor {
namespace {

/// The entry of a list that a selection means now. The list is not empty.
template <typename T>
Selection follow(const Selection& selection, const std::vector<T>& list) {
  std::size_t index = std::min(selection.index, list.size() - 1);
  if (list[index].name != selection.name) {
    const auto named = std::find_if(list.begin(), list.end(), [&](const T& v) { return v.name == selection.name; });
    if (named != list.end()) index = static_cast<std::size_t>(named - list.begin());
  }
  return {selection.kind, index, list[index].name};
}

/// The number in "...[12]..." right after `prefix`.
std::optional<std::size_t> indexAfter(std::string_view where, std::string_view prefix) {
  if (!where.starts_with(prefix)) return std::nullopt;
  where.remove_prefix(prefix.size());
  std::size_t index = 0;
  const auto [stop, code] = std::from_chars(where.data(), where.data() + where.size(), index);
  if (code != std::errc{} || stop == where.data() + where.size() || *stop != ']') return std::nullopt;
  return index;
}

}  // namespace

Selection selectPlant(const project::Project& project, std::size_t index) {
  if (index >= project.patch.plants.size()) return {};
  return {Selection::Kind::Plant, index, project.patch.plants[index].name};
}

Selection selectView(const project::Project& project, std::size_t index) {
  if (index >= project.views.size()) return {Selection::Kind::Render, 0, {}};
  return {Selection::Kind::View, index, project.views[index].name};
}

Selection followSelection(const Selection& selection, const project::Project& project) {
  switch (selection.kind) {
    case Selection::Kind::Plant:
      return project.patch.plants.empty() ? Selection{} : follow(selection, project.patch.plants);
    case Selection::Kind::View:
      return project.views.empty() ? Selection{Selection::Kind::Render, 0, {}} : follow(selection, project.views);
    default:
      return {selection.kind, 0, {}};
  }
}

std::optional<Selection> selectionAt(const std::string& where, const project::Project& project) {
  using Kind = Selection::Kind;
  if (const auto index = indexAfter(where, "patch.plants["); index && *index < project.patch.plants.size()) {
    return selectPlant(project, *index);
  }
  if (const auto index = indexAfter(where, "views["); index && *index < project.views.size()) {
    return selectView(project, *index);
  }
  static constexpr std::pair<std::string_view, Kind> kSections[] = {
      {"patch", Kind::Ground},   {"lights", Kind::Lights},   {"sampling", Kind::Sampling}, {"fit", Kind::Fit},
      {"tiles", Kind::Tiles},    {"terrain", Kind::Terrain}, {"wither", Kind::Wither},     {"leaf", Kind::Leaf},
      {"sun", Kind::SunSky},     {"sky", Kind::SunSky},      {"render", Kind::Render},     {"output", Kind::Render},
      {"sequence", Kind::Wither}};
  const std::string_view section = std::string_view(where).substr(0, where.find_first_of(".["));
  for (const auto& [name, kind] : kSections) {
    if (section == name) return Selection{kind, 0, {}};
  }
  return std::nullopt;
}

}  // namespace sward::editor
