#include "commands.h"

#include "bake/import.h"

#include <algorithm>
#include <iostream>

namespace sward::editor {
namespace {

namespace fs = std::filesystem;

struct NewRequest {
  std::string file, templateName = "meadow", grass;
  bool list = false, force = false;
};

/// Puts the mesh in place of the template's grasses, with all their share.
Result<void> useMesh(project::Project& project, const fs::path& mesh, const fs::path& projectFolder,
                     std::vector<std::string>& notes) {
  SWARD_ASSIGN(bake::ImportedPlant imported, bake::plantFromMesh(mesh, project, projectFolder));
  project::Plant& plant = imported.plant;
  project.sampling.slices = imported.slices;
  notes = std::move(imported.notes);
  double share = 0.0;
  for (const project::Plant& p : project.patch.plants) share += p.kind == project::PlantKind::Grass ? p.share : 0.0;
  plant.share = share > 0.0 ? share : 1.0;
  std::erase_if(project.patch.plants, [](const project::Plant& p) { return p.kind == project::PlantKind::Grass; });
  project.patch.plants.insert(project.patch.plants.begin(), std::move(plant));
  return {};
}

int listTemplates(const Program& program) {
  if (program.common.json) {
    Json descriptions = Json::object();
    for (const project::TemplateInfo& entry : project::templates()) descriptions[entry.name] = entry.description;
    print({{"templates", project::templateNames()}, {"descriptions", descriptions}});
    return kDone;
  }
  std::size_t widest = 0;
  for (const project::TemplateInfo& entry : project::templates()) widest = std::max(widest, entry.name.size());
  for (const project::TemplateInfo& entry : project::templates()) {
    std::cout << entry.name << std::string(widest - entry.name.size() + 2, ' ') << entry.description << '\n';
  }
  return kDone;
}

Result<int> runNew(Program& program, const NewRequest& request) {
  if (request.list) return listTemplates(program);
  if (request.file.empty()) return Error::badInput("no file is named", "sward new", "Give one, such as field.sward.");
  const fs::path file = request.file;
  SWARD_TRY(checkOutputFile(file));
  if (fs::exists(file) && !request.force) {
    return Error::badInput("the file exists", file.string(), "Choose another name, or give --force to replace it.");
  }
  SWARD_ASSIGN(project::Project project, project::fromTemplate(request.templateName));
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (file.has_stem()) project.name = file.stem().string();
  std::vector<std::string> notes;
  if (!request.grass.empty()) SWARD_TRY(useMesh(project, request.grass, folder, notes));
  SWARD_ASSIGN(project, project::parse(project::toJson(project), file, program.common.overrides));
  SWARD_TRY(checkProject(program, project));
  {
    const auto writing = program.interrupts.writing();
    SWARD_TRY(project::save(project, file));
  }
  say(program, "wrote " + file.string() + "; draw it with: sward render " + file.string() + " -o " +
                   file.stem().string() + ".png");
  for (const std::string& note : notes) say(program, "  " + note);
  if (program.common.json) print({{"file", file.string()}, {"template", request.templateName}, {"notes", notes}});
  return kDone;
}

}  // namespace

void addNewCommand(CLI::App& app, Program& program) {
  CLI::App* command = addCommand(app, program, "new", "Start a project from a template",
                                 "Examples:\n"
                                 "  sward new field.sward --template meadow\n"
                                 "  sward new mine.sward --template lawn --grass my_grass.glb\n"
                                 "  sward new --list");
  const auto request = std::make_shared<NewRequest>();
  command->add_option("FILE", request->file, "The project to write, a .sward file");
  command->add_option("--template", request->templateName, "Where to start [meadow]")->type_name("NAME");
  command->add_option("--grass", request->grass, "Your own plant in place of the template's grasses (.glb, .gltf)")
      ->type_name("MESH");
  command->add_flag("--list", request->list, "List the templates");
  command->add_flag("--force", request->force, "Replace an existing file");
  command->callback([&program, request] { program.run = [&program, request] { return runNew(program, *request); }; });
}

}  // namespace sward::editor
