#pragma once

#include "panels/panel_context.h"
#include "wither/season.h"

#include <cstdint>
#include <optional>
#include <string_view>

namespace sward::editor {

/// The season's timeline: water, chlorophyll and weathering over time, a head to scrub the project's weathering degree,
/// and play, which shows other moments without touching the document.
class SeasonPanel {
 public:
  void draw(PanelContext& context);

 private:
  void controls(PanelContext& context);
  void playControls(PanelContext& context);
  void sequence(PanelContext& context);
  void degree(PanelContext& context);
  void layersNote(PanelContext& context);
  void timeline(PanelContext& context);
  void set(PanelContext& context, double weathering);
  void release(PanelContext& context);

  bool m_dragging = false;
};

/// What the season's curves are drawn in, by their path; 0 for other curves.
std::uint32_t seasonColour(std::string_view path);
/// The moment that the viewport shows: what plays, else where the project's weathering degree stands.
double shownMoment(const UiState& ui, const project::Project& project);
/// Starts or pauses the sequence, from its beginning where it had ended. It starts at the moment that is shown, where
/// the sequence has it.
void togglePlay(UiState& ui, const project::Project& project);
/// Moves what plays on by so many seconds, frame by frame at the sequence's rate; at the end it begins anew or rests.
void advancePlay(SeasonPlay& play, const project::Project& project, double seconds);

}  // namespace sward::editor
