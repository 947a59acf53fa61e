#include "widgets/field_look.h"

#include <array>
#include <cctype>
#include <cmath>

namespace sward::editor {
namespace {

bool upper(char c) {
  return std::isupper(static_cast<unsigned char>(c)) != 0;
}

std::string_view withoutUnit(std::string_view name) {
  constexpr std::array<std::string_view, 6> kSuffixes{"PerM2", "Deg", "Km", "Mm", "Ev", "M"};
  for (const std::string_view suffix : kSuffixes) {
    if (name.size() > suffix.size() && name.ends_with(suffix)) return name.substr(0, name.size() - suffix.size());
  }
  return name;
}

constexpr double kUnbounded = std::numeric_limits<double>::max() / 4;

/// The range of a bar: the schema's soft one; else the hard one, unless it is so wide that a default stands at its very
/// edge, where a bar tells nothing.
void setSoftRange(NumberStyle& style, const project::Spec& spec, double typical) {
  const double low = spec.sliderLow(), high = spec.sliderHigh();
  if (low < -kUnbounded || high > kUnbounded) return;
  const bool chosen = spec.softLow > -kUnbounded || spec.softHigh < kUnbounded;
  const bool wide = !chosen && typical != 0.0 && high - low > 200.0 * std::abs(typical);
  style.logarithmic = spec.logarithmic || (wide && low > 0.0);
  if (wide && !style.logarithmic) return;
  style.softLow = low;
  style.softHigh = high;
}

}  // namespace

std::string prettyName(std::string_view name) {
  std::string text;
  for (const char c : withoutUnit(name)) {
    if (upper(c) && !text.empty()) text += ' ';
    if (c == '_') {
      text += ' ';
    } else {
      text += static_cast<char>(text.empty() ? std::toupper(static_cast<unsigned char>(c))
                                             : std::tolower(static_cast<unsigned char>(c)));
    }
  }
  if (text.ends_with(" utc")) text.replace(text.size() - 3, 3, "UTC");
  return text;
}

std::string lowerFirst(std::string text) {
  if (text.size() > 1 && upper(text[0]) && !upper(text[1]) && text[1] != ' ') {
    text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  }
  return text;
}

FieldLook fieldLook(const char* name, const project::Spec& spec, double typical) {
  FieldLook look;
  look.label = *spec.label != '\0' ? spec.label : prettyName(name);
  look.help = spec.help;
  look.group = spec.group;
  look.colour = spec.isColour;
  look.advanced = spec.advanced;
  look.files = spec.files;
  NumberStyle& number = look.number;
  number.low = spec.low;
  number.high = spec.high;
  number.unit = spec.unit;
  number.shown = displayUnit(spec.unit, typical, spec.isPercent);
  setSoftRange(number, spec, typical);
  return look;
}

}  // namespace sward::editor
