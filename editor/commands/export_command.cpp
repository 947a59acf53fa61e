#include "commands.h"

#include "export/plants.h"
#include "export/texels.h"

#include <filesystem>

namespace sward::editor {
namespace {

struct ExportRequest {
  std::string project, folder;
  bool texels = false;
  int frames = 1;
};

Result<int> runExport(Program& program, const ExportRequest& request) {
  SWARD_ASSIGN(const project::Project project, loadProject(program, request.project));
  SWARD_TRY(checkProject(program, project));
  if (request.frames > 1 && !request.texels) {
    return Error::badInput("--frames is for texels", "--frames", "Add --texels, or leave it out.");
  }
  std::vector<std::filesystem::path> files;
  {
    ProgressBar bar(program);
    const std::string name = std::filesystem::path(request.project).stem().string();
    SWARD_ASSIGN(files, request.texels
                            ? exporting::exportTexels(project, name, request.folder, request.frames, bar.job())
                            : exporting::exportPlants(project, request.folder, bar.job()));
  }
  Json list = Json::array();
  for (const auto& file : files) {
    say(program, "wrote " + file.string());
    list.push_back(file.string());
  }
  if (files.empty()) warn(program, "the project has no plants, so nothing was written");
  if (program.common.json) print({{"files", list}});
  return kDone;
}

}  // namespace

void addExportCommand(CLI::App& app, Program& program) {
  CLI::App* command =
      addCommand(app, program, "export", "Write the plants or the texels of a project for other programs",
                 "Plants: one .glb a plant and variant, y up, metres, colours in vertices and textures.\n"
                 "Texels: the project's voxels as OpenVDB, z up, metres, with the grids density, Cd,\n"
                 "normal, tangent and others; Blender and Houdini open them.\n\n"
                 "Examples:\n  sward export meadow.sward -o plants\n"
                 "  sward export autumn.sward -o voxels --texels --frames 10");
  const auto request = std::make_shared<ExportRequest>();
  command->add_option("PROJECT", request->project, "The project, a .sward file")->required();
  command->add_option("-o,--output", request->folder, "Folder to write to; made when needed")
      ->required()
      ->type_name("DIR");
  command->add_flag("--texels", request->texels, "Write the texel at the project's weathering degree as .vdb");
  command->add_option("--frames", request->frames, "With --texels: this many files from green (0) to straw (1)")
      ->type_name("N")
      ->check(CLI::Range(1, 9999));
  command->callback(
      [&program, request] { program.run = [&program, request] { return runExport(program, *request); }; });
}

}  // namespace sward::editor
