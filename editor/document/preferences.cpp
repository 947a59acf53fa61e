#include "document/preferences.h"

#include "base/file.h"
#include "document/user_folders.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <nlohmann/json.hpp>

namespace sward::editor {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::uint64_t kMaxFileBytes = std::uint64_t{1} << 20;
constexpr std::uint64_t kMinCacheBytes = std::uint64_t{64} << 20, kMaxCacheBytes = std::uint64_t{1} << 40;
constexpr int kMaxScreen = 65536;  ///< no screen, nor a row of them, is wider
constexpr std::size_t kMaxListed = 256;

/// Takes values out of a JSON object; what is wrong with one is said, and its default stays.
class Values {
 public:
  Values(Json& object, std::string path, std::vector<std::string>& messages)
      : m_object(object), m_path(std::move(path)), m_messages(messages) {}

  /// The value of a key, taken out of the object; null when it is absent.
  Json take(const char* key) {
    const auto found = m_object.find(key);
    if (found == m_object.end()) return {};
    Json value = std::move(*found);
    m_object.erase(found);
    return value;
  }
  void flag(const char* key, bool& value) {
    const Json json = take(key);
    if (json.is_null()) return;
    if (!json.is_boolean()) return wrong(key, "true or false");
    value = json.get<bool>();
  }
  void text(const char* key, std::string& value) {
    const Json json = take(key);
    if (json.is_null()) return;
    if (!json.is_string()) return wrong(key, "a text");
    value = json.get<std::string>();
  }
  template <typename T>
  void number(const char* key, T& value, T low, T high) {
    const Json json = take(key);
    if (json.is_null()) return;
    std::ostringstream range;
    range << "a number from " << low << " to " << high;
    if (!json.is_number()) return wrong(key, range.str());
    const double given = json.get<double>();
    if (!(given >= static_cast<double>(low) && given <= static_cast<double>(high))) return wrong(key, range.str());
    value = json.get<T>();
  }
  std::vector<std::string> texts(const char* key, std::vector<std::string> defaults) {
    const Json json = take(key);
    if (json.is_null()) return defaults;
    std::vector<std::string> list;
    const bool fine = json.is_array() && json.size() <= kMaxListed;
    for (std::size_t i = 0; fine && i < json.size(); ++i) {
      if (json[i].is_string()) list.push_back(json[i].get<std::string>());
    }
    if (!fine || list.size() != json.size()) {
      wrong(key, "a list of texts");
      return defaults;
    }
    return list;
  }
  void wrong(const std::string& key, const std::string& expected) {
    m_messages.push_back("preferences: " + m_path + key + " should be " + expected + "; the default is used.");
  }

