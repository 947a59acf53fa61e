#pragma once

#include <algorithm>
#include <limits>

namespace sward::project {

/// What a change of a value invalidates: every hit and shadow, the colours alone, or nothing.
enum class Role { Shape, Colour, Label };

/// What is known of a field beside its name in the file and its value. The first half binds files; the second half only
/// helps people: labels, tooltips, and how an editor shows the value.
struct Spec {
  static constexpr double kLowest = -std::numeric_limits<double>::max();
  static constexpr double kHighest = std::numeric_limits<double>::max();

  double low = kLowest;  ///< every number must be finite in any case; for lists the number of entries, for curves y
  double high = kHighest;
  const char* unit = "";
  Role role = Role::Shape;

  const char* label = "";      ///< the field's name for people, such as "Blade height": short, without a unit
  const char* help = "";       ///< what it decides and when to change it, in a sentence or two
  const char* group = "";      ///< title under which a struct's fields fold together; a group's fields are neighbours
  double softLow = kLowest;    ///< the range of a slider, where the hard one is too wide to aim in;
  double softHigh = kHighest;  ///< the extremes mean that it is the hard one. Read sliderLow() and sliderHigh()
  double step = 0.0;           ///< what the arrows of an entry field add; 0: the editor's choice
  bool logarithmic = false;    ///< a slider over decades; sliderLow() is above 0 then
  bool isColour = false;       ///< three numbers that are linear RGB
  bool isAngle = false;        ///< a number in degrees
  bool isPercent = false;      ///< a fraction that people read in percent; the file holds the fraction
  bool advanced = false;       ///< few need it: folded away until asked for
  const char* files = "";      ///< a text that is an asset's path: the endings that are accepted, ".glb .gltf"

  double xLow = 0.0;  ///< of a curve: the range of its points' x (of their y: low, high), and the axes' labels
  double xHigh = 1.0;
  const char* xLabel = "";
  const char* yLabel = "";

  constexpr double sliderLow() const { return std::max(low, softLow); }
  constexpr double sliderHigh() const { return std::min(high, softHigh); }

  constexpr Spec says(const char* newLabel, const char* newHelp) const {
    Spec spec = *this;
    spec.label = newLabel;
    spec.help = newHelp;
    return spec;
  }
  constexpr Spec in(const char* newGroup) const {
    Spec spec = *this;
    spec.group = newGroup;
    return spec;
  }
  constexpr Spec soft(double newLow, double newHigh) const {
    Spec spec = *this;
    spec.softLow = newLow;
    spec.softHigh = newHigh;
    return spec;
  }
  /// A logarithmic slider over this comfortable range.
  constexpr Spec decades(double newLow, double newHigh) const {
    Spec spec = soft(newLow, newHigh);
    spec.logarithmic = true;
    return spec;
  }
  constexpr Spec steps(double newStep) const {
    Spec spec = *this;
    spec.step = newStep;
    return spec;
  }
  constexpr Spec expert() const {
    Spec spec = *this;
    spec.advanced = true;
    return spec;
  }
  constexpr Spec file(const char* endings) const {
    Spec spec = *this;
    spec.files = endings;
    return spec;
  }
  constexpr Spec axes(const char* newXLabel, const char* newYLabel, double newXLow = 0.0, double newXHigh = 1.0) const {
    Spec spec = *this;
    spec.xLabel = newXLabel;
    spec.yLabel = newYLabel;
    spec.xLow = newXLow;
    spec.xHigh = newXHigh;
    return spec;
  }
};

constexpr Spec range(double low, double high, const char* unit = "", Role role = Role::Shape) {
  return {low, high, unit, role};
}
constexpr Spec angle(double low, double high) {
  Spec spec = range(low, high, "degrees");
  spec.isAngle = true;
  return spec;
}
constexpr Spec percent(double low, double high, Role role = Role::Shape) {
  Spec spec = range(low, high, "", role);
  spec.isPercent = true;
  return spec;
}
/// Three numbers of linear RGB, each from 0 to `high`.
constexpr Spec colour(double high = 1.0) {
  Spec spec = range(0.0, high, "", Role::Colour);
  spec.isColour = true;
  return spec;
}
/// A struct, word, flag, seed or text without a range; a struct's Role::Colour holds for all its fields.
constexpr Spec of(Role role) {
  Spec spec;
  spec.role = role;
  return spec;
}
constexpr Spec label() {
  return of(Role::Label);
}

}  // namespace sward::project
