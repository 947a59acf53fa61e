#include "commands.h"

#include "bake/plants.h"
#include "bake/soil.h"
#include "render/frame_plan.h"
#include "scene/lights.h"

namespace sward::editor {
namespace {

/// Opens what validate() only finds: meshes and the soil's texture.
void checkAssets(const project::Project& project, std::vector<project::Problem>& problems) {
  const auto add = [&](const std::string& where, const Error& error) {
    problems.push_back({true, where, error.where.empty() ? error.what : error.where + ": " + error.what, error.remedy});
  };
  for (std::size_t i = 0; i < project.patch.plants.size(); ++i) {
    if (project.patch.plants[i].kind != project::PlantKind::Gltf) continue;
    const std::string where = "patch.plants[" + std::to_string(i) + "].gltf.path";
    const auto model = bake::plantModel(project, i, 0);
    if (!model.ok()) {
      add(where, model.error());
      continue;
    }
    for (const std::string& warning : model->warnings) problems.push_back({false, where, warning, ""});
  }
  // Where the sun never rises, a path of the sun has no lights.
  if (const auto lights = scene::lightDirections(project.lights); !lights.ok()) {
    problems.push_back({true, lights.error().where, lights.error().what, lights.error().remedy});
  }
  for (project::Problem& problem : render::terrainProblems(project)) problems.push_back(std::move(problem));
  if (project.patch.soil.texture.empty()) return;
  if (const auto soil = bake::soilColours(project, 8); !soil.ok()) add("patch.soil.texture", soil.error());
}

Result<int> runCheck(Program& program, const std::string& file) {
  SWARD_ASSIGN(const project::Project project, loadProject(program, file));
  std::vector<project::Problem> problems = project::validate(project);
  const auto fatal = [](const project::Problem& problem) { return problem.fatal; };
  if (std::none_of(problems.begin(), problems.end(), fatal)) checkAssets(project, problems);
  const bool bad = std::any_of(problems.begin(), problems.end(), fatal);
  Json list = Json::array();
  for (const project::Problem& problem : problems) {
    const std::string text = Error::badInput(problem.what, problem.where, problem.remedy).text();
    if (problem.fatal) {
      complain(text);
    } else {
      warn(program, text);
    }
    list.push_back(
        {{"fatal", problem.fatal}, {"where", problem.where}, {"what", problem.what}, {"remedy", problem.remedy}});
  }
  if (problems.empty()) say(program, file + " is well");
  if (program.common.json) print({{"project", file}, {"valid", !bad}, {"problems", list}});
  return bad ? kWrongInput : kDone;
}

}  // namespace

void addCheckCommand(CLI::App& app, Program& program) {
  CLI::App* command = addCommand(app, program, "check", "Validate a project: each problem, its place, and a remedy",
                                 "Exit code 2 when the project cannot be baked; warnings alone give 0.\n\n"
                                 "Example:\n  sward check meadow.sward --json");
  const auto file = std::make_shared<std::string>();
  command->add_option("PROJECT", *file, "The project, a .sward file")->required();
  command->callback([&program, file] { program.run = [&program, file] { return runCheck(program, *file); }; });
}

}  // namespace sward::editor
