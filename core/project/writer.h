#pragma once

#include "project/schema.h"
#include "project/words.h"

#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include <nlohmann/json.hpp>

namespace sward::project {

using Json = nlohmann::ordered_json;

/// The archive that writes one struct into a JSON object, in the description's order.
class Writer {
 public:
  template <typename T>
  using Ref = const T&;

  explicit Writer(Json& object) : m_object(object) { m_object = Json::object(); }

  void version(int number) { m_object["version"] = number; }
  template <typename T>
  void field(const char* name, const T& value, const Spec& = {}) {
    m_object[name] = json(value);
  }
  template <typename T>
  void field(const char* name, const std::optional<T>& value, const Spec& = {}) {
    if (value.has_value()) m_object[name] = json(*value);
  }
  template <typename T>
  void choice(const char* name, const T& value, bool used, const Spec& = {}) {
    if (used || !(value == T{})) m_object[name] = json(value);
  }

 private:
  template <typename T>
  static Json json(const T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
      return Json(value);
    } else if constexpr (std::is_enum_v<T>) {
      return Json(std::string(wordOf(value)));
    } else {
      Json object;
      Writer writer(object);
      describe(writer, value);
      return object;
    }
  }
  static Json json(const glm::dvec3& v) { return Json::array({v.x, v.y, v.z}); }
  static Json json(const base::Curve& curve) {
    Json points = Json::array();
    for (const base::CurvePoint& point : curve.points()) points.push_back(Json::array({point.x, point.y}));
    return points;
  }
  template <typename T>
  static Json json(const std::vector<T>& values) {
    Json list = Json::array();
    for (const T& value : values) list.push_back(json(value));
    return list;
  }

  Json& m_object;
};

/// Two-space indent; arrays of numbers, and arrays of such arrays, stay on one line. Ends with a newline.
std::string prettyText(const Json& json);

}  // namespace sward::project
