#include "panels/outliner.h"

#include "document/edits.h"
#include "panels/thumbnails.h"
#include "widgets/icons.h"
#include "widgets/item_log.h"
#include "widgets/theme.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include <imgui.h>
#include <imgui_stdlib.h>

namespace sward::editor {
namespace {

constexpr float kRowHeight = 26.0f, kPlantHeight = 44.0f;
constexpr const char* kPlantDrag = "SWARD_PLANT";

const char* iconOf(project::PlantKind kind) {
  switch (kind) {
    case project::PlantKind::Flower:
      return icon::kFlower;
    case project::PlantKind::Gltf:
      return icon::kModel;
    case project::PlantKind::Grass:
    case project::PlantKind::Clover:
      return icon::kLeaf;
  }
  return icon::kLeaf;
}

std::string plantHint(const project::Plant& plant, double shareSum) {
  std::array<char, 96> text{};
  const double percent = shareSum > 0.0 ? 100.0 * plant.share / shareSum : 0.0;
  std::snprintf(text.data(), text.size(), "%.0f %% of the ground, %.0f per m\xC2\xB2", percent, plant.densityPerM2);
  return text.data();
}

void title(const char* text) {
  ImGui::Dummy({0.0f, px(6.0f)});
  const FontScope font(theme().fonts.small);
  ImGui::SetCursorPosX(px(12.0f));
  ImGui::TextDisabled("%s", text);
}

}  // namespace

void OutlinerPanel::draw(PanelContext& context) {
  plants(context);
  row(context, icon::kTerrain, "Terrain", {Selection::Kind::Terrain, 0, {}}, "");
  title("SEASON");
  row(context, icon::kTimer, "Withering", {Selection::Kind::Wither, 0, {}}, "");
  row(context, icon::kPalette, "Leaf colour", {Selection::Kind::Leaf, 0, {}}, "");
  title("LIGHT");
  row(context, icon::kSun, "Sun and sky", {Selection::Kind::SunSky, 0, {}}, "");
  row(context, icon::kLight, "Light directions", {Selection::Kind::Lights, 0, {}}, "");
  cameras(context);
  title("BAKE AND PICTURE");
  row(context, icon::kLayers, "Layers", {Selection::Kind::Sampling, 0, {}}, "");
  row(context, icon::kChart, "Relighting", {Selection::Kind::Fit, 0, {}}, "");
  row(context, icon::kViewGrid, "Tiles", {Selection::Kind::Tiles, 0, {}}, "");
  row(context, icon::kImage, "Picture", {Selection::Kind::Render, 0, {}}, "");
}

bool OutlinerPanel::row(PanelContext& context, const char* icon, const std::string& label, const Selection& selection,
                        const std::string& hint) {
  const bool chosen = context.ui.selection.kind == selection.kind && context.ui.selection.index == selection.index;
  const ImVec2 start = ImGui::GetCursorPos();
  const std::string id =
      "##" + label + std::to_string(static_cast<int>(selection.kind)) + "." + std::to_string(selection.index);
  const bool clicked =
      ImGui::Selectable(id.c_str(), chosen, ImGuiSelectableFlags_AllowDoubleClick, {0.0f, px(kRowHeight)});
  logItem("outliner:", label);
  if (clicked) context.ui.selection = selection;
  const float middle = start.y + 0.5f * (px(kRowHeight) - ImGui::GetTextLineHeight());
  ImGui::SetCursorPos({px(14.0f), middle});
  ImGui::TextUnformatted(icon);
  ImGui::SetCursorPos({px(40.0f), middle});
  ImGui::TextUnformatted(label.c_str());
  if (!hint.empty()) {
    ImGui::SameLine();
    ImGui::TextDisabled("%s", hint.c_str());
  }
  ImGui::SetCursorPos({start.x, start.y + px(kRowHeight)});
  return clicked;
}

void OutlinerPanel::plants(PanelContext& context) {
  title("PATCH");
  row(context, icon::kTexture, "Ground", {Selection::Kind::Ground, 0, {}}, "");
  double shareSum = 0.0;
  for (const project::Plant& plant : context.project->patch.plants) shareSum += plant.share;
  for (std::size_t i = 0; i < context.project->patch.plants.size(); ++i) plantRow(context, i, shareSum);
  ImGui::SetCursorPosX(px(12.0f));
  if (ImGui::Button((std::string(icon::kAdd) + "  Add plant").c_str())) ImGui::OpenPopup("##addPlant");
  logItem("outliner.addPlant");
  if (!ImGui::BeginPopup("##addPlant")) return;
  for (const std::string& action : context.addPlantActions) {
    const std::string name = action.substr(action.rfind('.') + 1);
    if (ImGui::Selectable(name.c_str())) context.edits.run(action);
    logItem("addPlant:", name);
  }
  ImGui::Separator();
  if (ImGui::Selectable("From glTF file...")) context.edits.run("plant.addFromFile");
  logItem("addPlant:file");
  ImGui::EndPopup();
}

void OutlinerPanel::plantRow(PanelContext& context, std::size_t index, double shareSum) {
  const project::Plant& plant = context.project->patch.plants[index];
  const bool chosen = context.ui.selection.kind == Selection::Kind::Plant && context.ui.selection.index == index;
  const ImVec2 start = ImGui::GetCursorPos();
  const ImVec2 screen = ImGui::GetCursorScreenPos();
  ImGui::PushID(static_cast<int>(index));
  ImGui::SetItemAllowOverlap();
  const bool clicked = ImGui::Selectable("##plant", chosen,
                                         ImGuiSelectableFlags_AllowDoubleClick | ImGuiSelectableFlags_AllowItemOverlap,
                                         {0.0f, px(kPlantHeight)});
  logItem("outliner:plant:", plant.name);
  if (clicked) context.ui.selection = selectPlant(*context.project, index);
  if (clicked && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) m_renaming = Renaming{true, index, plant.name};
  if (ImGui::BeginDragDropSource()) {
    ImGui::SetDragDropPayload(kPlantDrag, &index, sizeof(index));
    ImGui::TextUnformatted(plant.name.c_str());
    ImGui::EndDragDropSource();
  }
  if (ImGui::BeginDragDropTarget()) {
    if (const ImGuiPayload* payload = ImGui::AcceptDragDropPayload(kPlantDrag)) {
      const std::size_t from = *static_cast<const std::size_t*>(payload->Data);
      context.edits.edit("move plant", [=](project::Project& p) { movePlant(p, from, index); });
    }
    ImGui::EndDragDropTarget();
  }
  plantMenu(context, index);
  const ImVec2 corner{screen.x + px(10.0f), screen.y + px(4.0f)};
  const ImVec2 end{corner.x + px(36.0f), corner.y + px(36.0f)};
  drawThumbnail(context, index, corner, end, iconOf(plant.kind));
  ImGui::SetCursorPos({px(56.0f), start.y + px(5.0f)});
  if (m_renaming && m_renaming->plant && m_renaming->index == index) {
    renameField(context, plant.name, true, index);
  } else {
    ImGui::TextUnformatted(plant.name.c_str());
    ImGui::SetCursorPos({px(56.0f), start.y + px(23.0f)});
    const FontScope font(theme().fonts.small);
    ImGui::TextDisabled("%s", plantHint(plant, shareSum).c_str());
  }
  ImGui::SetCursorPos({start.x, start.y + px(kPlantHeight)});
  ImGui::PopID();
}

void OutlinerPanel::plantMenu(PanelContext& context, std::size_t index) {
  if (!ImGui::BeginPopupContextItem("##menu")) return;
  context.ui.selection = selectPlant(*context.project, index);
  if (ImGui::MenuItem("Rename")) m_renaming = Renaming{true, index, context.project->patch.plants[index].name};
  if (ImGui::MenuItem("Duplicate", "Ctrl+D")) context.edits.run("plant.duplicate");
  if (ImGui::MenuItem("Remove", "Shift+Del")) context.edits.run("plant.remove");
  ImGui::EndPopup();
}

void OutlinerPanel::renameField(PanelContext& context, const std::string& name, bool plant, std::size_t index) {
  ImGui::SetNextItemWidth(-px(8.0f));
  if (!m_renaming->focused) ImGui::SetKeyboardFocusHere();
  const bool entered = ImGui::InputText("##rename", &m_renaming->text,
                                        ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
  logItem("outliner.rename");
  const bool left = m_renaming->focused && !ImGui::IsItemActive();
  const bool wasFocused = std::exchange(m_renaming->focused, true);
  if (!entered && !(wasFocused && left)) return;
  const std::string wanted = m_renaming->text;
  m_renaming.reset();
  if (wanted == name || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) return;
  context.edits.edit(plant ? "rename plant" : "rename view", [&](project::Project& p) {
    if (plant) renamePlant(p, index, wanted);
    if (!plant) renameView(p, index, wanted);
  });
}

void OutlinerPanel::cameras(PanelContext& context) {
  title("VIEWS");
  const auto& views = context.project->views;
  for (std::size_t i = 0; i < views.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    if (m_renaming && !m_renaming->plant && m_renaming->index == i) {
      ImGui::SetCursorPosX(px(40.0f));
      renameField(context, views[i].name, false, i);
      ImGui::PopID();
      continue;
    }
    if (row(context, icon::kCamera, views[i].name, selectView(*context.project, i), "")) {
      context.ui.camera = views[i];
      context.ui.boundView = i;
      context.ui.lastMotion = context.seconds;
      if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) m_renaming = Renaming{false, i, views[i].name};
    }
    ImGui::PopID();
  }
  ImGui::SetCursorPosX(px(12.0f));
  if (ImGui::Button((std::string(icon::kAdd) + "  Save camera as view").c_str())) context.edits.run("view.save");
  logItem("outliner.addView");
}

}  // namespace sward::editor
