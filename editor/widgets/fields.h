#pragma once

#include "widgets/field_painter.h"

#include <memory>
#include <utility>

/// Structs of the schema as rows of labels and widgets; see drawFields() at the end.
namespace sward::editor {

/// The archive that lists where a struct's fields stand, in the description's order, to pair two structs of one type.
class FieldAddresses {
 public:
  template <typename T>
  using Ref = const T&;

  void version(int) {}
  template <typename T>
  void field(const char*, const T& value, const project::Spec& = {}) {
    m_list.push_back(std::addressof(value));
  }
  template <typename T>
  void choice(const char*, const T& value, bool, const project::Spec& = {}) {
    m_list.push_back(std::addressof(value));
  }
  std::vector<const void*> take() { return std::move(m_list); }

 private:
  std::vector<const void*> m_list;
};

template <typename T>
std::vector<const void*> fieldAddresses(const T& value) {
  FieldAddresses addresses;
  project::describe(addresses, value);
  return addresses.take();
}

template <typename T>
inline constexpr bool kIsList = false;
template <typename T>
inline constexpr bool kIsList<std::vector<T>> = true;

/// The archive that asks whether a filter matches any field of a struct, at any depth.
class FieldSearch {
 public:
  template <typename T>
  using Ref = const T&;

  explicit FieldSearch(const FieldPainter& painter) : m_painter(painter) {}
  void version(int) {}
  template <typename T>
  void field(const char* name, const T& value, const project::Spec& spec = {}) {
    if constexpr (kIsList<T>) return;
    m_found = m_found || m_painter.matches(fieldLook(name, spec, 0.0).label);
    if constexpr (requires(FieldSearch & inner) { project::describe(inner, value); }) project::describe(*this, value);
  }
  template <typename T>
  void field(const char* name, const std::optional<T>& value, const project::Spec& spec = {}) {
    field(name, value.value_or(T{}), spec);
  }
  template <typename T>
  void choice(const char* name, const T& value, bool used, const project::Spec& spec = {}) {
    if (used) field(name, value, spec);
  }
  bool found() const { return m_found; }

 private:
  const FieldPainter& m_painter;
  bool m_found = false;
};

/// The archive that draws a struct's fields and edits them.
class FieldWalker {
 public:
  template <typename T>
  using Ref = T&;

  FieldWalker(FieldPainter& painter, std::string path, std::vector<const void*> defaults)
      : m_painter(painter), m_path(std::move(path)), m_defaults(std::move(defaults)) {}

  void version(int) {}
  template <typename T>
  void field(const char* name, T& value, const project::Spec& spec = {}) {
    visit(name, value, *static_cast<const T*>(m_defaults[m_next++]), spec);
  }
  template <typename T>
  void choice(const char* name, T& value, bool used, const project::Spec& spec = {}) {
    const T& fallback = *static_cast<const T*>(m_defaults[m_next++]);
    if (used) visit(name, value, fallback, spec);
  }
  /// Draws all fields of a struct with this walker's path and defaults.
  template <typename T>
  void walk(T& value) {
    project::describe(*this, value);
    m_painter.endGroup();
  }

 private:
  template <typename T>
  void visit(const char* name, T& value, const T& fallback, const project::Spec& spec) {
    if constexpr (kIsList<T>) {
      return;  // Lists belong to panels, which know how an entry is chosen.
    } else if constexpr (requires(FieldWalker & inner) { project::describe(inner, value); }) {
      structure(name, value, fallback, spec, nullptr);
    } else {
      leaf(name, value, fallback, spec);
    }
  }
  template <typename T>
  void visit(const char* name, std::optional<T>& value, const std::optional<T>& fallback, const project::Spec& spec) {
    const T inner = fallback.value_or(T{});
    if constexpr (requires(FieldWalker & walker, T & v) { project::describe(walker, v); }) {
      bool on = value.has_value();
      T held = value.value_or(inner);
      structure(name, held, inner, spec, &on);
      value = on ? std::optional<T>(held) : std::nullopt;
    } else {
      FieldRow row = rowOf(name, spec, typicalOf(inner), !(value == fallback));
      row.optional = true;
      row.enabled = value.has_value();
      if (!m_painter.beginRow(row)) return;
      T held = value.value_or(inner);
      m_painter.switchOptional(row);
      if (row.enabled) {
        m_painter.edit(row, held, inner);
        value = held;
      } else {
        m_painter.showUnset(row);
        value.reset();
      }
      const RowMenu menu = m_painter.endRow(row);
      if (menu == RowMenu::Reset) value = fallback;
      if (menu == RowMenu::Copy) m_painter.copy(valueText(held));
      if (menu == RowMenu::Paste && m_painter.paste(row, held)) value = held;
    }
  }

  template <typename T>
  void leaf(const char* name, T& value, const T& fallback, const project::Spec& spec) {
    FieldRow row = rowOf(name, spec, typicalOf(fallback), !(value == fallback));
    row.spec = &spec;
    if (!m_painter.beginRow(row)) return;
    if constexpr (std::is_enum_v<T>) {
      choiceOf(row, value);
    } else {
      m_painter.edit(row, value, fallback);
    }
    const RowMenu menu = m_painter.endRow(row);
    if (menu == RowMenu::Reset) value = fallback;
    if (menu == RowMenu::Copy) m_painter.copy(valueText(value));
    if (menu == RowMenu::Paste) m_painter.paste(row, value);
  }

  /// `on`: null for a struct that is always there, else whether an optional one is.
  template <typename T>
  void structure(const char* name, T& value, const T& fallback, const project::Spec& spec, bool* on) {
    FieldRow row = rowOf(name, spec, 0.0, !(value == fallback));
    FieldSearch search(m_painter);
    project::describe(search, std::as_const(value));
    if (!m_painter.beginStruct(row, search.found(), on)) return;
    FieldWalker inner(m_painter, row.path, fieldAddresses(fallback));
    inner.walk(value);
    m_painter.endStruct();
  }

  template <typename E>
  void choiceOf(FieldRow& row, E& value) {
    static constexpr auto kWords = project::words(E{});
    std::vector<ChoiceItem> items;
    std::size_t chosen = kWords.size();
    for (std::size_t i = 0; i < kWords.size(); ++i) {
      if (kWords[i].value == value) chosen = i;
      items.push_back({kWords[i].label, kWords[i].help});
    }
    if (m_painter.choose(row, items, chosen)) value = kWords[chosen].value;
  }

  template <typename T>
  static double typicalOf(const T& value) {
    if constexpr (std::is_arithmetic_v<T>) return static_cast<double>(value);
    return 0.0;
  }

  FieldRow rowOf(const char* name, const project::Spec& spec, double typical, bool differs) const {
    FieldRow row;
    row.path = m_path.empty() ? std::string(name) : m_path + "." + name;
    row.look = fieldLook(name, spec, typical);
    row.differs = differs;
    return row;
  }

  FieldPainter& m_painter;
  std::string m_path;
  std::vector<const void*> m_defaults;
  std::size_t m_next = 0;
};

/// Draws every field of `value` as a row (label, widget) in the current window's width and applies what the user does.
/// `path` is the struct's in the document, such as "patch.plants[0].grass"; `defaults` is what "Reset to default" gives
/// and what values are compared with. Lists of structs are left out: panels draw them. One edit a frame is reported.
template <typename T>
FieldEvents drawFields(const std::string& path, T& value, const T& defaults, const FieldOptions& options = {}) {
  FieldPainter painter(path, options);
  FieldWalker walker(painter, path, fieldAddresses(defaults));
  walker.walk(value);
  return painter.finish();
}

}  // namespace sward::editor
