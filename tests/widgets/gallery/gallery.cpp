// Draws every widget in both themes at two scales into PNG files, to be looked at: widget_gallery FOLDER.

#include "widgets/curve_editor.h"
#include "widgets/fields.h"
#include "widgets/file_dialog.h"
#include "widgets/harness.h"
#include "widgets/icons.h"
#include "widgets/light_palette.h"
#include "widgets/parts.h"
#include "widgets/sky_dome.h"
#include "widgets/toasts.h"

#include "image/io.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>

namespace sward::editor {
namespace {

mesh::GrassShape changedGrass() {
  mesh::GrassShape grass;
  grass.heightM = 0.62;
  grass.widthM = 2.0;
  grass.tipColour = {0.2, 0.35, 0.06};
  grass.profile = base::Curve::fromPoints({{0, 0.4}, {0.3, 1.0}, {0.8, 0.6}, {1, 0.05}}).value();
  return grass;
}

FieldOptions everything() {
  FieldOptions options;
  options.advanced = true;
  return options;
}

void drawGrass() {
  static mesh::GrassShape grass = changedGrass();
  drawFields("patch.plants[0].grass", grass, mesh::GrassShape{}, everything());
}

void drawPlant() {
  static project::Plant plant = [] {
    project::Plant p;
    p.kind = project::PlantKind::Gltf;
    p.gltf.material.emplace();
    p.gltf.material->baseColour = glm::dvec3(0.3, 0.2, 0.1);
    return p;
  }();
  drawFields("patch.plants[1]", plant, project::Plant{}, {});
  static scene::View view;
  drawFields("views[0]", view, scene::View{});
  static project::Soil soil;
  drawFields("patch.soil", soil, project::Soil{});
}

/// A curve editor with three curves, in the sizes that it is used at.
void drawCurves() {
  static base::Curve width = base::Curve::fromPoints({{0, 0.3}, {0.22, 0.85}, {0.55, 0.7}, {1, 0.04}}).value();
  static base::Curve red = base::Curve::fromPoints({{0, 0.12}, {0.6, 0.3}, {1, 0.62}}).value();
  static base::Curve green = base::Curve::fromPoints({{0, 0.2}, {0.5, 0.6}, {1, 0.5}}).value();
  static base::Curve none;
  static base::Curve taper = base::Curve::fromPoints({{0, 0.6}, {0.3, 1}, {0.7, 0.7}, {1, 0}}).value();
  static CurveEditor large, small, wide, empty;
  std::vector<CurveLayer> layers{{.name = "Width", .curve = &width, .colour = 0},
                                 {.name = "Red", .curve = &red, .colour = 0},
                                 {.name = "Green", .curve = &green, .colour = 0, .visible = true, .locked = true}};
  CurveAxes axes;
  axes.xLabel = "Along the blade";
  axes.yLabel = "Relative width";
  const std::vector<CurvePreset> presets{{"Taper", taper}};
  const float s = theme().scale;
  wide.draw("wide", layers, axes, ImVec2(1180 * s, 300 * s), presets);
  ImGui::Dummy(ImVec2(0, px(8)));
  large.draw("large", layers, axes, ImVec2(560 * s, 260 * s), presets);
  ImGui::SameLine(0, px(20));
  ImGui::BeginGroup();
  small.draw("small", std::span(layers.data(), 1), axes, ImVec2(300 * s, 120 * s), presets);
  std::vector<CurveLayer> builtIn{{.name = "Profile", .curve = &none, .colour = 0}};
  builtIn[0].builtIn = &taper;
  empty.draw("empty", builtIn, axes, ImVec2(300 * s, 120 * s), presets);
  ImGui::EndGroup();
}

/// Four skies, a palette with values and one without.
void drawSkies() {
  static std::array<SkyAngles, 4> suns{{{225, 38}, {262, 6}, {285, -7}, {140, 62}}};
  const float side = px(270);
  for (std::size_t i = 0; i < suns.size(); ++i) {
    if (i > 0) ImGui::SameLine();
    std::vector<SkyAngles> path;
    for (int hour = 0; hour < 24 && i == 3; ++hour) path.push_back({15.0 * hour, 62.0 - 5.5 * std::abs(hour - 9)});
    SkyDomeOptions options;
    options.path = path;
    skyDome(("dome" + std::to_string(i)).c_str(), suns[i], side, options);
  }
  static std::vector<scene::SunAngles> lights;
  if (lights.empty()) {
    for (int i = 0; i < 15; ++i) {
      const double z = (i + 0.5) / 15.0;
      lights.push_back({std::fmod(137.508 * i, 360.0), glm::degrees(std::asin(z))});
    }
  }
  static LightPalette plain, painted;
  plain.select({4});
  plain.draw("plain", lights, true, px(360), SkyAngles{225, 38});
  ImGui::SameLine(0, px(30));
  HemisphereValues values;
  values.side = 48;
  values.title = "Nearest light";
  values.unit = "\u00B0";
  values.high = 40.0;
  for (int row = 0; row < values.side; ++row) {
    for (int column = 0; column < values.side; ++column) {
      const glm::dvec2 place = HemisphereValues::place(values.side, column, row);
      double nearest = 2.0;
      for (const scene::SunAngles& light : lights) {
        nearest = std::min(nearest,
                           glm::distance(place, discPlace({light.azimuthDeg, light.elevationDeg}, DiscMap::EqualArea)));
      }
      values.values.push_back(static_cast<float>(80.0 * nearest));
    }
  }
  painted.draw("painted", lights, false, px(360), SkyAngles{225, 38}, &values);
}

void drawParts(Toasts& toasts) {
  static std::string search = "height", none;
  static bool on = true, off = false;
  iconButton("new", icon::kNew, "New");
  for (const auto& [id, sign] : {std::pair{"open", icon::kFolder}, {"save", icon::kSave}, {"undo", icon::kUndo}}) {
    ImGui::SameLine(0, px(2));
    iconButton(id, sign, id);
  }
  ImGui::SameLine(0, px(2));
  iconButton("redo", icon::kRedo, "Redo", "", false);
  ImGui::SameLine(0, px(12));
  toolToggle("snap", icon::kSnap, true, "Snap");
  ImGui::SameLine(0, px(2));
  toolToggle("grid", icon::kGrid, false, "Grid");
  ImGui::SameLine(0, px(20));
  primaryButton("render", "Render");
  ImGui::SameLine();
  plainButton("cancel", "Cancel");
  ImGui::SameLine();
  primaryButton("no", "Render", false);
  searchBox("a", search, px(240));
  ImGui::SameLine();
  searchBox("b", none, px(240), "Search actions");
  tickBox("on", on);
  ImGui::SameLine();
  tickBox("off", off);
  ImGui::SameLine(0, px(20));
  keyCaps("Ctrl+Shift+S");
  ImGui::SameLine(0, px(20));
  keyCaps("F");
  progressPill("known", "Baking meadow  \u00B7  12 s left", 0.4f, px(260), true);
  ImGui::SameLine();
  progressPill("unknown", "Drawing", -1.0f, px(160));
  sectionHeader("plants", "Plants", true, "3");
  static const std::array<const char*, 4> kNames{"Fescue", "Ox-eye daisy", "White clover", "A mesh of a long name"};
  static const std::array<const char*, 4> kIcons{icon::kLeaf, icon::kFlower, icon::kLeaf, icon::kModel};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (i > 0) ImGui::SameLine();
    thumbnailCell(kNames[i], kNames[i], nullptr, kIcons[i], i == 1, px(92));
  }
  sectionHeader("lights", "Light directions", false, "15");
  hint("Drag a glTF file into the window to plant your own mesh.");
  toasts.draw(ImVec2(0, 0), ImGui::GetIO().DisplaySize);
}

void writePage(const std::string& folder, const char* name, float w, float h, ThemeKind kind, float scale,
               const std::function<void()>& draw, const std::function<void(Harness&)>& drive = {}) {
  Harness ui(w * scale, h * scale, kind, scale);
  ui.show(draw);
  if (drive) drive(ui);
  ui.frames(2);
  const std::string file = folder + "/" + name + (kind == ThemeKind::Dark ? "-dark-" : "-light-") +
                           std::to_string(static_cast<int>(scale)) + ".png";
  if (const auto written = image::writePng(file, ui.picture()); !written.ok()) {
    std::fprintf(stderr, "%s\n", written.error().text().c_str());
  }
}

void writeParts(const std::string& folder, ThemeKind kind, float scale) {
  Toasts toasts;
  toasts.add(Severity::Done, "Saved meadow.sward");
  toasts.add(Severity::Warning, "meadow.sward changed on disk since it was opened here.", "Reload");
  toasts.add(Severity::Error, "The picture could not be written: the disk is full. Free some space and try again.");
  writePage(folder, "parts", 620, 640, kind, scale, [&toasts] { drawParts(toasts); });
}

void writeDialog(const std::string& folder, ThemeKind kind, float scale) {
  FileDialog dialog;
  FileDialogOptions options;
  options.mode = FileDialogMode::Save;
  options.title = "Save the project";
  options.folder = std::filesystem::path(SWARD_SOURCE_DIR) / "core";
  options.name = "meadow";
  options.filters = {{"All files", {}}};
  options.places = {{"Sample projects", std::filesystem::path(SWARD_SOURCE_DIR) / "projects"}};
  writePage(
      folder, "dialog", 900, 600, kind, scale, [&] { dialog.draw(); },
      [&](Harness& ui) {
        dialog.open(options);
        ui.frames(4);
        ui.moveTo(ui.at("file:bake"));
        ui.click("file:gpu");
        ui.moveTo(ui.at("file:bake"));
      });
}

void writeAll(const std::string& folder) {
  for (const ThemeKind kind : {ThemeKind::Dark, ThemeKind::Light}) {
    for (const float scale : {1.0f, 2.0f}) {
      writePage(folder, "grass", 360, 820, kind, scale, drawGrass);
      writePage(folder, "curves", 1200, 600, kind, scale, drawCurves, [](Harness& ui) {
        ui.clickAt(ui.at("curve:wide:point:1"));
        const ImVec2 p = ui.at("curve:wide:point:2");
        ui.moveTo(ImVec2(p.x + 90, p.y));
      });
      writePage(folder, "sky", 1180, 730, kind, scale, drawSkies);
      writeParts(folder, kind, scale);
      writeDialog(folder, kind, scale);
      writePage(folder, "picker", 480, 560, kind, scale, drawGrass, [](Harness& ui) {
        ui.click("field:patch.plants[0].grass.rootColour");
        ui.frames(3);
      });
      writePage(folder, "tooltip", 480, 400, kind, scale, drawGrass, [](Harness& ui) {
        ui.moveTo(ui.at("label:patch.plants[0].grass.widthM"));
        ui.frames(40);
      });
      writePage(folder, "menu", 480, 400, kind, scale, drawGrass, [](Harness& ui) {
        ui.click("label:patch.plants[0].grass.heightM", 1);
        ui.frames(3);
      });
      writePage(folder, "plant", 360, 900, kind, scale, drawPlant);
    }
  }
}

}  // namespace
}  // namespace sward::editor

int main(int count, char** arguments) {
  const std::string folder = count > 1 ? arguments[1] : ".";
  std::filesystem::create_directories(folder);
  sward::editor::writeAll(folder);
  return 0;
}
