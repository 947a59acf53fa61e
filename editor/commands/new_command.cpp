#include "commands.h"

#include "mesh/gltf_read.h"

#include <algorithm>
#include <cmath>
#include <iostream>

namespace sward::editor {
namespace {

namespace fs = std::filesystem;

struct NewRequest {
  std::string file, templateName = "meadow", grass;
  bool list = false, force = false;
};

/// Files drawn in other units than metres are scaled to this height.
constexpr double kUsualHeightM = 0.3;

/// Area of leaves over a unit of ground in a dense sward (one side).
constexpr double kLeafAreaIndex = 3.0;

double surfaceArea(const mesh::Model& model) {
  double area = 0.0;
  for (const glm::uvec3& triangle : model.triangles) {
    const glm::dvec3 a = model.positions[triangle.x], b = model.positions[triangle.y], c = model.positions[triangle.z];
    area += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  return area;
}

/// A plant from a mesh: its own metres where they are a grass's, and as many as make a dense sward.
Result<project::Plant> plantFromMesh(const fs::path& mesh, const fs::path& projectFolder) {
  SWARD_ASSIGN(const mesh::Model model, mesh::readGltf(mesh));
  const mesh::Bounds box = mesh::bounds(model);
  const glm::dvec3 size = glm::dvec3(box.high) - glm::dvec3(box.low);
  project::Plant plant;
  plant.name = mesh.stem().string();
  plant.kind = project::PlantKind::Gltf;
  std::error_code code;
  const fs::path relative = fs::relative(mesh, projectFolder, code);
  plant.gltf.path = code || relative.empty() ? fs::absolute(mesh).string() : relative.generic_string();
  double scale = 1.0;
  if (!(size.z >= 0.02 && size.z <= 2.0)) {
    plant.gltf.heightM = kUsualHeightM;
    scale = kUsualHeightM / std::max(size.z, 1e-9);
  }
  const double areaM2 = std::max(scale * scale * surfaceArea(model), 1e-6);
  plant.densityPerM2 = std::round(std::clamp(kLeafAreaIndex / areaM2, 4.0, 1500.0));
  plant.variants = 1;
  return plant;
}

/// Puts the mesh in place of the template's grasses, with all their share.
Result<void> useMesh(project::Project& project, const fs::path& mesh, const fs::path& projectFolder) {
  SWARD_ASSIGN(project::Plant plant, plantFromMesh(mesh, projectFolder));
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
  if (!request.grass.empty()) SWARD_TRY(useMesh(project, request.grass, folder));
  SWARD_ASSIGN(project, project::parse(project::toJson(project), file, program.common.overrides));
  SWARD_TRY(checkProject(program, project));
  {
    const auto writing = program.interrupts.writing();
    SWARD_TRY(project::save(project, file));
  }
  say(program, "wrote " + file.string() + "; draw it with: sward render " + file.string() + " -o " +
                   file.stem().string() + ".png");
  if (program.common.json) print({{"file", file.string()}, {"template", request.templateName}});
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
