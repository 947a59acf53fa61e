#include "app/shortcut.h"

#include <array>
#include <cctype>
#include <utility>

namespace sward::editor {
namespace {

/// GLFW's numbers of the keys that have names (glfw3.h); letters, digits and punctuation are their ASCII codes.
constexpr std::array<std::pair<std::string_view, int>, 24> kNamedKeys{{
    {"Space", 32}, {"Esc", 256},   {"Enter", 257}, {"Tab", 258},  {"Backspace", 259}, {"Ins", 260},
    {"Del", 261},  {"Right", 262}, {"Left", 263},  {"Down", 264}, {"Up", 265},        {"Home", 268},
    {"End", 269},  {"F1", 290},    {"F2", 291},    {"F3", 292},   {"F4", 293},        {"F5", 294},
    {"F6", 295},   {"F8", 297},    {"F9", 298},    {"F10", 299},  {"F11", 300},       {"F12", 301},
}};

}  // namespace

std::string Shortcut::text() const {
  if (empty()) return {};
  std::string out;
  if (control) out += "Ctrl+";
  if (shift) out += "Shift+";
  if (alt) out += "Alt+";
  for (const auto& [name, number] : kNamedKeys)
    if (number == key) return out + std::string(name);
  return out + static_cast<char>(key);
}

Shortcut Shortcut::parse(std::string_view text) {
  Shortcut shortcut;
  const auto take = [&](std::string_view prefix) {
    if (!text.starts_with(prefix) || text.size() == prefix.size()) return false;
    text.remove_prefix(prefix.size());
    return true;
  };
  shortcut.control = take("Ctrl+");
  shortcut.shift = take("Shift+");
  shortcut.alt = take("Alt+");
  for (const auto& [name, number] : kNamedKeys)
    if (name == text) shortcut.key = number;
  if (shortcut.key == 0 && text.size() == 1 && std::isgraph(static_cast<unsigned char>(text[0])) != 0)
    shortcut.key = std::toupper(static_cast<unsigned char>(text[0]));
  return shortcut.key == 0 ? Shortcut{} : shortcut;
}

}  // namespace sward::editor
