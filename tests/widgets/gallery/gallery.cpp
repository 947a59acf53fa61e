// Draws every widget in both themes at two scales into PNG files, to be looked at: widget_gallery FOLDER.

#include "widgets/curve_editor.h"
#include "widgets/fields.h"
#include "widgets/harness.h"

#include "image/io.h"

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

void writeAll(const std::string& folder) {
  for (const ThemeKind kind : {ThemeKind::Dark, ThemeKind::Light}) {
    for (const float scale : {1.0f, 2.0f}) {
      writePage(folder, "grass", 360, 820, kind, scale, drawGrass);
      writePage(folder, "curves", 1200, 600, kind, scale, drawCurves, [](Harness& ui) {
        ui.clickAt(ui.at("curve:wide:point:1"));
        const ImVec2 p = ui.at("curve:wide:point:2");
        ui.moveTo(ImVec2(p.x + 90, p.y));
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
