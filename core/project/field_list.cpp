#include "project/field_list.h"

#include "project/reader.h"
#include "project/schema.h"
#include "project/words.h"
#include "project/writer.h"

#include <optional>
#include <type_traits>

namespace sward::project {
namespace {

/// The archive that lists fields; it walks default values, and one default entry of every list.
class FieldLister {
 public:
  template <typename T>
  using Ref = const T&;

  FieldLister(std::string owner, std::vector<FieldInfo>& fields) : m_owner(std::move(owner)), m_fields(fields) {}

  void version(int number) {
    FieldInfo& info =
        add("version", FieldKind::Whole,
            range(1, number).says("Version", "Version of the format, so that newer files are recognised."));
    info.defaultValue = Json(number).dump();
  }
  template <typename T>
  void field(const char* name, const T& value, const Spec& spec = {}) {
    visit(name, value, spec);
  }
  template <typename T>
  void field(const char* name, const std::optional<T>&, const Spec& spec = {}) {
    const std::size_t index = m_fields.size();
    visit(name, T{}, spec);
    m_fields[index].optional = true;
    m_fields[index].defaultValue.clear();
  }
  template <typename T>
  void choice(const char* name, const T& value, bool, const Spec& spec = {}) {
    visit(name, value, spec);
  }

 private:
  FieldInfo& add(const char* name, FieldKind kind, const Spec& spec) {
    return m_fields.emplace_back(FieldInfo{childPath(m_owner, name), m_owner, name, kind, false, "", {}, spec});
  }
  template <typename T>
  void scalar(const char* name, FieldKind kind, const T& value, const Spec& spec) {
    add(name, kind, spec).defaultValue = Json(value).dump();
  }

  void visit(const char* name, bool value, const Spec& spec) { scalar(name, FieldKind::Flag, value, spec); }
  void visit(const char* name, int value, const Spec& spec) { scalar(name, FieldKind::Whole, value, spec); }
  void visit(const char* name, std::uint64_t value, const Spec& spec) { scalar(name, FieldKind::Whole, value, spec); }
  void visit(const char* name, double value, const Spec& spec) { scalar(name, FieldKind::Number, value, spec); }
  void visit(const char* name, const std::string& value, const Spec& spec) {
    scalar(name, FieldKind::Text, value, spec);
  }
  void visit(const char* name, const glm::dvec3& v, const Spec& spec) {
    scalar(name, FieldKind::Vector, Json::array({v.x, v.y, v.z}), spec);
  }
  void visit(const char* name, const base::Curve& curve, const Spec& spec) {
    Json points = Json::array();
    for (const base::CurvePoint& point : curve.points()) points.push_back(Json::array({point.x, point.y}));
    scalar(name, FieldKind::Curve, points, spec);
  }
  template <typename T>
  void visit(const char* name, const std::vector<T>&, const Spec& spec) {
    inside(add(name, FieldKind::List, spec).path + "[]", T{});
  }
  template <typename T>
  void visit(const char* name, const T& value, const Spec& spec) {
    if constexpr (std::is_enum_v<T>) {
      FieldInfo& info = add(name, FieldKind::Word, spec);
      info.defaultValue = Json(std::string(wordOf(value))).dump();
      for (const Word<T>& word : words(T{})) info.words.push_back({std::string(word.text), word.label, word.help});
    } else {
      inside(add(name, FieldKind::Struct, spec).path, value);
    }
  }
  /// `path` by value: the list that it comes from grows.
  template <typename T>
  void inside(std::string path, const T& value) {
    FieldLister inner(std::move(path), m_fields);
    describe(inner, value);
  }

  std::string m_owner;
  std::vector<FieldInfo>& m_fields;
};

}  // namespace

std::vector<FieldInfo> fieldList() {
  std::vector<FieldInfo> fields;
  FieldLister archive("", fields);
  describe(archive, Project{});
  return fields;
}

}  // namespace sward::project
