#pragma once

#include "project/reader.h"
#include "project/schema.h"

#include <cmath>
#include <optional>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

namespace sward::project {

/// The archive that compares every number in use with its range.
class RangeCheck {
 public:
  template <typename T>
  using Ref = const T&;

  RangeCheck(std::string path, std::vector<Problem>& problems) : m_path(std::move(path)), m_problems(problems) {}

  void version(int) {}
  template <typename T>
  void field(const char* name, const T& value, const Spec& spec = {}) {
    check(childPath(m_path, name), value, spec);
  }
  template <typename T>
  void field(const char* name, const std::optional<T>& value, const Spec& spec = {}) {
    if (value.has_value()) field(name, *value, spec);
  }
  template <typename T>
  void choice(const char* name, const T& value, bool used, const Spec& spec = {}) {
    if (used) field(name, value, spec);
  }

 private:
  template <typename T>
  void check(const std::string& path, const T& value, const Spec& spec) {
    if constexpr (std::is_same_v<T, int> || std::is_same_v<T, double>) {
      number(path, static_cast<double>(value), spec);
    } else if constexpr (!std::is_arithmetic_v<T> && !std::is_enum_v<T>) {
      RangeCheck inner(path, m_problems);
      describe(inner, value);
    }
  }
  void check(const std::string&, const std::string&, const Spec&) {}
  void check(const std::string& path, const glm::dvec3& v, const Spec& spec) {
    for (int i = 0; i < 3; ++i) number(path + "[" + std::to_string(i) + "]", v[i], spec);
  }
  void check(const std::string& path, const base::Curve& curve, const Spec& spec) {
    for (std::size_t i = 0; i < curve.points().size(); ++i) {
      const std::string place = path + "[" + std::to_string(i) + "]";
      number(place + "[0]", curve.points()[i].x, range(spec.xLow, spec.xHigh));
      number(place + "[1]", curve.points()[i].y, spec);
    }
  }
  template <typename T>
  void check(const std::string& path, const std::vector<T>& values, const Spec& spec) {
    number(path, static_cast<double>(values.size()), spec);
    for (std::size_t i = 0; i < values.size(); ++i) check(path + "[" + std::to_string(i) + "]", values[i], Spec{});
  }

  void number(const std::string& path, double value, const Spec& spec) {
    if (value >= spec.low && value <= spec.high) return;
    std::ostringstream what, remedy;
    const std::string unit = *spec.unit != '\0' ? std::string(" ") + spec.unit : "";
    what << "the value is " << value << unit;
    if (std::isfinite(spec.low) && spec.high < std::numeric_limits<double>::max()) {
      remedy << "Give " << spec.low << " to " << spec.high << unit << ".";
    } else {
      remedy << "Give a finite number.";
    }
    m_problems.push_back({true, path, what.str(), remedy.str()});
  }

  std::string m_path;
  std::vector<Problem>& m_problems;
};

}  // namespace sward::project
