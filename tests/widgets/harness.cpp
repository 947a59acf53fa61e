#include "widgets/harness.h"

#include "widgets/rasteriser.h"

#include <algorithm>
#include <stdexcept>

namespace sward::editor {

Harness::Harness(float width, float height, ThemeKind kind, float scale) : m_context(ImGui::CreateContext()) {
  ImGui::SetCurrentContext(m_context);
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.DisplaySize = ImVec2(width, height);
  io.DeltaTime = 1.0f / 60.0f;
  io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
  io.ConfigInputTextCursorBlink = false;
  for (int key = 0; key < ImGuiKey_COUNT; ++key) io.KeyMap[key] = key;
  io.MousePos = ImVec2(-1, -1);
  // Debian's library has no clipboard without a window: ImGui's own memory stands in.
  loadFonts(*io.Fonts, scale);
  applyTheme(kind, scale);
  unsigned char* pixels = nullptr;
  int w = 0, h = 0;
  io.Fonts->GetTexDataAsAlpha8(&pixels, &w, &h);
  setItemLog(&m_log);
}

Harness::~Harness() {
  setItemLog(nullptr);
  ImGui::DestroyContext(m_context);
}

void Harness::show(std::function<void()> draw) {
  m_draw = std::move(draw);
  frames(3);
}

void Harness::frames(int count) {
  for (int i = 0; i < count; ++i) {
    m_log.beginFrame();
    ImGui::NewFrame();
    ImGui::SetNextWindowPos(ImVec2(0, 0));
    ImGui::SetNextWindowSize(ImGui::GetIO().DisplaySize);
    ImGui::Begin("test", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove);
    if (m_draw) m_draw();
    ImGui::End();
    ImGui::Render();
  }
}

const ItemLog::Item& Harness::item(const std::string& name) const {
  const ItemLog::Item* found = m_log.find(name);
  if (found == nullptr) throw std::runtime_error("nothing called \"" + name + "\" was drawn");
  return *found;
}

ImVec2 Harness::at(const std::string& name) const {
  return item(name).centre();
}

void Harness::moveTo(ImVec2 place) {
  ImGui::GetIO().MousePos = place;
  frames();
}

void Harness::press(int button) {
  ImGui::GetIO().MouseDown[button] = true;
  frames();
}

void Harness::release(int button) {
  ImGui::GetIO().MouseDown[button] = false;
  frames(2);
}

void Harness::clickAt(ImVec2 place, int button) {
  moveTo(place);
  press(button);
  release(button);
}

void Harness::click(const std::string& name, int button) {
  clickAt(at(name), button);
}

void Harness::doubleClickAt(ImVec2 place) {
  pause();
  clickAt(place);
  press();
  release();
}

void Harness::drag(ImVec2 from, ImVec2 to, int steps, int button) {
  pause();
  moveTo(from);
  press(button);
  for (int i = 1; i <= steps; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(steps);
    moveTo(ImVec2(from.x + (to.x - from.x) * t, from.y + (to.y - from.y) * t));
  }
  release(button);
}

void Harness::wheel(float notches) {
  ImGui::GetIO().MouseWheel = notches;
  frames();
}

void Harness::key(ImGuiKey key) {
  ImGui::GetIO().KeysDown[key] = true;
  frames();
  ImGui::GetIO().KeysDown[key] = false;
  frames();
}

void Harness::type(const std::string& text) {
  for (const char c : text) {
    ImGui::GetIO().AddInputCharacter(static_cast<unsigned char>(c));
    frames();
  }
}

void Harness::hold(bool ctrl, bool shift, bool alt) {
  ImGuiIO& io = ImGui::GetIO();
  io.KeyCtrl = ctrl;
  io.KeyShift = shift;
  io.KeyAlt = alt;
}

image::Image Harness::picture() {
  return rasterised(*ImGui::GetDrawData(), *ImGui::GetIO().Fonts, theme().colours.backdrop);
}

}  // namespace sward::editor
