#pragma once

#include "app/actions.h"

#include <string>

namespace sward::editor {

/// The command palette: type a few letters of any action, arrows choose, Enter runs it.
class CommandPalette {
 public:
  void open() { m_opening = true; }
  /// Draws the popup while it is open and runs what was chosen.
  void draw(const ActionTable& actions, int width, int height);

 private:
  const Action* row(const Action& action, bool selected, float width);

  bool m_opening = false;
  std::string m_query;
  int m_selected = 0;
};

}  // namespace sward::editor
