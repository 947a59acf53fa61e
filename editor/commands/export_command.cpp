#include "commands.h"

#include "export/plants.h"

namespace sward::editor {
namespace {

struct ExportRequest {
  std::string project, folder;
};

Result<int> runExport(Program& program, const ExportRequest& request) {
  SWARD_ASSIGN(const project::Project project, loadProject(program, request.project));
  SWARD_TRY(checkProject(program, project));
  std::vector<std::filesystem::path> files;
  {
    ProgressBar bar(program);
    SWARD_ASSIGN(files, exporting::exportPlants(project, request.folder, bar.job()));
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
  CLI::App* command = addCommand(app, program, "export", "Write the plants of a project as binary glTF",
                                 "One .glb a plant and variant, y up, metres, colours in vertices and textures.\n\n"
                                 "Example:\n  sward export meadow.sward -o plants");
  const auto request = std::make_shared<ExportRequest>();
  command->add_option("PROJECT", request->project, "The project, a .sward file")->required();
  command->add_option("-o,--output", request->folder, "Folder to write to; made when needed")
      ->required()
      ->type_name("DIR");
  command->callback(
      [&program, request] { program.run = [&program, request] { return runExport(program, *request); }; });
}

}  // namespace sward::editor
