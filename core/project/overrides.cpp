#include "project/overrides.h"

#include <charconv>
#include <optional>
#include <variant>
#include <vector>

namespace sward::project {
namespace {

using Json = nlohmann::ordered_json;
using Step = std::variant<std::string, std::size_t>;  ///< a key, or an index

/// Splits "a.b[0].c" into steps; nothing when it is not a path.
std::optional<std::vector<Step>> pathSteps(std::string_view path) {
  constexpr std::size_t kMaxSteps = 32;
  std::vector<Step> steps;
  bool needKey = true;
  while (!path.empty() || needKey) {
    if (steps.size() >= kMaxSteps) return std::nullopt;
    if (needKey) {
      const std::string_view key = path.substr(0, path.find_first_of(".["));
      if (key.empty() || key.find(']') != std::string_view::npos) return std::nullopt;
      steps.emplace_back(std::string(key));
      path.remove_prefix(key.size());
      needKey = false;
    } else if (path.front() == '.') {
      path.remove_prefix(1);
      needKey = true;
    } else {
      std::size_t index = 0;
      const char* end = path.data() + path.size();
      const auto [stop, code] = std::from_chars(path.data() + 1, end, index);
      if (path.front() != '[' || code != std::errc{} || stop == end || *stop != ']') return std::nullopt;
      steps.emplace_back(index);
      path.remove_prefix(static_cast<std::size_t>(stop - path.data()) + 1);
    }
  }
  return steps;
}

Json valueOf(const std::string& text) {
  // Depth is bounded here because copies and writes of JSON recurse.
  const bool plain = text.find_first_of("[{") != std::string::npos && text.size() > 65536;
  if (plain) return Json(text);
  Json value = Json::parse(text, nullptr, false);
  return value.is_discarded() ? Json(text) : value;
}

}  // namespace

Result<void> applyOverride(Json& document, const std::string& text) {
  const std::string where = "--set " + text.substr(0, 80);
  const std::size_t equals = text.find('=');
  const auto steps = equals == std::string::npos ? std::nullopt : pathSteps(std::string_view(text).substr(0, equals));
  if (!steps) {
    return Error::badInput("this is not an override", where, "Write path=value, such as sun.angles.elevationDeg=20.");
  }
  Json* place = &document;
  std::string walked;
  for (const Step& step : *steps) {
    if (const auto* key = std::get_if<std::string>(&step)) {
      if (place->is_null()) *place = Json::object();
      if (!place->is_object()) {
        return Error::badInput("\"" + walked + "\" has no named values", where, "Check the path.");
      }
      place = &(*place)[*key];
      walked += (walked.empty() ? "" : ".") + *key;
    } else {
      const std::size_t index = std::get<std::size_t>(step);
      const std::size_t size = place->is_array() ? place->size() : 0;
      if (index >= size) {
        return Error::badInput("\"" + walked + "\" has " + std::to_string(size) + " entries, counted from 0", where,
                               "Check the index.");
      }
      place = &(*place)[index];
      walked += "[" + std::to_string(index) + "]";
    }
  }
  *place = valueOf(text.substr(equals + 1));
  return {};
}

}  // namespace sward::project
