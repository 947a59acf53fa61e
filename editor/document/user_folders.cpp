#include "document/user_folders.h"

#include <cstdlib>
#include <pwd.h>
#include <unistd.h>

namespace sward::editor {
namespace {

namespace fs = std::filesystem;

fs::path absoluteVariable(const char* name) {
  const char* value = std::getenv(name);
  if (value == nullptr || !fs::path(value).is_absolute()) return {};
  return value;
}

fs::path home() {
  if (const fs::path folder = absoluteVariable("HOME"); !folder.empty()) return folder;
  const passwd* user = ::getpwuid(::getuid());
  return user != nullptr && user->pw_dir != nullptr ? fs::path(user->pw_dir) : fs::path();
}

fs::path userFolder(const char* variable, const char* underHome) {
  if (const fs::path folder = absoluteVariable(variable); !folder.empty()) return folder / "sward";
  const fs::path start = home();
  return start.is_absolute() ? start / underHome / "sward" : fs::path();
}

}  // namespace

fs::path configFolder() {
  return userFolder("XDG_CONFIG_HOME", ".config");
}

fs::path stateFolder() {
  return userFolder("XDG_STATE_HOME", ".local/state");
}

}  // namespace sward::editor
