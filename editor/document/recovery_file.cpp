#include "document/recovery_file.h"

#include "base/hash.h"

#include <string_view>

#include <nlohmann/json.hpp>

namespace sward::editor {
namespace {

using Json = nlohmann::ordered_json;

/// "sward-autosave 1 HASH LENGTH\n"; compared as a whole, so that there is nothing in it to parse wrongly.
std::string headerOf(std::string_view payload) {
  const base::Hash128 hash = base::hashBytes(std::as_bytes(std::span(payload.data(), payload.size())));
  return "sward-autosave 1 " + hash.hex() + " " + std::to_string(payload.size()) + "\n";
}

Error damaged(const std::filesystem::path& file, const std::string& what) {
  return Error::badInput(what, file.string(), "It cannot be recovered; an older save of the project may help.");
}

}  // namespace

Result<std::string> recoveryText(const RecoveryFile& content) {
  try {
    const std::string projectText = project::toJson(content.project);
    if (const auto again = project::parse(projectText, content.file); !again.ok()) return again.error();
    Json json;
    json["title"] = content.title;
    json["file"] = content.file.string();
    json["folder"] = content.folder.string();
    json["unixSeconds"] = content.unixSeconds;
    json["processId"] = content.processId;
    json["project"] = projectText;
    const std::string payload = json.dump(1) + "\n";
    return headerOf(payload) + payload;
  } catch (const Json::exception&) {
    return Error::badInput("a name or path is not valid UTF-8", content.title, "Rename it.");
  }
}

Result<RecoveryFile> parseRecovery(const std::string& text, const std::filesystem::path& file) {
  const std::size_t line = text.find('\n');
  if (line == std::string::npos) return damaged(file, "the autosave is cut off");
  const std::string payload = text.substr(line + 1);
  if (text.compare(0, line + 1, headerOf(payload)) != 0) {
    return damaged(file, "the autosave is damaged or cut off: its checksum does not fit");
  }
  RecoveryFile content;
  std::string projectText;
  try {
    const Json json = Json::parse(payload);
    content.title = json.at("title").get<std::string>();
    content.file = json.at("file").get<std::string>();
    content.folder = json.at("folder").get<std::string>();
    content.unixSeconds = json.at("unixSeconds").get<std::int64_t>();
    content.processId = json.at("processId").get<std::int64_t>();
    projectText = json.at("project").get<std::string>();
  } catch (const Json::exception&) {
    return damaged(file, "the autosave is not one of this version's");
  }
  SWARD_ASSIGN(content.project, project::parse(projectText, file));
  content.project.folder = content.folder;
  return content;
}

}  // namespace sward::editor
