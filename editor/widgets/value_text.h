#pragma once

#include "base/curve.h"
#include "project/words.h"

#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include <glm/glm.hpp>

/// Values as text for the clipboard: as JSON writes them, so that they also serve `--set path=value`.
namespace sward::editor {

std::string valueText(double value);
std::string valueText(int value);
std::string valueText(std::uint64_t value);
std::string valueText(bool value);
std::string valueText(const std::string& value);
std::string valueText(const glm::dvec3& value);
std::string valueText(const base::Curve& value);
template <typename E>
requires std::is_enum_v<E> std::string valueText(E value) {
  return std::string(project::wordOf(value));
}

/// Reads what valueText() wrote; false, and the value as it was, when the text is something else. Colours may also be
/// "#RRGGBB" (sRGB), and a curve's points stand one a line or in brackets.
bool readValue(const std::string& text, double& value);
bool readValue(const std::string& text, int& value);
bool readValue(const std::string& text, std::uint64_t& value);
bool readValue(const std::string& text, bool& value);
bool readValue(const std::string& text, std::string& value);
bool readValue(const std::string& text, glm::dvec3& value);
bool readValue(const std::string& text, base::Curve& value);
template <typename E>
requires std::is_enum_v<E>
bool readValue(const std::string& text, E& value) {
  const std::optional<E> found = project::fromWord<E>(text);
  if (found) value = *found;
  return found.has_value();
}

/// "#7A9C4B" of a linear colour; values outside [0, 1] are clipped.
std::string hexText(const glm::dvec3& linear);
/// Every number of a text, whatever stands between them; nothing when another letter is among it.
std::optional<std::vector<double>> numbersIn(const std::string& text);

}  // namespace sward::editor
