#include "project/project.h"

#include "base/file.h"
#include "project/overrides.h"
#include "project/reader.h"
#include "project/writer.h"

#include <algorithm>
#include <set>
#include <tuple>

namespace sward::project {
namespace {

/// A project is a few kilobytes; this bounds what a hostile file may cost.
constexpr std::uint64_t kMaxFileBytes = std::uint64_t{16} << 20;
/// The deepest place of the schema is 6 levels down; reading and freeing JSON recurse, so depth is bounded first.
constexpr int kMaxDepth = 32;

struct Place {
  std::size_t line = 1, column = 1;
};

Place placeOf(const std::string& text, std::size_t offset) {
  const std::string_view before = std::string_view(text).substr(0, std::min(offset, text.size()));
  Place place;
  place.line += static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
  const std::size_t lineStart = before.rfind('\n');
  place.column = before.size() - (lineStart == std::string_view::npos ? 0 : lineStart + 1) + 1;
  return place;
}

std::string placeText(const std::string& file, const std::string& text, std::size_t offset) {
  const Place place = placeOf(text, offset);
  return file + ":" + std::to_string(place.line) + ":" + std::to_string(place.column);
}

/// Offset of the first bracket that opens deeper than kMaxDepth, outside of strings.
std::optional<std::size_t> tooDeepAt(const std::string& text) {
  int depth = 0;
  bool inString = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (inString) {
      if (c == '\\') ++i;
      if (c == '"') inString = false;
    } else if (c == '"') {
      inString = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kMaxDepth) return i;
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
  return std::nullopt;
}

/// "[json.exception.parse_error.101] parse error at line 1, column 2: WHAT" -> "WHAT"
std::string withoutPrefix(std::string message) {
  const std::size_t bracket = message.find("] ");
  if (bracket != std::string::npos) message.erase(0, bracket + 2);
  if (message.rfind("parse error", 0) == 0) {
    const std::size_t colon = message.find(": ");
    if (colon != std::string::npos) message.erase(0, colon + 2);
  }
  if (message.size() > 300) message.resize(300);
  return message;
}

/// The JSON of a text; doubled keys are an error, since one of the two values would be lost without a word.
Result<Json> parseJson(const std::string& text, const std::string& file) {
  if (const auto deep = tooDeepAt(text)) {
    return Error::badInput("the file nests deeper than " + std::to_string(kMaxDepth) + " levels",
                           placeText(file, text, *deep), "This is not a project; choose another file.");
  }
  std::vector<std::set<std::string>> open;
  std::string doubled;
  const auto watch = [&](int, Json::parse_event_t event, Json& parsed) {
    if (event == Json::parse_event_t::object_start) open.emplace_back();
    if (event == Json::parse_event_t::object_end && !open.empty()) open.pop_back();
    if (event == Json::parse_event_t::key && !open.empty() && doubled.empty()) {
      const auto key = parsed.get<std::string>();
      if (!open.back().insert(key).second) doubled = key;
    }
    return true;
  };
  try {
    Json json = Json::parse(text, watch);
    if (!doubled.empty()) {
      return Error::badInput("the key \"" + doubled.substr(0, 64) + "\" stands twice in one object", file,
                             "Remove one of them.");
    }
    return json;
  } catch (const Json::parse_error& problem) {
    return Error::badInput("this is not valid JSON: " + withoutPrefix(problem.what()),
                           placeText(file, text, problem.byte > 0 ? problem.byte - 1 : 0), "Correct it there.");
  } catch (const Json::exception& problem) {
    return Error::badInput("this is not valid JSON: " + withoutPrefix(problem.what()), file, "Correct it.");
  }
}

}  // namespace

const scene::View* Project::view(const std::string& viewName) const {
  const auto found = std::find_if(views.begin(), views.end(), [&](const scene::View& v) { return v.name == viewName; });
  return found == views.end() ? nullptr : &*found;
}

bool Project::operator==(const Project& other) const {
  const auto values = [](const Project& p) {
    return std::tie(p.name, p.patch, p.lights, p.sampling, p.fit, p.tiles, p.leaf, p.wither, p.terrain, p.sun, p.sky,
                    p.render, p.accuracy, p.views, p.output, p.sequence);
  };
  return values(*this) == values(other);
}

std::string toJson(const Project& project) {
  Json json;
  Writer writer(json);
  describe(writer, project);
  return prettyText(json);
}

Result<Project> parse(const std::string& json, const std::filesystem::path& file,
                      const std::vector<std::string>& overrides) {
  SWARD_ASSIGN(Json document, parseJson(json, file.string()));
  if (!document.is_object()) {
    return Error::badInput("expected an object, found " + typeName(document), file.string(),
                           "This is not a sward project; choose another file.");
  }
  for (const std::string& text : overrides) SWARD_TRY(applyOverride(document, text));
  Project project;
  std::optional<Error> error;
  Reader reader(document, "", file.string(), error);
  describe(reader, project);
  reader.finish();
  if (error) return *std::move(error);
  project.folder = file.parent_path();
  return project;
}

Result<Project> load(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  SWARD_ASSIGN(const std::string text, base::readTextFile(file, kMaxFileBytes));
  return parse(text, file, overrides);
}

Result<void> save(const Project& project, const std::filesystem::path& file) {
  std::string text;
  try {
    text = toJson(project);
  } catch (const Json::exception&) {
    return Error::badInput("a name or path is not valid UTF-8", file.string(), "Rename it.");
  }
  // Nothing is saved that could not be opened again, such as a NaN.
  if (const auto again = parse(text, file); !again.ok()) return again.error();
  return base::writeFileAtomically(file, text, base::Sync::Yes);
}

}  // namespace sward::project
