#include "widgets/units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace sward::editor {
namespace {

/// A unit that may be typed, and what one of it is in the base unit of its kind.
struct Unit {
  std::string_view name;
  char kind;
  double inBase;
};
constexpr double kPi = 3.14159265358979323846;
constexpr std::array kUnits{
    Unit{"um", 'l', 1e-6},       Unit{"mm", 'l', 1e-3},     Unit{"cm", 'l', 1e-2},    Unit{"dm", 'l', 1e-1},
    Unit{"m", 'l', 1.0},         Unit{"km", 'l', 1e3},      Unit{"in", 'l', 0.0254},  Unit{"ft", 'l', 0.3048},
    Unit{"degrees", 'a', 1.0},   Unit{"degree", 'a', 1.0},  Unit{"deg", 'a', 1.0},    Unit{"\u00B0", 'a', 1.0},
    Unit{"rad", 'a', 180 / kPi}, Unit{"turns", 'a', 360.0}, Unit{"turn", 'a', 360.0}, Unit{"%", 'r', 0.01},
    Unit{"hours", 't', 1.0},     Unit{"hour", 't', 1.0},    Unit{"h", 't', 1.0},      Unit{"min", 't', 1.0 / 60},
};

const Unit* findUnit(std::string_view name) {
  const auto found = std::find_if(kUnits.begin(), kUnits.end(), [name](const Unit& unit) { return unit.name == name; });
  return found == kUnits.end() ? nullptr : &*found;
}

std::string_view trimmed(std::string_view text) {
  const auto space = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
  while (!text.empty() && space(text.front())) text.remove_prefix(1);
  while (!text.empty() && space(text.back())) text.remove_suffix(1);
  return text;
}

std::string withSuffix(std::string number, const DisplayUnit& unit) {
  if (unit.suffix.empty()) return number;
  return number + (unit.attached ? "" : " ") + unit.suffix;
}

/// "plants/m2" as "plants/m²".
std::string prettyUnit(std::string_view unit) {
  std::string text(unit);
  if (text.ends_with("m2")) text.replace(text.size() - 1, 1, "\u00B2");
  if (text.ends_with("m3")) text.replace(text.size() - 1, 1, "\u00B3");
  return text;
}

}  // namespace

DisplayUnit displayUnit(std::string_view schemaUnit, double typical, bool percent) {
  if (percent) return {"%", false, 100.0};
  if (schemaUnit == "degrees") return {"\u00B0", true, 1.0};
  if (schemaUnit == "hours") return {"h", false, 1.0};
  if (schemaUnit == "m") {
    const double size = std::abs(typical);
    if (size > 0.0 && size < 0.01) return {"mm", false, 1000.0};
    if (size > 0.0 && size < 1.0) return {"cm", false, 100.0};
  }
  return {prettyUnit(schemaUnit), false, 1.0};
}

double cleaned(double value) {
  if (!std::isfinite(value)) return value;
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.12g", value);
  return std::strtod(text.data(), nullptr);
}

std::string shownNumber(double stored, const DisplayUnit& unit) {
  const double value = stored * unit.perStored;
  std::array<char, 400> text{};
  if (!std::isfinite(value) || std::abs(value) >= 1e9) {
    std::snprintf(text.data(), text.size(), "%.4g", value);
    return text.data();
  }
  const double size = std::abs(value);
  const int digits = size > 0.0 ? static_cast<int>(std::floor(std::log10(size))) : 0;
  const int decimals = std::clamp(3 - digits, 0, 6);
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  std::string number = text.data();
  if (number.find('.') != std::string::npos) {
    number.erase(number.find_last_not_of('0') + 1);
    if (number.back() == '.') number.pop_back();
  }
  return number == "-0" ? "0" : number;
}

std::string shownValue(double stored, const DisplayUnit& unit) {
  return withSuffix(shownNumber(stored, unit), unit);
}

std::string exactValue(double stored, const DisplayUnit& unit) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.12g", stored * unit.perStored);
  return withSuffix(text.data(), unit);
}

std::optional<double> parsedValue(std::string_view text, std::string_view schemaUnit, const DisplayUnit& shown) {
  std::string copy(trimmed(text));
  const std::size_t comma = copy.find(',');
  if (comma != std::string::npos && copy.find('.') == std::string::npos) copy[comma] = '.';
  char* end = nullptr;
  const double number = std::strtod(copy.c_str(), &end);
  if (end == copy.c_str() || !std::isfinite(number)) return std::nullopt;
  const std::string_view suffix = trimmed(end);
  if (suffix.empty() || suffix == shown.suffix) return cleaned(number / shown.perStored);
  const Unit* typed = findUnit(suffix);
  if (typed == nullptr) {
    // Counted things: any beginning of the unit's own word, such as "plants" or "texels".
    const std::string pretty = prettyUnit(schemaUnit);
    const bool fits = std::string_view(pretty).starts_with(suffix) || schemaUnit.starts_with(suffix);
    return fits ? std::optional(cleaned(number)) : std::nullopt;
  }
  const Unit* stored = findUnit(schemaUnit);
  const char kind = stored != nullptr ? stored->kind : (schemaUnit.empty() ? 'r' : '?');
  if (typed->kind != kind) return std::nullopt;
  return cleaned(number * typed->inBase / (stored != nullptr ? stored->inBase : 1.0));
}

}  // namespace sward::editor
