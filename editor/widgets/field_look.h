#pragma once

#include "widgets/number_field.h"

#include "project/schema.h"

#include <string>
#include <string_view>

namespace sward::editor {

/// How a field of the schema is shown: its Spec with every gap filled.
struct FieldLook {
  std::string label;  ///< "Blade height"
  std::string help;
  std::string group;  ///< title under which neighbouring fields stand; may be empty
  NumberStyle number;
  bool colour = false;    ///< three numbers that are linear RGB
  bool advanced = false;  ///< hidden until asked for
  std::string files;      ///< a text that is a file's path: the endings that are accepted, ".glb .gltf"
};

/// "heightM" as "Height", "densityPerM2" as "Density", "hourUtc" as "Hour UTC".
std::string prettyName(std::string_view name);
/// "Blade height" as "blade height", for the middle of a sentence; "UV scale" stays.
std::string lowerFirst(std::string text);

/// The look of the field `name` whose default is about `typical` (which chooses between m, cm and mm).
FieldLook fieldLook(const char* name, const project::Spec& spec, double typical);

}  // namespace sward::editor
