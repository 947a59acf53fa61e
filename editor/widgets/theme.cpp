#include "widgets/theme.h"

#include "widgets/icons.h"

#include "image/colour.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace sward::editor {
namespace {

constexpr ImU32 rgb(unsigned hex) {
  return IM_COL32((hex >> 16) & 0xFF, (hex >> 8) & 0xFF, hex & 0xFF, 0xFF);
}
constexpr ImU32 rgba(unsigned hex, unsigned alpha) {
  return IM_COL32((hex >> 16) & 0xFF, (hex >> 8) & 0xFF, hex & 0xFF, alpha);
}

constexpr Palette kDark{
    .backdrop = rgb(0x17191A),
    .panel = rgb(0x212425),
    .raised = rgb(0x292D2E),
    .field = rgb(0x2F3435),
    .fieldHover = rgb(0x383E3F),
    .fieldActive = rgb(0x434A4B),
    .border = rgb(0x3A4041),
    .text = rgb(0xE0E4E0),
    .textDim = rgb(0xA4ACA7),
    .accent = rgb(0x86B35A),
    .accentStrong = rgb(0x9BCB6B),
    .accentFill = rgba(0x86B35A, 0x4C),
    .onAccent = rgb(0x14190F),
    .error = rgb(0xF29285),
    .warning = rgb(0xE0B255),
    .info = rgb(0x7FB2D6),
    .sun = rgb(0xFFCE5C),
    .plot = rgb(0x1A1D1E),
    .plotGrid = rgba(0xFFFFFF, 0x0E),
    .plotGridMajor = rgba(0xFFFFFF, 0x22),
    .series = {rgb(0x9BCB6B), rgb(0x6FB7E0), rgb(0xE8A25C), rgb(0xC893DB), rgb(0xE0837B), rgb(0x62C7B2)},
};

constexpr Palette kLight{
    .backdrop = rgb(0xDCDFDB),
    .panel = rgb(0xF3F4F2),
    .raised = rgb(0xE8EAE7),
    .field = rgb(0xFFFFFF),
    .fieldHover = rgb(0xF4F8F0),
    .fieldActive = rgb(0xE6EFDD),
    .border = rgb(0xC6CBC5),
    .text = rgb(0x1F2421),
    .textDim = rgb(0x5E6761),
    .accent = rgb(0x4A7A2A),
    .accentStrong = rgb(0x3A651E),
    .accentFill = rgba(0x6FA443, 0x50),
    .onAccent = rgb(0xFFFFFF),
    .error = rgb(0xB3342A),
    .warning = rgb(0x8A5F00),
    .info = rgb(0x23699B),
    .sun = rgb(0xE89A00),
    .plot = rgb(0xFBFCFA),
    .plotGrid = rgba(0x000000, 0x0E),
    .plotGridMajor = rgba(0x000000, 0x22),
    .series = {rgb(0x4A7A2A), rgb(0x1F6FA6), rgb(0xB4610F), rgb(0x7D4394), rgb(0xB0382F), rgb(0x12786A)},
};

Theme& current() {
  static Theme theme;
  return theme;
}

ImVec4 vec(ImU32 colour) {
  return ImGui::ColorConvertU32ToFloat4(colour);
}

void setSurfaces(ImVec4* c, const Palette& p) {
  c[ImGuiCol_Text] = vec(p.text);
  c[ImGuiCol_TextDisabled] = vec(p.textDim);
  c[ImGuiCol_WindowBg] = c[ImGuiCol_TitleBg] = c[ImGuiCol_TitleBgCollapsed] = vec(p.panel);
  c[ImGuiCol_TitleBgActive] = c[ImGuiCol_MenuBarBg] = c[ImGuiCol_PopupBg] = vec(p.raised);
  c[ImGuiCol_ChildBg] = c[ImGuiCol_BorderShadow] = c[ImGuiCol_TableRowBg] = ImVec4(0, 0, 0, 0);
  c[ImGuiCol_Border] = c[ImGuiCol_Separator] = vec(p.border);
  c[ImGuiCol_TableBorderStrong] = vec(p.border);
  c[ImGuiCol_TableBorderLight] = vec(faded(p.border, 0.6f));
  c[ImGuiCol_TableHeaderBg] = vec(p.raised);
  c[ImGuiCol_TableRowBgAlt] = vec(faded(p.text, 0.03f));
  c[ImGuiCol_ScrollbarBg] = ImVec4(0, 0, 0, 0);
  c[ImGuiCol_ScrollbarGrab] = vec(faded(p.textDim, 0.35f));
  c[ImGuiCol_ScrollbarGrabHovered] = vec(faded(p.textDim, 0.6f));
  c[ImGuiCol_ScrollbarGrabActive] = vec(faded(p.textDim, 0.8f));
  c[ImGuiCol_ModalWindowDimBg] = c[ImGuiCol_NavWindowingDimBg] = ImVec4(0, 0, 0, 0.45f);
}

void setControls(ImVec4* c, const Palette& p) {
  c[ImGuiCol_FrameBg] = vec(p.field);
  c[ImGuiCol_FrameBgHovered] = vec(p.fieldHover);
  c[ImGuiCol_FrameBgActive] = vec(p.fieldActive);
  c[ImGuiCol_CheckMark] = c[ImGuiCol_SliderGrab] = vec(p.accent);
  c[ImGuiCol_SliderGrabActive] = vec(p.accentStrong);
  c[ImGuiCol_Button] = vec(p.field);
  c[ImGuiCol_ButtonHovered] = vec(p.fieldHover);
  c[ImGuiCol_ButtonActive] = vec(p.fieldActive);
  c[ImGuiCol_Header] = vec(p.accentFill);
  c[ImGuiCol_HeaderHovered] = vec(faded(p.text, 0.08f));
  c[ImGuiCol_HeaderActive] = vec(faded(p.accentFill, 1.3f));
  c[ImGuiCol_SeparatorHovered] = c[ImGuiCol_ResizeGripHovered] = vec(faded(p.accent, 0.7f));
  c[ImGuiCol_SeparatorActive] = c[ImGuiCol_ResizeGripActive] = vec(p.accent);
  c[ImGuiCol_ResizeGrip] = vec(faded(p.textDim, 0.2f));
  c[ImGuiCol_Tab] = c[ImGuiCol_TabUnfocused] = ImVec4(0, 0, 0, 0);
  c[ImGuiCol_TabHovered] = vec(p.fieldHover);
  c[ImGuiCol_TabActive] = c[ImGuiCol_TabUnfocusedActive] = vec(p.field);
  c[ImGuiCol_TextSelectedBg] = vec(faded(p.accent, 0.40f));
  c[ImGuiCol_DragDropTarget] = c[ImGuiCol_NavHighlight] = vec(p.accent);
  c[ImGuiCol_NavWindowingHighlight] = vec(faded(p.accent, 0.7f));
  c[ImGuiCol_PlotLines] = c[ImGuiCol_PlotHistogram] = vec(p.accent);
  c[ImGuiCol_PlotLinesHovered] = c[ImGuiCol_PlotHistogramHovered] = vec(p.accentStrong);
}

void setMetrics(ImGuiStyle& style) {
  style.WindowPadding = ImVec2(10, 10);
  style.FramePadding = ImVec2(8, 4);
  style.CellPadding = ImVec2(4, 3);
  style.ItemSpacing = ImVec2(8, 6);
  style.ItemInnerSpacing = ImVec2(6, 4);
  style.IndentSpacing = 14;
  style.ScrollbarSize = 11;
  style.GrabMinSize = 10;
  style.WindowRounding = style.ChildRounding = style.PopupRounding = 6;
  style.FrameRounding = style.TabRounding = 4;
  style.ScrollbarRounding = 6;
  style.GrabRounding = 3;
  style.WindowTitleAlign = ImVec2(0.0f, 0.5f);
  style.WindowMenuButtonPosition = ImGuiDir_None;
  style.WindowMinSize = ImVec2(60, 40);
  style.DisabledAlpha = 0.45f;
}

/// Latin-1, and what units, arrows, mathematics and punctuation of labels need beyond it.
constexpr ImWchar kTextRanges[] = {0x0020, 0x00FF, 0x0100, 0x017F, 0x0394, 0x0394, 0x03B1, 0x03C9, 0x2010,
                                   0x2027, 0x2030, 0x2030, 0x2032, 0x2033, 0x2070, 0x2079, 0x2080, 0x2089,
                                   0x20AC, 0x20AC, 0x2190, 0x2193, 0x2196, 0x2199, 0x21E7, 0x21E7, 0x2206,
                                   0x2206, 0x2212, 0x2212, 0x221A, 0x221E, 0x2248, 0x2248, 0x2260, 0x2265,
                                   0x2318, 0x2318, 0x23CE, 0x23CE, 0x2713, 0x2717, 0};

/// The icons' code points as the pairs that ImGui reads; alive as long as the atlas may be built.
const ImWchar* iconRanges() {
  static const std::vector<ImWchar> ranges = [] {
    std::vector<ImWchar> list;
    for (const ImWchar code : icon::kCodePoints) list.insert(list.end(), {code, code});
    list.push_back(0);
    return list;
  }();
  return ranges.data();
}

/// The reader asserts on files that it cannot open, so that they are looked at before.
bool looksLikeFont(const std::string& file) {
  std::error_code code;
  return std::filesystem::is_regular_file(file, code) && std::filesystem::file_size(file, code) > 1024;
}

ImFont* addFont(ImFontAtlas& atlas, const std::string& file, float size, const FontFiles& files) {
  ImFontConfig config;
  config.OversampleH = 3;
  config.OversampleV = 2;
  ImFont* font = nullptr;
  if (looksLikeFont(file)) font = atlas.AddFontFromFileTTF(file.c_str(), size, &config, kTextRanges);
  if (font == nullptr) {
    config.SizePixels = size;
    font = atlas.AddFontDefault(&config);
  }
  if (looksLikeFont(files.icons)) {
    ImFontConfig merge;
    merge.MergeMode = true;
    merge.OversampleH = 2;
    merge.OversampleV = 2;
    const float iconSize = std::round(size * 1.12f);
    merge.GlyphMinAdvanceX = iconSize;
    merge.GlyphOffset.y = std::round(size * 0.06f);
    atlas.AddFontFromFileTTF(files.icons.c_str(), iconSize, &merge, iconRanges());
  }
  return font;
}

}  // namespace

