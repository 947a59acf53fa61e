#pragma once

#include "project/spec.h"

#include <string>
#include <vector>

namespace sward::project {

/// What a field's value is.
enum class FieldKind { Flag, Whole, Number, Text, Word, Vector, Curve, Struct, List };

struct FieldWord {
  std::string text;  ///< in files
  std::string label;
  std::string help;
};

/// One field of the schema. Fields of a list's entries are named once, with "[]" for the index.
struct FieldInfo {
  std::string path;   ///< "patch.plants[].grass.heightM"
  std::string owner;  ///< path of the struct that holds it, "patch.plants[].grass"; empty at the top
  std::string name;   ///< "heightM"
  FieldKind kind = FieldKind::Struct;
  bool optional = false;         ///< may be left out or null, and is by default
  std::string defaultValue;      ///< as JSON; empty for structs, lists of structs and optional values
  std::vector<FieldWord> words;  ///< what a Word may be
  Spec spec;
};

/// Every field of the schema in the order of the file, structs before their fields. For searching, for the reference
/// and for tests.
std::vector<FieldInfo> fieldList();

/// The format's reference in Markdown: every field with its kind, range, unit, default and help.
std::string fieldReference();

}  // namespace sward::project
