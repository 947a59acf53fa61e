#pragma once

#include "base/hash.h"
#include "project/schema.h"

#include <optional>
#include <string_view>
#include <type_traits>
#include <vector>

namespace sward::project {

/// The archive that enters the values of one role into a bake key, with their names. Whether an optional value is there
/// at all enters keys of both roles; labels (names, file paths) enter none.
class ValueHasher {
 public:
  template <typename T>
  using Ref = const T&;

  /// `inherited` is the role that a surrounding struct forces on all its fields.
  ValueHasher(base::Hasher& hasher, Role wanted, std::optional<Role> inherited = {})
      : m_hasher(hasher), m_wanted(wanted), m_inherited(inherited) {}

  void version(int number) { m_hasher.add(number); }
  template <typename T>
  void field(const char* name, const T& value, const Spec& spec = {}) {
    const Role role = m_inherited.value_or(spec.role);
    if (role == Role::Label) return;
    if constexpr (requires(ValueHasher & inner) { describe(inner, value); }) {
      ValueHasher inner(m_hasher, m_wanted, role == Role::Colour ? std::optional(role) : m_inherited);
      describe(inner, value);
    } else if (role == m_wanted) {
      m_hasher.add(std::string_view(name));
      add(value);
    }
  }
  template <typename T>
  void field(const char* name, const std::optional<T>& value, const Spec& spec = {}) {
    m_hasher.add(std::string_view(name));
    m_hasher.add(value.has_value());
    if (value.has_value()) field(name, *value, spec);
  }
  template <typename T>
  void choice(const char* name, const T& value, bool used, const Spec& spec = {}) {
    if (used) field(name, value, spec);
  }

 private:
  template <typename T>
  void add(const T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      m_hasher.add(value);
    } else {
      m_hasher.add(std::string_view(value));
    }
  }
  void add(const glm::dvec3& v) { m_hasher.add(v.x).add(v.y).add(v.z); }
  void add(const base::Curve& curve) {
    m_hasher.add(curve.points().size());
    for (const base::CurvePoint& point : curve.points()) m_hasher.add(point.x).add(point.y);
  }

  base::Hasher& m_hasher;
  Role m_wanted;
  std::optional<Role> m_inherited;
};

/// Adds the values of `role` of one struct of the schema to a hash.
template <typename T>
void hashValues(base::Hasher& hasher, const T& value, Role role) {
  ValueHasher archive(hasher, role);
  describe(archive, value);
}

}  // namespace sward::project
