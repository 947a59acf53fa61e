// The architecture, checked on the include lines themselves: static libraries alone would let a header-only include
// pass.

#include "base/file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>

namespace sward {
namespace {

namespace fs = std::filesystem;

/// What each folder of core/ may include beside itself. options.h files need base alone and may be read by project.
const std::map<std::string, std::set<std::string>>& allowedIncludes() {
  static const std::set<std::string> upToScene{"base", "image", "mesh", "scene"};
  static const auto with = [](std::set<std::string> base, std::initializer_list<std::string> more) {
    base.insert(more);
    return base;
  };
  static const std::map<std::string, std::set<std::string>> allowed{
      {"base", {}},
      {"image", {"base"}},
      {"mesh", {"base", "image"}},
      {"scene", {"base", "image", "mesh"}},
      {"trace", upToScene},
      {"leaf", {"base", "image"}},
      {"terrain", upToScene},
      {"wither", with(upToScene, {"trace", "leaf"})},
      {"lpt", with(upToScene, {"trace"})},
      {"tiles", with(upToScene, {"trace", "lpt"})},
      {"impostor", {"base", "mesh"}},
      {"project", {"base"}},
      {"bake", with(upToScene, {"trace", "lpt", "tiles", "project", "leaf", "terrain", "wither"})},
      {"gpu", {"base", "image"}},
      {"render", with(upToScene, {"trace", "leaf", "terrain", "wither", "lpt", "tiles", "project", "bake", "gpu"})},
      {"export",
       with(upToScene, {"trace", "leaf", "terrain", "wither", "lpt", "tiles", "project", "bake", "gpu", "render"})},
      {"report",
       with(upToScene, {"trace", "leaf", "terrain", "wither", "lpt", "tiles", "project", "bake", "gpu", "render"})},
  };
  return allowed;
}

bool isSource(const fs::path& path) {
  return path.extension() == ".h" || path.extension() == ".cpp";
}

TEST(Layout, IncludesFollowTheArrows) {
  const std::regex include("#include \"([a-z_]+)/([a-z_0-9]+\\.h)\"");
  int lines = 0;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(SWARD_SOURCE_DIR) / "core")) {
    if (!isSource(entry.path())) continue;
    const std::string folder = entry.path().parent_path().filename().string();
    const auto allowed = allowedIncludes().find(folder);
    ASSERT_NE(allowed, allowedIncludes().end()) << folder << " is not in the table of folders";
    const std::string text = base::readTextFile(entry.path()).value();
    const bool options = entry.path().filename() == "options.h";
    for (std::sregex_iterator it(text.begin(), text.end(), include), end; it != end; ++it) {
      const std::string target = (*it)[1];
      ++lines;
      if (options) {
        EXPECT_EQ(target, "base") << entry.path() << " is an options.h and may need base alone";
      } else if (folder == "project" && (*it)[2] == "options.h") {
        continue;
      } else {
        EXPECT_TRUE(target == folder || allowed->second.contains(target)) << entry.path() << " includes " << (*it)[0];
      }
    }
  }
  EXPECT_GT(lines, 100);
}

/// The same for editor/: what each folder of it may include of the others and of core/.
TEST(Layout, EditorIncludesFollowTheArrows) {
  const std::set<std::string> core{"base",    "image", "mesh", "scene",  "terrain", "trace",  "lpt",   "tiles",
                                   "project", "bake",  "gpu",  "render", "export",  "report", "wither"};
  const std::map<std::string, std::set<std::string>> allowed{
      {"document", {"base", "project", "wither"}},
      {"live",
       {"base", "image", "mesh", "scene", "terrain", "trace", "lpt", "tiles", "project", "bake", "gpu", "render"}},
      {"widgets", {"base", "image", "scene", "project"}},
      {"panels", {"document", "live", "widgets"}},
      {"app", {"document", "live", "widgets", "panels"}},
      {"commands", {"document", "live", "widgets", "panels", "app"}},
  };
  const std::regex include("#include \"([a-z_]+)/([a-z_0-9]+\\.h)\"");
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(SWARD_SOURCE_DIR) / "editor")) {
    if (!isSource(entry.path())) continue;
    const std::string folder = entry.path().parent_path().filename().string();
    const auto folders = allowed.find(folder);
    ASSERT_NE(folders, allowed.end()) << folder << " is not in the table of folders";
    const bool joins = folder == "panels" || folder == "app" || folder == "commands";
    const std::string text = base::readTextFile(entry.path()).value();
    for (std::sregex_iterator it(text.begin(), text.end(), include), end; it != end; ++it) {
      const std::string target = (*it)[1];
      const bool fine = target == folder || folders->second.contains(target) || (joins && core.contains(target));
      EXPECT_TRUE(fine) << entry.path() << " includes " << (*it)[0];
    }
  }
}

TEST(Layout, HeavyLibrariesStayInTheirFolders) {
  const std::map<std::string, std::set<std::string>> homes{
      {"embree3/", {"trace", "report", "bake"}},
      {"EGL/", {"gpu"}},
      {"GL/glcorearb.h", {"gpu"}},
      {"tiny_gltf.h", {"mesh"}},
      {"OpenImageIO/", {"image"}},
      {"Eigen/", {"trace", "lpt", "report"}},
      {"openvdb/", {"export"}},
  };
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(SWARD_SOURCE_DIR) / "core")) {
    if (!isSource(entry.path())) continue;
    const std::string folder = entry.path().parent_path().filename().string();
    const std::string text = base::readTextFile(entry.path()).value();
    for (const auto& [library, folders] : homes) {
      if (text.find("#include <" + library) != std::string::npos) {
        EXPECT_TRUE(folders.contains(folder)) << entry.path() << " includes " << library;
      }
    }
  }
}

}  // namespace
}  // namespace sward
