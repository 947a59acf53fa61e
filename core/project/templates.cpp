#include "project/project.h"

#include "project/nearest.h"

namespace sward::project {
namespace {

Plant grass(const std::string& name, double share, double densityPerM2) {
  Plant plant;
  plant.name = name;
  plant.kind = PlantKind::Grass;
  plant.share = share;
  plant.densityPerM2 = densityPerM2;
  return plant;
}

Plant tallGrass() {
  Plant plant = grass("tall grass", 0.45, 420.0);
  plant.grass.heightM = 0.46;
  plant.grass.heightVariation = 0.20;
  plant.grass.bladesPerPlant = 9;
  plant.grass.bendDeg = 55.0;
  plant.clumping = 0.25;
  return plant;
}

Plant fineGrass() {
  Plant plant = grass("fine grass", 0.41, 800.0);
  plant.grass.heightM = 0.26;
  plant.grass.heightVariation = 0.25;
  plant.grass.widthM = 0.0035;
  plant.grass.bladesPerPlant = 10;
  plant.grass.bendDeg = 70.0;
  plant.grass.rootColour = {0.055, 0.080, 0.024};
  plant.grass.tipColour = {0.185, 0.240, 0.075};
  plant.clumping = 0.15;
  return plant;
}

Plant seedStems() {
  Plant plant = grass("seed stems", 0.04, 260.0);
  plant.grass.heightM = 0.58;
  plant.grass.heightVariation = 0.12;
  plant.grass.widthM = 0.0025;
  plant.grass.bladesPerPlant = 3;
  plant.grass.bendDeg = 18.0;
  plant.grass.leanDeg = 6.0;
  plant.grass.seedHeadShare = 0.8;
  plant.grass.rootColour = {0.11, 0.13, 0.045};
  plant.grass.tipColour = {0.27, 0.25, 0.11};
  plant.clumping = 0.5;
  return plant;
}

Plant daisies() {
  Plant plant;
  plant.name = "daisies";
  plant.kind = PlantKind::Flower;
  plant.share = 0.02;
  plant.densityPerM2 = 300.0;
  plant.clumping = 0.6;
  plant.flower.heightM = 0.36;
  plant.flower.petals = 18;
  plant.flower.petalLengthM = 0.016;
  return plant;
}

Plant buttercups() {
  Plant plant = daisies();
  plant.name = "buttercups";
  plant.flower.heightM = 0.40;
  plant.flower.petals = 5;
  plant.flower.petalLengthM = 0.012;
  plant.flower.petalWidthM = 0.011;
  plant.flower.centreRadiusM = 0.004;
  plant.flower.petalColour = {0.86, 0.62, 0.02};
  plant.flower.centreColour = {0.60, 0.48, 0.03};
  return plant;
}

Plant clover(double share, double densityPerM2, double heightM) {
  Plant plant;
  plant.name = "clover";
  plant.kind = PlantKind::Clover;
  plant.share = share;
  plant.densityPerM2 = densityPerM2;
  plant.clumping = 0.5;
  plant.clover.heightM = heightM;
  return plant;
}

std::vector<scene::View> views(double grassM) {
  const scene::View eyeHeight{"main", {0.0, -5.0, 1.65}, {0.0, 6.0, 0.55}, 35.0, 0.0};
  const scene::View down{"top", {0.0, 0.0, 6.0}, {0.0, 0.0, 0.0}, 35.0, 0.0};
  const scene::View low{"low", {0.0, -1.6, grassM + 0.22}, {0.0, 1.4, 0.5 * grassM}, 35.0, 0.0};
  return {eyeHeight, down, low};
}

Project meadow() {
  Project project;
  project.name = "Meadow";
  project.patch.sideM = 1.2;
  project.patch.plants = {tallGrass(), fineGrass(), seedStems(), clover(0.06, 240.0, 0.14), daisies(), buttercups()};
  project.sun.angles = {235.0, 32.0};
  project.views = views(0.62);
  return project;
}

Project lawn() {
  Project project;
  project.name = "Lawn";
  project.patch.sideM = 0.8;
  Plant blades = grass("lawn grass", 0.95, 2600.0);
  blades.grass.heightM = 0.055;
  blades.grass.heightVariation = 0.15;
  blades.grass.widthM = 0.0028;
  blades.grass.bladesPerPlant = 7;
  blades.grass.segments = 4;
  blades.grass.bendDeg = 35.0;
  blades.grass.leanDeg = 18.0;
  blades.grass.clumpRadiusM = 0.012;
  project.patch.plants = {blades, clover(0.05, 500.0, 0.045)};
  project.sun.angles = {140.0, 40.0};
  project.views = views(0.06);
  return project;
}

Project empty() {
  Project project;
  project.name = "Empty";
  project.views = views(0.0);
  return project;
}

struct Template {
  const char* name;
  Project (*make)();
};
constexpr Template kTemplates[] = {{"meadow", meadow}, {"lawn", lawn}, {"empty", empty}};

}  // namespace

std::vector<std::string> templateNames() {
  std::vector<std::string> names;
  for (const Template& entry : kTemplates) names.emplace_back(entry.name);
  return names;
}

Result<Project> fromTemplate(const std::string& name) {
  std::string all;
  for (const Template& entry : kTemplates) {
    if (name == entry.name) return entry.make();
    all += (all.empty() ? "" : ", ") + std::string(entry.name);
  }
  const std::string nearest = nearestName(name, templateNames());
  return Error::badInput("there is no template \"" + name + "\"", "",
                         (nearest.empty() ? "" : "Did you mean \"" + nearest + "\"? ") + ("Templates: " + all + "."));
}

}  // namespace sward::project