const Palette& paletteOf(ThemeKind kind) {
  return kind == ThemeKind::Dark ? kDark : kLight;
}

const Theme& theme() {
  return current();
}

float px(float designPixels) {
  return std::round(designPixels * theme().scale);
}

void applyTheme(ThemeKind kind, float scale) {
  Theme& theme = current();
  theme.kind = kind;
  theme.scale = std::clamp(scale, kLeastScale, kGreatestScale);
  theme.colours = paletteOf(kind);
  ImGuiStyle style;
  setMetrics(style);
  style.ScaleAllSizes(theme.scale);
  // Hairlines stay whole pixels, and light fields need an edge to stand out from a light panel.
  const float line = std::max(1.0f, std::floor(theme.scale));
  style.WindowBorderSize = style.PopupBorderSize = style.ChildBorderSize = line;
  style.FrameBorderSize = kind == ThemeKind::Light ? line : 0.0f;
  setSurfaces(style.Colors, theme.colours);
  setControls(style.Colors, theme.colours);
  ImGui::GetStyle() = style;
}

std::vector<std::string> loadFonts(ImFontAtlas& atlas, float scale, const FontFiles& files) {
  const float s = std::clamp(scale, kLeastScale, kGreatestScale);
  std::vector<std::string> missing;
  const auto report = [&missing](const std::string& file, const char* what, const char* package) {
    if (looksLikeFont(file)) return;
    missing.push_back(std::string(what) + " \"" + file + "\" is missing; install Debian's package " + package + ".");
  };
  report(files.regular, "The text font", "fonts-inter");
  report(files.semiBold, "The bold font", "fonts-inter");
  report(files.icons, "The icon font", "fonts-materialdesignicons-webfont");
  atlas.Clear();
  atlas.Flags |= ImFontAtlasFlags_NoPowerOfTwoHeight;
  Fonts& fonts = current().fonts;
  fonts.body = addFont(atlas, files.regular, std::round(16.0f * s), files);
  fonts.strong = addFont(atlas, files.semiBold, std::round(16.0f * s), files);
  fonts.small = addFont(atlas, files.regular, std::round(13.5f * s), files);
  fonts.heading = addFont(atlas, files.semiBold, std::round(21.0f * s), files);
  return missing;
}