 private:
  Json& m_object;
  std::string m_path;
  std::vector<std::string>& m_messages;
};

void readWindow(Values& values, WindowPlace& window, std::vector<std::string>& messages) {
  Json json = values.take("window");
  if (json.is_null()) return;
  if (!json.is_object()) return values.wrong("window", "an object");
  Values inner(json, "window.", messages);
  inner.number("x", window.x, -kMaxScreen, kMaxScreen);
  inner.number("y", window.y, -kMaxScreen, kMaxScreen);
  inner.number("width", window.width, 64, kMaxScreen);
  inner.number("height", window.height, 64, kMaxScreen);
  inner.flag("known", window.known);
  inner.flag("maximised", window.maximised);
}

void readTheme(Values& values, ThemeChoice& theme) {
  std::string word = theme == ThemeChoice::Dark ? "dark" : "light";
  values.text("theme", word);
  if (word != "dark" && word != "light") return values.wrong("theme", "\"dark\" or \"light\"");
  theme = word == "dark" ? ThemeChoice::Dark : ThemeChoice::Light;
}

void readPanels(Values& values, std::map<std::string, double>& sizes) {
  const Json json = values.take("panelSizes");
  if (json.is_null()) return;
  if (!json.is_object() || json.size() > kMaxListed) return values.wrong("panelSizes", "sizes by panel");
  for (auto item = json.begin(); item != json.end(); ++item) {
    const bool fine = item->is_number() && item->get<double>() >= 0.0 && item->get<double>() <= kMaxScreen;
    if (fine) {
      sizes[item.key()] = item->get<double>();
    } else {
      values.wrong("panelSizes." + item.key().substr(0, 64), "a size from 0 to " + std::to_string(kMaxScreen));
    }
  }
}

Preferences fromJson(Json& json, std::vector<std::string>& messages) {
  Preferences p;
  Values values(json, "", messages);
  values.number("uiScale", p.uiScale, 0.0, 4.0);
  if (p.uiScale > 0.0 && p.uiScale < 0.5) {
    values.wrong("uiScale", "0 (automatic) or a number from 0.5 to 4");
    p.uiScale = 0.0;
  }
  readTheme(values, p.theme);
  values.number("cacheLimitBytes", p.cacheLimitBytes, kMinCacheBytes, kMaxCacheBytes);
  values.text("device", p.device);
  values.flag("showHints", p.showHints);
  values.number("autosaveSeconds", p.autosaveSeconds, 1.0, 3600.0);
  const std::vector<std::string> recent = values.texts("recentFiles", {});
  for (std::size_t i = recent.size(); i-- > 0;) p.addRecent(recent[i]);
  readWindow(values, p.window, messages);
  readPanels(values, p.panelSizes);
  p.openPanels = values.texts("openPanels", {});
  if (!json.empty()) p.otherKeys = json.dump();
  return p;
}

Json toJson(const Preferences& p) {
  Json json;
  json["uiScale"] = p.uiScale;
  json["theme"] = p.theme == ThemeChoice::Dark ? "dark" : "light";
  json["cacheLimitBytes"] = p.cacheLimitBytes;
  json["device"] = p.device;
  json["showHints"] = p.showHints;
  json["autosaveSeconds"] = p.autosaveSeconds;
  json["recentFiles"] = Json::array();
  for (const fs::path& file : p.recentFiles) json["recentFiles"].push_back(file.string());
  json["window"] = {{"x", p.window.x},           {"y", p.window.y},         {"width", p.window.width},
                    {"height", p.window.height}, {"known", p.window.known}, {"maximised", p.window.maximised}};
  json["panelSizes"] = Json::object();
  for (const auto& [panel, size] : p.panelSizes) json["panelSizes"][panel] = size;
  json["openPanels"] = p.openPanels;
  const Json other = Json::parse(p.otherKeys, nullptr, false);
  if (other.is_object()) {
    for (auto item = other.begin(); item != other.end(); ++item) {
      if (!json.contains(item.key())) json[item.key()] = item.value();
    }
  }
  return json;
}

/// Puts a damaged file aside, so that the next save does not write over what someone may want to mend.
void setAside(const fs::path& file, const std::string& why, std::vector<std::string>& messages) {
  const fs::path aside = file.string() + ".bad";
  std::error_code code;
  fs::rename(file, aside, code);
  const std::string kept = code ? "" : " The file is kept as " + aside.string() + ".";
  messages.push_back("The preferences could not be read (" + why + "); the defaults are used." + kept);
}

/// Brackets nest no deeper than preferences ever do; parsing recurses into what follows.
bool isDeep(const std::string& text) {
  constexpr int kMaxDepth = 32;
  int depth = 0;
  for (const char c : text) {
    if (c == '{' || c == '[') ++depth;
    if (c == '}' || c == ']') --depth;
    if (depth > kMaxDepth) return true;
  }
  return false;
}

}  // namespace

void Preferences::addRecent(const fs::path& file) {
  if (file.empty()) return;
  std::error_code code;
  const fs::path absolute = fs::absolute(file, code).lexically_normal();
  removeRecent(absolute);
  recentFiles.insert(recentFiles.begin(), absolute);
  if (recentFiles.size() > kMaxRecent) recentFiles.resize(kMaxRecent);
}

void Preferences::removeRecent(const fs::path& file) {
  std::erase(recentFiles, file);
}

std::vector<RecentFile> recentFiles(const Preferences& preferences) {
  std::vector<RecentFile> list;
  for (const fs::path& file : preferences.recentFiles) {
    std::error_code code;
    list.push_back({file, !fs::is_regular_file(file, code)});
  }
  return list;
}

fs::path preferencesFile() {
  const fs::path folder = configFolder();
  return folder.empty() ? folder : folder / "preferences.json";
}

LoadedPreferences loadPreferences(const fs::path& file) {
  LoadedPreferences loaded;
  std::error_code code;
  if (file.empty() || !fs::exists(file, code)) return loaded;
  const Result<std::string> text = base::readTextFile(file, kMaxFileBytes);
  if (!text.ok()) {
    setAside(file, text.error().what, loaded.messages);
    return loaded;
  }
  Json json = isDeep(*text) ? Json() : Json::parse(*text, nullptr, false);
  if (!json.is_object()) {
    setAside(file, "it is no JSON object", loaded.messages);
    return loaded;
  }
  loaded.preferences = fromJson(json, loaded.messages);
  return loaded;
}

Result<void> savePreferences(const Preferences& preferences, const fs::path& file) {
  if (file.empty()) {
    return Error::failed("there is no folder for preferences", "", "Set HOME or XDG_CONFIG_HOME.");
  }
  std::error_code code;
  fs::create_directories(file.parent_path(), code);
  try {
    return base::writeFileAtomically(file, toJson(preferences).dump(2) + "\n");
  } catch (const Json::exception&) {
    return Error::badInput("a name or path is not valid UTF-8", file.string(), "Remove it from the recent files.");
  }
}

}  // namespace sward::editor
