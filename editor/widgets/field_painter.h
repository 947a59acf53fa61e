#pragma once

#include "widgets/field_look.h"
#include "widgets/value_text.h"

#include "base/curve.h"
#include "project/project.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <imgui.h>

namespace sward::editor {

/// What the user did to the fields of a struct in one frame. A drag reports `changed` in many frames and `finished` in
/// its last one: that is one step of undo, named `label`, merged by `path`.
struct FieldEvents {
  bool changed = false;
  bool finished = false;
  std::string path;       ///< of the value, "patch.plants[0].grass.heightM"; set with either of the above
  std::string label;      ///< its name in the middle of a sentence: "blade height"
  std::string openCurve;  ///< path of a curve whose preview was clicked: its panel should open
  std::string browse;     ///< path of a file's path whose folder button was clicked: a dialog should open
  std::string files;      ///< the endings that this dialog accepts, ".glb .gltf"
};

struct FieldOptions {
  std::string filter;        ///< only fields whose label holds these words; empty: all
  bool advanced = false;     ///< also those that few need; one that differs from its default is always shown
  float labelShare = 0.44f;  ///< of the width, for the labels
  const std::vector<project::Problem>* problems = nullptr;  ///< of the document: shown at the fields that they name
};

/// One row while it is drawn.
struct FieldRow {
  std::string path;
  FieldLook look;
  const project::Spec* spec = nullptr;
  bool differs = false;   ///< from its default
  bool optional = false;  ///< may be absent
  bool enabled = true;    ///< an optional one is there
  std::string problem;    ///< why the value is wrong; empty: it is fine
};

enum class RowMenu { None, Reset, Copy, Paste };

struct ChoiceItem {
  const char* label;
  const char* help;
};

/// Draws rows for FieldWalker: everything that needs no template.
class FieldPainter {
 public:
  FieldPainter(std::string root, const FieldOptions& options);

  bool matches(const std::string& label) const;

  /// Label and place of a row; false when it is filtered out (then nothing else is called for it).
  bool beginRow(FieldRow& row);
  void switchOptional(FieldRow& row);
  void showUnset(const FieldRow& row);
  void edit(FieldRow& row, double& value, double fallback);
  void edit(FieldRow& row, int& value, int fallback);
  void edit(FieldRow& row, std::uint64_t& value, std::uint64_t fallback);
  void edit(FieldRow& row, bool& value, bool fallback);
  void edit(FieldRow& row, std::string& value, const std::string& fallback);
  void edit(FieldRow& row, glm::dvec3& value, const glm::dvec3& fallback);
  void edit(FieldRow& row, base::Curve& value, const base::Curve& fallback);
  /// True when another item was chosen; `chosen` may be past the end, for a value that is none of them.
  bool choose(FieldRow& row, const std::vector<ChoiceItem>& items, std::size_t& chosen);
  RowMenu endRow(FieldRow& row);

  /// A foldable title; false when it is folded, filtered out or switched off.
  bool beginStruct(FieldRow& row, bool innerMatches, bool* on);
  void endStruct();
  void endGroup();

  void copy(const std::string& text) const;
  /// Reads the clipboard into the value, held in its range.
  template <typename T>
  bool paste(const FieldRow& row, T& value) {
    T read = value;
    if (!readValue(clipboard(), read)) return false;
    hold(row, read);
    if (read == value) return false;
    value = std::move(read);
    report(row, {true, true});
    return true;
  }

  FieldEvents finish();

 private:
  void label(const FieldRow& row, float width);
  bool foldTitle(const std::string& title, const std::string& path, bool* on);
  void tooltip(const FieldRow& row) const;
  std::string rangeText(const FieldRow& row) const;
  bool group(const std::string& title);
  void report(const FieldRow& row, const EditState& state);
  void findProblem(FieldRow& row) const;
  void checkRange(FieldRow& row, double value) const;
  float widgetWidth() const;
  static std::string clipboard();
  static void hold(const FieldRow& row, double& value);
  static void hold(const FieldRow& row, int& value);
  static void hold(const FieldRow& row, glm::dvec3& value);
  static void hold(const FieldRow& row, base::Curve& value);
  static void hold(const FieldRow&, std::uint64_t&) {}
  static void hold(const FieldRow&, bool&) {}
  static void hold(const FieldRow&, std::string&) {}
  template <typename E>
  requires std::is_enum_v<E>
  static void hold(const FieldRow&, E&) {}

  const FieldOptions& m_options;
  FieldEvents m_events;
  float m_left = 0.0f;   ///< screen x where labels start
  float m_width = 0.0f;  ///< of the whole block
  int m_depth = 0;       ///< of nested structs
  ImVec2 m_rowMin, m_rowMax;
  bool m_labelHovered = false;
  bool m_factsHaveRange = false;  ///< the row is of numbers
  std::string m_default;          ///< of the row, for its tooltip
  // Of each open struct, the outermost first:
  std::vector<std::string> m_groups;
  std::vector<bool> m_groupOpen;
  std::vector<bool> m_matchAll;  ///< its own title matches the filter, or there is none
};

}  // namespace sward::editor