ImU32 faded(ImU32 colour, float alpha) {
  const float a = static_cast<float>((colour >> IM_COL32_A_SHIFT) & 0xFF) * alpha;
  const auto byte = static_cast<ImU32>(std::clamp(a + 0.5f, 0.0f, 255.0f));
  return (colour & ~IM_COL32_A_MASK) | (byte << IM_COL32_A_SHIFT);
}

ImU32 mixed(ImU32 a, ImU32 b, float t) {
  const ImVec4 from = vec(a), to = vec(b);
  const auto lerp = [t](float x, float y) { return x + (y - x) * t; };
  return ImGui::ColorConvertFloat4ToU32(
      ImVec4(lerp(from.x, to.x), lerp(from.y, to.y), lerp(from.z, to.z), lerp(from.w, to.w)));
}

double contrast(ImU32 a, ImU32 b) {
  const auto luminance = [](ImU32 colour) {
    const ImVec4 c = vec(colour);
    return static_cast<double>(image::luminance(image::linearFromSrgb(glm::vec3(c.x, c.y, c.z))));
  };
  const auto [low, high] = std::minmax({luminance(a), luminance(b)});
  return (high + 0.05) / (low + 0.05);
}

FontScope::FontScope(ImFont* font) : m_pushed(font != nullptr) {
  if (m_pushed) ImGui::PushFont(font);
}

FontScope::~FontScope() {
  if (m_pushed) ImGui::PopFont();
}

}  // namespace sward::editor
