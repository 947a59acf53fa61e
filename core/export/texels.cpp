#include "export/texels.h"

#include "bake/texel_baker.h"
#include "export/folder.h"
#include "export/vdb.h"

#include <array>
#include <cstdio>

namespace sward::exporting {

Result<std::vector<std::filesystem::path>> exportTexels(const project::Project& project, const std::string& name,
                                                        const std::filesystem::path& folder, int frames,
                                                        const JobContext& job) {
  SWARD_TRY(makeFolder(folder));
  project::Project moment = project;
  bake::TexelBaker baker;
  std::vector<std::filesystem::path> files;
  for (int frame = 1; frame <= frames; ++frame) {
    std::array<char, 16> number{};
    if (frames > 1) {
      moment.wither.weathering = (frame - 1.0) / (frames - 1.0);
      std::snprintf(number.data(), number.size(), ".%04d", frame);
    }
    SWARD_ASSIGN(const auto texels, baker.texels(moment, job));
    files.push_back(folder / (name + number.data() + ".vdb"));
    SWARD_TRY(writeVdb(*texels->levels.front().texel, files.back()));
    if (job.onProgress) job.onProgress(files.back().filename().string(), static_cast<double>(frame) / frames);
  }
  return files;
}

}  // namespace sward::exporting
