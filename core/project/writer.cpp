#include "project/writer.h"

#include <algorithm>

namespace sward::project {
namespace {

bool staysOnOneLine(const Json& json) {
  if (!json.is_array()) return !json.is_object();
  return std::all_of(json.begin(), json.end(), staysOnOneLine);
}

std::string compactText(const Json& json) {
  if (!json.is_array()) return json.dump();
  std::string text = "[";
  for (const Json& item : json) {
    if (text.size() > 1) text += ", ";
    text += compactText(item);
  }
  return text + "]";
}

void append(std::string& text, const Json& json, std::size_t depth) {
  if (staysOnOneLine(json)) {
    text += compactText(json);
    return;
  }
  const bool object = json.is_object();
  const std::string indent(2 * (depth + 1), ' ');
  text += object ? "{" : "[";
  bool first = true;
  for (auto item = json.begin(); item != json.end(); ++item) {
    text += first ? "\n" : ",\n";
    first = false;
    text += indent;
    if (object) text += Json(item.key()).dump() + ": ";
    append(text, item.value(), depth + 1);
  }
  if (!first) text += "\n" + std::string(2 * depth, ' ');
  text += object ? "}" : "]";
}

}  // namespace

std::string prettyText(const Json& json) {
  std::string text;
  append(text, json, 0);
  return text + "\n";
}

}  // namespace sward::project
