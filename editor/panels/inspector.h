#pragma once

#include "panels/panel_context.h"
#include "project/project.h"
#include "widgets/fields.h"

#include <cstdint>
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
  void materialHint(PanelContext& context, std::size_t index);
  void validate(const PanelContext& context);

  /// Draws the fields of the part of a project that `part` names, and sends what was changed.
  template <typename Part>
  void fields(PanelContext& context, const std::string& path, const Part& part);
  void answer(PanelContext& context, const FieldEvents& events);
  FieldOptions options() const;

  std::string m_filter;
  bool m_advanced = false;
  bool m_editing = false;
  std::uint64_t m_validated = 0;
  std::vector<project::Problem> m_problems;
};

}  // namespace sward::editor
