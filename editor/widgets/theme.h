#pragma once

#include <array>
#include <string>
#include <vector>

#include <imgui.h>

namespace sward::editor {

enum class ThemeKind { Dark, Light };

/// Colours by what they are for; sRGB-encoded, straight alpha, as ImGui draws them.
struct Palette {
  ImU32 backdrop;  ///< behind everything: the gaps between panels
  ImU32 panel;     ///< a panel's body
  ImU32 raised;    ///< bars, headers and popups above a panel
  ImU32 field;     ///< where values are shown and typed
  ImU32 fieldHover;
  ImU32 fieldActive;
  ImU32 border;  ///< hairlines that separate
  ImU32 text;
  ImU32 textDim;       ///< units, hints, what is off
  ImU32 accent;        ///< grass: the selection, what is on, what was changed
  ImU32 accentStrong;  ///< the same, hovered or pressed
  ImU32 accentFill;    ///< a tint of it: bars behind numbers, selected rows
  ImU32 onAccent;      ///< text on the accent
  ImU32 error;
  ImU32 warning;
  ImU32 info;
  ImU32 sun;   ///< markers of the sun
  ImU32 plot;  ///< ground of curves and plots
  ImU32 plotGrid;
  ImU32 plotGridMajor;
  std::array<ImU32, 6> series;  ///< overlaid curves, told apart by hue and lightness
};

const Palette& paletteOf(ThemeKind kind);

/// Fonts of loadFonts(); all null before it, when ImGui's current font stands in for each.
struct Fonts {
  ImFont* body = nullptr;
  ImFont* strong = nullptr;   ///< semi-bold, the body's size
  ImFont* small = nullptr;    ///< axis labels, captions
  ImFont* heading = nullptr;  ///< semi-bold, larger
};

/// What widgets draw with. Belongs to ImGui's context and its thread, as ImGui's own style does.
struct Theme {
  ThemeKind kind = ThemeKind::Dark;
  float scale = 1.0f;
  Palette colours = paletteOf(ThemeKind::Dark);
  Fonts fonts;
};

inline constexpr float kLeastScale = 0.75f;
inline constexpr float kGreatestScale = 3.0f;

/// The theme of the last applyTheme().
const Theme& theme();

/// Sets ImGui's style of the current context: colours, spacing and rounding at `scale` (held in [0.75, 3]). Fonts stay
/// as they are: call loadFonts() when the scale changed.
void applyTheme(ThemeKind kind, float scale);

/// Where the fonts are looked for.
struct FontFiles {
  std::string regular = "/usr/share/fonts/opentype/inter/Inter-Regular.otf";
  std::string semiBold = "/usr/share/fonts/opentype/inter/Inter-SemiBold.otf";
  std::string icons = "/usr/share/fonts/truetype/materialdesignicons-webfont/materialdesignicons-webfont.ttf";
};

/// Clears the atlas and fills it with the fonts at `scale`. A file that is missing or no font is replaced by ImGui's
/// own font (for icons: nothing, a "?" shows); returns what is amiss, one sentence each with a remedy. Call it between
/// frames; the backend's font texture must be made anew afterwards.
std::vector<std::string> loadFonts(ImFontAtlas& atlas, float scale, const FontFiles& files = {});

/// A length of the design (at scale 1) in pixels of the screen, rounded to whole ones.
float px(float designPixels);

/// The same colour with its alpha multiplied by `alpha`, 0 to 1.
ImU32 faded(ImU32 colour, float alpha);
/// From a (t = 0) to b (t = 1), in encoded values.
ImU32 mixed(ImU32 a, ImU32 b, float t);

/// Contrast of two opaque colours after WCAG 2.1: 1 (none) to 21 (black on white).
double contrast(ImU32 a, ImU32 b);

/// Pushes a font while it lives; null leaves the font as it is.
class FontScope {
 public:
  explicit FontScope(ImFont* font);
  ~FontScope();
  FontScope(const FontScope&) = delete;
  FontScope& operator=(const FontScope&) = delete;

 private:
  bool m_pushed;
};

}  // namespace sward::editor
