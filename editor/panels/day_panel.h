#pragma once

#include "panels/panel_context.h"

namespace sward::editor {

/// The day's timeline: the sun's height over 24 hours at the project's place and date, a playhead to scrub, and play.
class DayPanel {
 public:
  void draw(PanelContext& context);

 private:
  void controls(PanelContext& context);
  void timeline(PanelContext& context);
  void setHour(PanelContext& context, double hourUtc);
  bool m_dragging = false;
  double m_lastSeconds = 0.0;
};

}  // namespace sward::editor
