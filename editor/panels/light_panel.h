#pragma once

#include "lpt/light_quality.h"
#include "panels/panel_context.h"
#include "widgets/light_palette.h"

#include <optional>
#include <vector>

namespace sward::editor {

/// The palette of baked light directions: the hemisphere with its lights, where relighting is sure of itself, patterns,
/// and how well the set determines a fit.
class LightPanel {
 public:
  void draw(PanelContext& context);

 private:
  enum class Ground { Leverage, Gap, None };
  void measure(const scene::LightOptions& options);
  void patterns(PanelContext& context);
  void figures(PanelContext& context);
  void palette(PanelContext& context, float side);

  LightPalette m_palette;
  Ground m_ground = Ground::Leverage;
  scene::LightOptions m_measured;
  std::vector<glm::dvec3> m_directions;
  std::optional<lpt::LightSetQuality> m_quality;
  HemisphereValues m_leverage, m_gap;
};

}  // namespace sward::editor
