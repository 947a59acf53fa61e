#include "project/field_list.h"

#include "project/project.h"

#include <algorithm>
#include <sstream>

namespace sward::project {
namespace {

std::string number(double value) {
  std::ostringstream text;
  text.precision(10);
  text << value;
  return text.str();
}

/// "2 to 5 m"; empty without a range.
std::string rangeText(const FieldInfo& field) {
  const Spec& spec = field.spec;
  if (!(spec.low > Spec::kLowest && spec.high < Spec::kHighest)) return "";
  std::string text = number(spec.low) + " to " + number(spec.high);
  if (*spec.unit != '\0') text += std::string(" ") + spec.unit;
  return text;
}

std::string kindText(const FieldInfo& field) {
  switch (field.kind) {
    case FieldKind::Flag:
      return "true or false";
    case FieldKind::Whole:
      return "whole number";
    case FieldKind::Number:
      return "number";
    case FieldKind::Text:
      return "text";
    case FieldKind::Word:
      return "word";
    case FieldKind::Vector:
      return field.spec.isColour ? "linear RGB" : "[x, y, z]";
    case FieldKind::Curve:
      return "curve";
    case FieldKind::Struct:
      return "object";
    case FieldKind::List:
      return "list";
  }
  return "";
}

/// What may stand there: the range, a curve's two ranges, or the words with their meanings.
std::string allowedText(const FieldInfo& field) {
  if (field.kind == FieldKind::Curve) {
    return "x " + number(field.spec.xLow) + " to " + number(field.spec.xHigh) + ", y " + rangeText(field);
  }
  if (field.kind == FieldKind::List) return rangeText(field);
  std::string text;
  for (const FieldWord& word : field.words) text += (text.empty() ? "" : ", ") + ("`" + word.text + "`");
  return field.words.empty() ? rangeText(field) : text;
}

/// The title of a struct's table: "patch.plants[].grass".
std::string titleOf(const std::string& owner) {
  return owner.empty() ? "The file" : "`" + owner + "`";
}

void writeRow(std::ostream& out, const FieldInfo& field) {
  std::string kind = kindText(field);
  if (field.optional) kind += ", may be left out";
  std::string help = field.spec.help;
  for (const FieldWord& word : field.words) help += " `" + word.text + "`: " + word.help;
  out << "| `" << field.name << "` | " << kind << " | " << allowedText(field) << " | "
      << (field.defaultValue.empty() ? "" : "`" + field.defaultValue + "`") << " | " << help << " |\n";
}

}  // namespace

std::string fieldReference() {
  const std::vector<FieldInfo> fields = fieldList();
  std::vector<std::string> owners;
  for (const FieldInfo& field : fields) {
    if (std::find(owners.begin(), owners.end(), field.owner) == owners.end()) owners.push_back(field.owner);
  }
  std::ostringstream out;
  out << "# The project file\n\n"
         "A `.sward` file is JSON. Every key may be left out: its default stands then. Unknown keys are errors, so "
         "that a\n"
         "slip of the pen does not go unnoticed. `[]` stands for the entries of a list. Lengths are metres, angles\n"
         "degrees, colours linear RGB; x is east, y north, z up. A curve is a list of points [x, y] with x "
         "increasing,\n"
         "joined by a monotone cubic that never leaves the range between two points; it keeps the value of its first "
         "and\n"
         "last point beyond them. Any value can be changed for one run: `--set patch.sideM=2`.\n\n"
         "This page is written from the program's own schema (format version "
      << kFormatVersion << "); a test compares the two.\n";
  for (const std::string& owner : owners) {
    out << "\n## " << titleOf(owner)
        << "\n\n| key | kind | allowed | default | what it decides |\n| --- | --- | --- | --- | --- |\n";
    for (const FieldInfo& field : fields) {
      if (field.owner == owner) writeRow(out, field);
    }
  }
  return out.str();
}

}  // namespace sward::project
