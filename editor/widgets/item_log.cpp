#include "widgets/item_log.h"

#include <algorithm>
#include <cmath>

#include <imgui_internal.h>

namespace sward::editor {
namespace {

ItemLog*& currentLog() {
  static ItemLog* log = nullptr;
  return log;
}

void append(std::string& text, std::string_view name) {
  text += '"';
  for (const char c : name) {
    if (c == '"' || c == '\\') text += '\\';
    text += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  text += '"';
}

}  // namespace

void ItemLog::add(std::string_view name, ImVec2 min, ImVec2 max, bool visible) {
  m_items.insert_or_assign(std::string(name), Item{min, max, visible});
}

const ItemLog::Item* ItemLog::find(std::string_view name) const {
  const auto found = m_items.find(name);
  return found == m_items.end() ? nullptr : &found->second;
}

std::string ItemLog::toJson() const {
  std::string text = "{\"items\": {";
  const char* separator = "\n";
  for (const auto& [name, item] : m_items) {
    text += separator;
    separator = ",\n";
    append(text, name);
    const auto number = [](float value) { return std::to_string(std::lround(value)); };
    text += ": {\"x\": " + number(item.min.x) + ", \"y\": " + number(item.min.y);
    text += ", \"width\": " + number(item.max.x - item.min.x) + ", \"height\": " + number(item.max.y - item.min.y);
    text += std::string(", \"visible\": ") + (item.visible ? "true" : "false") + "}";
  }
  return text + "\n}}\n";
}

void setItemLog(ItemLog* log) {
  currentLog() = log;
}

bool loggingItems() {
  return currentLog() != nullptr;
}

void logRect(std::string_view prefix, std::string_view name, ImVec2 min, ImVec2 max) {
  ItemLog* log = currentLog();
  if (log == nullptr) return;
  ImRect rect(min, max);
  const ImRect clip = ImGui::GetCurrentWindowRead()->ClipRect;
  const bool visible = rect.Overlaps(clip);
  if (visible) rect.ClipWith(clip);
  log->add(std::string(prefix) + std::string(name), rect.Min, rect.Max, visible);
}

void logItem(std::string_view prefix, std::string_view name) {
  if (currentLog() == nullptr) return;
  logRect(prefix, name, ImGui::GetItemRectMin(), ImGui::GetItemRectMax());
}

}  // namespace sward::editor
