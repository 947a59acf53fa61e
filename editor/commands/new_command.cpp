#include "commands.h"

#include "mesh/gltf_read.h"
#include "mesh/measure.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace sward::editor {
namespace {

namespace fs = std::filesystem;

struct NewRequest {
  std::string file, templateName = "meadow", grass;
  bool list = false, force = false;
};

/// One-sided area of leaves over a unit of ground in a dense sward.
constexpr double kLeafAreaIndex = 5.0;
/// Files this much taller than the template's grass, or this low, were not drawn in metres or not for these views.
constexpr double kTallest = 1.25, kLowestM = 0.02;
/// Plants are at most this wide, in sides of the patch: wider ones would be few, and known again wherever they repeat.
constexpr double kWidest = 0.3;
/// Mean luminances of reflectance: of leaves, of solid parts (which let no light through), and under which a plant
/// reads as a silhouette.
constexpr double kLeafLuminance = 0.19, kSolidLuminance = 0.25, kDarkLuminance = 0.13;
/// Colour of plants whose file gives none (glTF's white).
constexpr glm::dvec3 kGrassColour(0.14, 0.22, 0.055);
constexpr double kNoColourLuminance = 0.5;  ///< leaves reflect less; half of white, since they transmit as well
/// Slabs for plants whose parts are wider than half a usual slab is thick: between coarse slabs they fall into cards.
constexpr int kSlicesOfWideParts = 32;

/// Height of the tallest grass of a project, or a meadow's.
double grassHeightM(const project::Project& project) {
  double height = 0.0;
  for (const project::Plant& p : project.patch.plants)
    if (p.kind == project::PlantKind::Grass) height = std::max(height, p.grass.heightM);
  return height > 0.0 ? height : 0.4;
}

/// For people: three significant digits.
std::string shortNumber(double value) {
  std::ostringstream text;
  text << std::setprecision(3) << value;
  return text.str();
}

/// Two significant digits.
double rounded(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return std::round(value / unit) * unit;
}

/// A plant from a mesh, so that its first picture is a good one: as tall as the template's grass unless its own metres
/// are a grass's, as many as make a dense sward, and not darker than plants are. `notes` says what was chosen.
Result<project::Plant> plantFromMesh(const fs::path& mesh, project::Project& project, const fs::path& projectFolder,
                                     std::vector<std::string>& notes) {
  SWARD_ASSIGN(const mesh::Model model, mesh::readGltf(mesh));
  const mesh::Bounds box = mesh::bounds(model);
  const glm::dvec3 size = glm::dvec3(box.high) - glm::dvec3(box.low);
  const double ownHeightM = size.z, ownWidthM = std::max(size.x, size.y);
  const mesh::Measure measure = mesh::measure(model);
  project::Plant plant;
  plant.name = mesh.stem().string();
  plant.kind = project::PlantKind::Gltf;
  plant.variants = 1;
  plant.tiltDeg = 12.0;  // one mesh alone: more variety in how it stands
  std::error_code code;
  const fs::path relative = fs::relative(mesh, projectFolder, code);
  plant.gltf.path = code || relative.empty() ? fs::absolute(mesh).string() : relative.generic_string();
  const double heightM = grassHeightM(project);
  const std::string where = "patch.plants[0].";
  double scale = 1.0;
  if (!(ownHeightM >= kLowestM && ownHeightM <= kTallest * heightM)) scale = heightM / std::max(ownHeightM, 1e-9);
  scale = std::min(scale, kWidest * project.patch.sideM / std::max(ownWidthM, 1e-9));
  if (scale != 1.0) {
    plant.gltf.heightM = std::max(rounded(scale * ownHeightM), 0.002);
    scale = *plant.gltf.heightM / std::max(ownHeightM, 1e-9);
    notes.push_back("it stands " + shortNumber(*plant.gltf.heightM) + " m high to suit the template, the file says " +
                    shortNumber(ownHeightM) + " m (" + where + "gltf.heightM)");
  }
  plant.densityPerM2 =
      std::round(std::clamp(kLeafAreaIndex / std::max(scale * scale * measure.leafAreaM2, 1e-6), 4.0, 1500.0));
  notes.push_back(shortNumber(plant.densityPerM2) + " of them a square metre (" + where + "densityPerM2)");
  const double usual = measure.solidShare > 0.5 ? kSolidLuminance : kLeafLuminance;
  if (measure.luminance > 0.0 && measure.luminance < kDarkLuminance) {
    plant.gltf.material.emplace().brightness = rounded(std::min(usual / measure.luminance, 10.0));
    notes.push_back("its colours are dark (mean luminance " + shortNumber(measure.luminance) +
                    ") and were multiplied by " + shortNumber(plant.gltf.material->brightness) + " (" + where +
                    "gltf.material.brightness)");
  }
  if (measure.luminance > kNoColourLuminance) {
    plant.gltf.material.emplace().baseColour = kGrassColour;
    notes.push_back("it brings no colour of its own and is green (" + where + "gltf.material.baseColour)");
  }
  const double slabM = heightM / project.sampling.slices;
  if (scale * measure.partWidthM > 0.5 * slabM && project.sampling.slices < kSlicesOfWideParts) {
    project.sampling.slices = kSlicesOfWideParts;
    notes.push_back("its parts are wide, so that it takes " + std::to_string(kSlicesOfWideParts) +
                    " slices (sampling.slices; fewer draw faster)");
  }
  return plant;
}

/// Puts the mesh in place of the template's grasses, with all their share.
Result<void> useMesh(project::Project& project, const fs::path& mesh, const fs::path& projectFolder,
                     std::vector<std::string>& notes) {
  SWARD_ASSIGN(project::Plant plant, plantFromMesh(mesh, project, projectFolder, notes));
  double share = 0.0;
  for (const project::Plant& p : project.patch.plants) share += p.kind == project::PlantKind::Grass ? p.share : 0.0;
  plant.share = share > 0.0 ? share : 1.0;
  std::erase_if(project.patch.plants, [](const project::Plant& p) { return p.kind == project::PlantKind::Grass; });
  project.patch.plants.insert(project.patch.plants.begin(), std::move(plant));
  return {};
}

int listTemplates(const Program& program) {
  if (program.common.json) {
    print({{"templates", project::templateNames()}});
  } else {
    for (const std::string& name : project::templateNames()) std::cout << name << '\n';
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
