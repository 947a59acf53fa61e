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
  plant.grass.segments = 5;
  plant.grass.foldDeg = 0.0;  // a crease is finer than a texel, and doubles the triangles
  return plant;
}

// Plants of a meadow are even and many: what stands out on one tile is seen again on every tile that shares its edge.
// The tallest are not much taller than the rest: rays would cross a high shell of almost nothing.

Plant tallGrass() {
  Plant plant = grass("tall grass", 0.46, 700.0);
  plant.grass.heightM = 0.42;
  plant.grass.heightVariation = 0.15;
  plant.grass.widthM = 0.0055;
  plant.grass.bendDeg = 60.0;
  plant.grass.leanDeg = 14.0;
  plant.grass.rootColour = {0.085, 0.120, 0.030};
  plant.grass.tipColour = {0.200, 0.300, 0.060};
  plant.grass.colourVariation = 0.10;
  plant.sizeVariation = 0.10;
  return plant;
}

Plant fineGrass() {
  Plant plant = grass("fine grass", 0.40, 1200.0);
  plant.grass.heightM = 0.27;
  plant.grass.heightVariation = 0.15;
  plant.grass.widthM = 0.004;
  plant.grass.bladesPerPlant = 10;
  plant.grass.bendDeg = 75.0;
  plant.grass.leanDeg = 16.0;
  plant.grass.rootColour = {0.080, 0.115, 0.035};
  plant.grass.tipColour = {0.250, 0.320, 0.100};
  plant.grass.colourVariation = 0.10;
  plant.sizeVariation = 0.10;
  return plant;
}

Plant seedStems() {
  Plant plant = grass("seed stems", 0.04, 500.0);
  plant.grass.heightM = 0.37;
  plant.grass.heightVariation = 0.10;
  plant.grass.widthM = 0.004;
  plant.grass.bladesPerPlant = 2;
  plant.grass.bendDeg = 22.0;
  plant.grass.leanDeg = 6.0;
  plant.grass.seedHeadShare = 0.8;
  plant.grass.rootColour = {0.14, 0.18, 0.06};
  plant.grass.tipColour = {0.30, 0.31, 0.14};
  plant.grass.seedHeadColour = {0.33, 0.32, 0.16};
  plant.grass.colourVariation = 0.08;
  plant.sizeVariation = 0.08;
  return plant;
}

Plant daisies() {
  Plant plant;
  plant.name = "daisies";
  plant.kind = PlantKind::Flower;
  plant.share = 0.035;
  plant.densityPerM2 = 1500.0;
  plant.sizeVariation = 0.12;
  plant.flower.heightM = 0.34;
  plant.flower.heightVariation = 0.15;
  plant.flower.petals = 18;
  plant.flower.petalLengthM = 0.0085;
  plant.flower.petalWidthM = 0.004;
  plant.flower.centreRadiusM = 0.0035;
  plant.flower.petalColour = {0.70, 0.70, 0.66};
  plant.flower.leafColour = {0.13, 0.22, 0.05};
  plant.flower.optics.translucency = 0.2;
  return plant;
}

Plant buttercups() {
  Plant plant = daisies();
  plant.name = "buttercups";
  plant.share = 0.03;
  plant.flower.heightM = 0.38;
  plant.flower.petals = 5;
  plant.flower.petalLengthM = 0.009;
  plant.flower.petalWidthM = 0.009;
  plant.flower.centreRadiusM = 0.003;
  plant.flower.petalColour = {0.75, 0.56, 0.03};
  plant.flower.centreColour = {0.60, 0.48, 0.03};
  return plant;
}

Plant clover(double share, double densityPerM2, double heightM) {
  Plant plant;
  plant.name = "clover";
  plant.kind = PlantKind::Clover;
  plant.share = share;
  plant.densityPerM2 = densityPerM2;
  plant.clover.heightM = heightM;
  return plant;
}

/// Heads 30 degrees east of north: along the tiles' axes a small set shows its rows most.
std::vector<scene::View> views(double grassM, double eyeM) {
  constexpr double kEv = 0.3, kEvDown = 0.7;  // from above one sees more shade, and no sky to keep
  const scene::View eyeHeight{"main", {-3.0, -5.196, eyeM}, {0.0, 0.0, 0.55 * eyeM + 0.1}, 35.0, kEv};
  const scene::View down{"top", {0.0, 0.0, 5.0}, {0.0, 0.0, 0.0}, 35.0, kEvDown};
  const scene::View slanted{"slanted", {-1.1, -1.905, grassM + 1.8}, {0.0, 0.0, 0.3 * grassM}, 35.0, kEvDown};
  const scene::View low{"low", {-0.8, -1.386, grassM + 0.25}, {0.6, 1.039, 0.6 * grassM}, 28.0, kEv};
  return {eyeHeight, down, slanted, low};
}

/// What all samples share: a clear sky with some haze, so that the far meadow softens.
void setTheScene(Project& project) {
  project.sampling.blades = 16;
  project.sampling.bladeHeight = 96;
  project.sampling.visibilityDirections = 8;
  project.sky.turbidity = 2.2;
  project.sky.hazeKm = 1.5;
  project.render.macroVariation = 0.20;
  project.render.macroScaleM = 5.0;
}

Project meadow() {
  Project project;
  project.name = "Meadow";
  project.patch.sideM = 1.6;
  project.patch.plants = {tallGrass(), fineGrass(), seedStems(), clover(0.06, 300.0, 0.14), daisies(), buttercups()};
  project.sun.angles = {285.0, 34.0};
  project.views = views(0.5, 1.3);
  setTheScene(project);
  return project;
}

Project lawn() {
  Project project;
  project.name = "Lawn";
  project.patch.sideM = 1.0;
  Plant blades = grass("lawn grass", 0.65, 2600.0);
  blades.grass.heightM = 0.055;
  blades.grass.heightVariation = 0.15;
  blades.grass.widthM = 0.0032;
  blades.grass.bladesPerPlant = 7;
  blades.grass.segments = 4;
  blades.grass.bendDeg = 45.0;
  blades.grass.leanDeg = 18.0;
  blades.grass.clumpRadiusM = 0.014;
  blades.grass.rootColour = {0.080, 0.115, 0.032};
  blades.grass.tipColour = {0.150, 0.250, 0.050};
  blades.grass.colourVariation = 0.10;
  Plant fescue = blades;
  fescue.name = "fine fescue";
  fescue.share = 0.35;
  fescue.densityPerM2 = 3200.0;
  fescue.grass.heightM = 0.05;
  fescue.grass.widthM = 0.0022;
  fescue.grass.bendDeg = 65.0;
  fescue.grass.tipColour = {0.165, 0.240, 0.065};
  project.patch.plants = {blades, fescue};
  project.sun.angles = {285.0, 38.0};
  project.views = views(0.06, 1.1);
  setTheScene(project);
  return project;
}

Project empty() {
  Project project;
  project.name = "Empty";
  project.views = views(0.0, 1.3);
  setTheScene(project);
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
