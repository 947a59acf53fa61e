#include "project/nearest.h"
#include "project/presets.h"
#include "project/project.h"

namespace sward::project {
namespace {

/// A preset under a name of its own, with its share of this ground.
Plant planted(std::string_view preset, const char* name, double share) {
  Plant plant = plantFromPreset(preset);
  plant.name = name;
  plant.share = share;
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
  project.patch.plants = {planted("Meadow grass", "tall grass", 0.46), planted("Fescue", "fine grass", 0.40),
                          planted("Seed stems", "seed stems", 0.04),   planted("White clover", "clover", 0.06),
                          planted("Daisy", "daisies", 0.035),          planted("Buttercup", "buttercups", 0.03)};
  project.sun.angles = {285.0, 34.0};
  project.views = views(0.5, 1.3);
  setTheScene(project);
  return project;
}

Project flowers() {
  Project project;
  project.name = "Flowers";
  project.patch.sideM = 1.6;
  // Two species carry the picture and two set accents: as many of each would be confetti.
  project.patch.plants = {planted("Meadow grass", "tall grass", 0.40), planted("Fescue", "fine grass", 0.42),
                          planted("Red clover", "red clover", 0.05),   planted("Daisy", "daisies", 0.055),
                          planted("Buttercup", "buttercups", 0.045),   planted("Cornflower", "cornflowers", 0.022),
                          planted("Poppy", "poppies", 0.020)};
  // Flowers stand above leaves that are light enough to set them off.
  mesh::GrassShape& tall = project.patch.plants[0].grass;
  tall.heightM = 0.35;
  tall.tipColour = {0.225, 0.330, 0.070};
  project.patch.plants[1].grass.heightM = 0.25;
  project.sun.angles = {275.0, 38.0};
  project.views = views(0.5, 1.3);
  setTheScene(project);
  return project;
}

Project dry() {
  Project project;
  project.name = "Dry";
  project.patch.sideM = 1.6;
  project.patch.plants = {planted("Dry grass", "dry grass", 0.64), planted("Fescue", "fine grass", 0.29),
                          planted("Seed stems", "seed stems", 0.07)};
  mesh::GrassShape& fine = project.patch.plants[1].grass;
  fine.rootColour = {0.120, 0.135, 0.045};
  fine.tipColour = {0.360, 0.310, 0.130};
  mesh::GrassShape& stems = project.patch.plants[2].grass;
  stems.tipColour = {0.42, 0.34, 0.17};
  stems.seedHeadColour = {0.46, 0.34, 0.17};
  project.patch.soil.colour = {0.140, 0.105, 0.070};
  project.sun.angles = {290.0, 25.0};
  project.views = views(0.5, 1.3);
  setTheScene(project);
  project.sky.turbidity = 2.6;  // dust
  return project;
}

Project lawn() {
  Project project;
  project.name = "Lawn";
  project.patch.sideM = 1.0;
  project.patch.plants = {planted("Lawn grass", "lawn grass", 0.65), planted("Lawn fescue", "fine fescue", 0.35)};
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
  const char* description;
  Project (*make)();
};
constexpr Template kTemplates[] = {
    {"meadow", "Knee-high grasses with clover, daisies and buttercups", meadow},
    {"flowers", "Early summer: poppies, cornflowers and daisies among fine grass", flowers},
    {"dry", "Late summer: straw with seed heads over pale soil", dry},
    {"lawn", "Mown grass of two kinds", lawn},
    {"empty", "Bare soil, to plant from nothing", empty}};

}  // namespace

std::vector<TemplateInfo> templates() {
  std::vector<TemplateInfo> list;
  for (const Template& entry : kTemplates) list.push_back({entry.name, entry.description});
  return list;
}

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
