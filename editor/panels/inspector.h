#pragma once

#include "panels/panel_context.h"
#include "project/project.h"
#include "widgets/fields.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace sward::editor {

/// All values of what is selected, with units, ranges, tooltips and resets; edits go out as steps named by their field.
class InspectorPanel {
 public:
  void draw(PanelContext& context);

 private:
  void head(PanelContext& context);
  void plant(PanelContext& context, std::size_t index);
  void ground(PanelContext& context);
  void view(PanelContext& context, std::size_t index);
  void sunAndSky(PanelContext& context);
  // inspector_wither.cpp
  void withering(PanelContext& context);
  void degree(PanelContext& context);
  void ageing(PanelContext& context);
  void mingling(PanelContext& context);
  void mingleSample(PanelContext& context, std::size_t index, double shareSum);
  void materialHint(PanelContext& context, std::size_t index);
  void validate(const PanelContext& context);

  /// Draws the fields of the part of a project that `part` names, and sends what was changed.
  template <typename Part>
  void fields(PanelContext& context, const std::string& path, const Part& part);
  void answer(PanelContext& context, const FieldEvents& events);
  FieldOptions options() const;
  static void heading(const char* text);

  std::string m_filter;
  bool m_advanced = false;
  bool m_editing = false;
  std::uint64_t m_validated = 0;
  std::vector<project::Problem> m_problems;
};

template <typename Part>
void InspectorPanel::fields(PanelContext& context, const std::string& path, const Part& part) {
  // Widgets work on a copy; the step that is sent puts the whole part in place.
  auto edited = std::make_shared<project::Project>(*context.project);
  auto& value = part(*edited);
  using Value = std::remove_reference_t<decltype(value)>;
  static const Value kDefaults{};
  const FieldEvents events = drawFields(path, value, kDefaults, options());
  if (events.changed) {
    context.edits.edit(
        events.label, [&](project::Project& project) { part(project) = value; }, events.path);
    m_editing = true;
  }
  answer(context, events);
}

}  // namespace sward::editor
