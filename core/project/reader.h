#pragma once

#include "project/nearest.h"
#include "project/schema.h"
#include "project/words.h"

#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <nlohmann/json.hpp>

namespace sward::project {

using Json = nlohmann::ordered_json;

/// "a number", "text", ... for messages.
std::string typeName(const Json& json);

/// "parent.name", or the name alone at the top.
std::string childPath(const std::string& parent, std::string_view name);

/// The archive that reads one struct from a JSON object. Keys that are absent leave their values alone. The first error
/// is kept; later fields are left out then. Call finish() when all fields were described.
class Reader {
 public:
  template <typename T>
  using Ref = T&;

  /// `file` stands in messages before the path.
  Reader(const Json& object, std::string path, std::string file, std::optional<Error>& error);

  void version(int newest);
  template <typename T>
  void field(const char* name, T& value, const Spec& spec = {}) {
    m_known.emplace_back(name);
    if (const Json* json = find(name)) read(*json, childPath(m_path, name), value, spec);
  }
  template <typename T>
  void field(const char* name, std::optional<T>& value, const Spec& spec = {}) {
    m_known.emplace_back(name);
    const Json* json = find(name);
    if (json == nullptr) return;
    if (json->is_null()) {
      value.reset();
      return;
    }
    read(*json, childPath(m_path, name), value.emplace(), spec);
  }
  template <typename T>
  void choice(const char* name, T& value, bool, const Spec& spec = {}) {
    field(name, value, spec);
  }
  /// Reports keys that no field asked for.
  void finish();

 private:
  template <typename T>
  void read(const Json& json, const std::string& path, T& value, const Spec&) {
    if constexpr (std::is_enum_v<T>) {
      if (!json.is_string()) return wrongType(json, path, "one of the words " + allWords<T>());
      const auto word = json.get<std::string>();
      const std::optional<T> found = fromWord<T>(word);
      if (!found) return fail(path, "\"" + word + "\" is not known here", "Use one of: " + allWords<T>() + ".");
      value = *found;
    } else {
      Reader reader(json, path, m_file, m_error);
      describe(reader, value);
      reader.finish();
    }
  }
  void read(const Json& json, const std::string& path, bool& value, const Spec&);
  void read(const Json& json, const std::string& path, int& value, const Spec&);
  void read(const Json& json, const std::string& path, std::uint64_t& value, const Spec&);
  void read(const Json& json, const std::string& path, double& value, const Spec&);
  void read(const Json& json, const std::string& path, std::string& value, const Spec&);
  void read(const Json& json, const std::string& path, glm::dvec3& value, const Spec& spec);
  void read(const Json& json, const std::string& path, base::Curve& value, const Spec& spec);
  template <typename T>
  void read(const Json& json, const std::string& path, std::vector<T>& values, const Spec& spec) {
    if (!json.is_array()) return wrongType(json, path, "a list");
    // A list beyond its limit is refused before anything is built from it.
    if (static_cast<double>(json.size()) > spec.high) {
      return fail(path, "the list has " + std::to_string(json.size()) + " entries",
                  "At most " + std::to_string(static_cast<int>(spec.high)) + " are allowed.");
    }
    values.clear();
    for (std::size_t i = 0; i < json.size() && !m_error; ++i) {
      read(json[i], path + "[" + std::to_string(i) + "]", values.emplace_back(), Spec{});
    }
  }

  const Json* find(const char* name) const;
  void fail(const std::string& path, const std::string& what, const std::string& remedy);
  void wrongType(const Json& json, const std::string& path, const std::string& expected);

  const Json& m_object;
  std::string m_path;
  std::string m_file;
  std::optional<Error>& m_error;
  std::vector<std::string> m_known;
};

}  // namespace sward::project
