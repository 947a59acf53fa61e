#include "widgets/value_text.h"

#include "image/colour.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace sward::editor {
namespace {

std::string stripped(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

template <typename T>
bool readWhole(const std::string& text, T& value) {
  const std::string trimmed = stripped(text);
  T number = 0;
  const char* end = trimmed.data() + trimmed.size();
  const auto [stop, error] = std::from_chars(trimmed.data(), end, number);
  if (error != std::errc{} || stop != end) return false;
  value = number;
  return true;
}

bool readHex(const std::string& text, glm::dvec3& value) {
  if (text.size() != 7 || text[0] != '#') return false;
  unsigned bits = 0;
  const auto [stop, error] = std::from_chars(text.data() + 1, text.data() + 7, bits, 16);
  if (error != std::errc{} || stop != text.data() + 7) return false;
  const glm::vec3 encoded(static_cast<float>(bits >> 16), static_cast<float>((bits >> 8) & 0xFF),
                          static_cast<float>(bits & 0xFF));
  value = glm::dvec3(image::linearFromSrgb(encoded / 255.0f));
  return true;
}

}  // namespace

std::string valueText(double value) {
  // The shortest text that reads back as the same number.
  std::array<char, 40> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

std::string valueText(int value) {
  return std::to_string(value);
}

std::string valueText(std::uint64_t value) {
  return std::to_string(value);
}

std::string valueText(bool value) {
  return value ? "true" : "false";
}

std::string valueText(const std::string& value) {
  return value;
}

std::string valueText(const glm::dvec3& v) {
  return "[" + valueText(v.x) + ", " + valueText(v.y) + ", " + valueText(v.z) + "]";
}

std::string valueText(const base::Curve& curve) {
  std::string text = "[";
  for (const base::CurvePoint& point : curve.points()) {
    if (text.size() > 1) text += ", ";
    text += "[" + valueText(point.x) + ", " + valueText(point.y) + "]";
  }
  return text + "]";
}

bool readValue(const std::string& text, double& value) {
  const auto numbers = numbersIn(text);
  if (!numbers || numbers->size() != 1) return false;
  value = numbers->front();
  return true;
}

bool readValue(const std::string& text, int& value) {
  return readWhole(text, value);
}

bool readValue(const std::string& text, std::uint64_t& value) {
  return readWhole(text, value);
}

bool readValue(const std::string& text, bool& value) {
  const std::string word = stripped(text);
  if (word != "true" && word != "false") return false;
  value = word == "true";
  return true;
}

bool readValue(const std::string& text, std::string& value) {
  // One line: names and paths hold no line breaks.
  value = stripped(text.substr(0, text.find('\n')));
  return true;
}

bool readValue(const std::string& text, glm::dvec3& value) {
  if (readHex(stripped(text), value)) return true;
  const auto numbers = numbersIn(text);
  if (!numbers || numbers->size() != 3) return false;
  value = {(*numbers)[0], (*numbers)[1], (*numbers)[2]};
  return true;
}

bool readValue(const std::string& text, base::Curve& value) {
  const auto numbers = numbersIn(text);
  if (!numbers || numbers->size() % 2 != 0) return false;
  std::vector<base::CurvePoint> points;
  for (std::size_t i = 0; i < numbers->size(); i += 2) points.push_back({(*numbers)[i], (*numbers)[i + 1]});
  auto curve = base::Curve::fromPoints(std::move(points));
  if (!curve.ok()) return false;
  value = std::move(curve).value();
  return true;
}

std::string hexText(const glm::dvec3& linear) {
  const glm::vec3 encoded = image::srgbFromLinear(glm::clamp(glm::vec3(linear), 0.0f, 1.0f));
  const auto byte = [](float v) { return static_cast<unsigned>(std::lround(v * 255.0f)); };
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "#%02X%02X%02X", byte(encoded.x) & 0xFF, byte(encoded.y) & 0xFF,
                byte(encoded.z) & 0xFF);
  return text.data();
}

std::optional<std::vector<double>> numbersIn(const std::string& text) {
  std::vector<double> numbers;
  const char* at = text.c_str();
  while (*at != '\0') {
    if (std::string_view(" \t\r\n,;[](){}").find(*at) != std::string_view::npos) {
      ++at;
      continue;
    }
    char* end = nullptr;
    const double number = std::strtod(at, &end);
    if (end == at || !std::isfinite(number)) return std::nullopt;
    numbers.push_back(number);
    at = end;
  }
  return numbers;
}

}  // namespace sward::editor
