#include "project/presets.h"

#include <algorithm>
#include <cctype>

namespace sward::project {
namespace {

Plant grass(double share, double densityPerM2) {
  Plant plant;
  plant.kind = PlantKind::Grass;
  plant.share = share;
  plant.densityPerM2 = densityPerM2;
  plant.grass.segments = 5;
  plant.grass.foldDeg = 0.0;  // a crease is finer than a texel, and doubles the triangles
  return plant;
}

base::Curve curve(std::vector<base::CurvePoint> points) {
  return base::Curve::fromPoints(std::move(points)).value();
}

// Plants of a meadow are even and many: what stands out on one tile is seen again on every tile that shares its edge.
// The tallest are not much taller than the rest: rays would cross a high shell of almost nothing.

Plant lawnGrass() {
  Plant plant = grass(0.65, 2600.0);
  plant.grass.heightM = 0.055;
  plant.grass.heightVariation = 0.15;
  plant.grass.widthM = 0.0032;
  plant.grass.bladesPerPlant = 7;
  plant.grass.segments = 4;
  plant.grass.bendDeg = 45.0;
  plant.grass.leanDeg = 18.0;
  plant.grass.clumpRadiusM = 0.014;
  plant.grass.rootColour = {0.080, 0.115, 0.032};
  plant.grass.tipColour = {0.150, 0.250, 0.050};
  plant.grass.colourVariation = 0.10;
  return plant;
}

Plant lawnFescue() {
  Plant plant = lawnGrass();
  plant.share = 0.35;
  plant.densityPerM2 = 3200.0;
  plant.grass.heightM = 0.05;
  plant.grass.widthM = 0.0022;
  plant.grass.bendDeg = 65.0;
  plant.grass.tipColour = {0.165, 0.240, 0.065};
  return plant;
}

Plant fescue() {
  Plant plant = grass(0.40, 1200.0);
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

Plant meadowGrass() {
  Plant plant = grass(0.46, 700.0);
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

Plant seedStems() {
  Plant plant = grass(0.04, 500.0);
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

/// Straw from the tips down: the green is left near the ground, where it stays moist.
Plant dryGrass() {
  Plant plant = grass(0.55, 650.0);
  plant.grass.heightM = 0.40;
  // An under-layer of short leaves below the tall ones.
  plant.grass.heightDistribution = curve({{0.2, 0.0}, {0.45, 0.45}, {0.7, 0.3}, {1.0, 1.0}, {1.25, 0.0}});
  plant.grass.widthM = 0.0045;
  plant.grass.bladesPerPlant = 11;
  plant.grass.bendDeg = 70.0;
  plant.grass.leanDeg = 15.0;
  plant.grass.rootColour = {0.100, 0.125, 0.034};
  plant.grass.tipColour = {0.420, 0.330, 0.150};
  plant.grass.colourAlong = curve({{0.0, 0.0}, {0.15, 0.12}, {0.45, 0.75}, {1.0, 1.0}});
  plant.grass.colourVariation = 0.12;
  plant.grass.optics.translucency = 0.4;
  plant.grass.optics.transmissionTint = {1.1, 1.0, 0.6};
  plant.sizeVariation = 0.10;
  return plant;
}

Plant oatGrass() {
  Plant plant = grass(0.25, 260.0);
  plant.grass.heightM = 0.62;
  plant.grass.heightVariation = 0.12;
  plant.grass.widthM = 0.006;
  plant.grass.bladesPerPlant = 8;
  plant.grass.segments = 7;
  plant.grass.bendDeg = 68.0;
  plant.grass.leanDeg = 12.0;
  plant.grass.clumpRadiusM = 0.035;
  plant.grass.seedHeadShare = 0.25;
  plant.grass.rootColour = {0.090, 0.125, 0.035};
  plant.grass.tipColour = {0.235, 0.310, 0.085};
  plant.grass.seedHeadColour = {0.42, 0.34, 0.17};
  plant.grass.colourVariation = 0.10;
  plant.sizeVariation = 0.10;
  return plant;
}

Plant sedge() {
  Plant plant = grass(0.30, 90.0);
  plant.grass.heightM = 0.55;
  plant.grass.heightDistribution = curve({{0.3, 0.0}, {0.55, 0.25}, {0.95, 1.0}, {1.2, 0.0}});
  plant.grass.widthM = 0.009;
  plant.grass.bladesPerPlant = 26;
  plant.grass.segments = 7;
  // Sedges keep their width far up and end in a short point.
  plant.grass.profile = curve({{0.0, 0.85}, {0.3, 1.0}, {0.75, 0.8}, {0.92, 0.4}, {1.0, 0.0}});
  plant.grass.bendDeg = 55.0;
  plant.grass.leanDeg = 20.0;
  plant.grass.twistDeg = 15.0;
  plant.grass.clumpRadiusM = 0.06;
  plant.grass.rootColour = {0.070, 0.100, 0.040};
  plant.grass.tipColour = {0.130, 0.215, 0.075};
  plant.grass.colourVariation = 0.08;
  plant.grass.optics.translucency = 0.4;
  plant.sizeVariation = 0.12;
  return plant;
}

Plant daisy() {
  Plant plant;
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

Plant buttercup() {
  Plant plant = daisy();
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

Plant cornflower() {
  Plant plant = daisy();
  plant.share = 0.03;
  plant.densityPerM2 = 1100.0;
  plant.flower.heightM = 0.42;
  plant.flower.petals = 24;
  plant.flower.petalLengthM = 0.012;
  plant.flower.petalWidthM = 0.006;
  plant.flower.centreRadiusM = 0.004;
  plant.flower.petalColour = {0.075, 0.115, 0.62};
  plant.flower.centreColour = {0.16, 0.05, 0.32};
  plant.flower.leafColour = {0.13, 0.19, 0.09};
  return plant;
}

Plant poppy() {
  Plant plant = daisy();
  plant.share = 0.03;
  plant.densityPerM2 = 900.0;
  plant.flower.heightM = 0.44;
  plant.flower.bendDeg = 22.0;
  plant.flower.petals = 6;
  plant.flower.petalLengthM = 0.017;
  plant.flower.petalWidthM = 0.020;
  plant.flower.centreRadiusM = 0.004;
  plant.flower.petalColour = {0.62, 0.045, 0.020};
  plant.flower.centreColour = {0.03, 0.03, 0.025};
  plant.flower.leafColour = {0.12, 0.19, 0.07};
  plant.flower.optics.translucency = 0.5;
  return plant;
}

Plant whiteClover() {
  Plant plant;
  plant.kind = PlantKind::Clover;
  plant.share = 0.06;
  plant.densityPerM2 = 300.0;
  plant.clover.heightM = 0.14;
  return plant;
}

Plant redClover() {
  Plant plant = whiteClover();
  plant.densityPerM2 = 220.0;
  plant.clover.heightM = 0.24;
  plant.clover.leafletLengthM = 0.022;
  plant.clover.headShare = 0.22;
  plant.clover.leafColour = {0.080, 0.165, 0.045};
  plant.clover.headColour = {0.50, 0.14, 0.30};
  return plant;
}

struct Entry {
  const char* name;
  const char* description;
  Plant (*make)();
};
constexpr Entry kEntries[] = {
    {"Lawn grass", "Short, mown blades that cover the ground.", lawnGrass},
    {"Lawn fescue", "Finer and softer blades to mix into a lawn.", lawnFescue},
    {"Fescue", "Fine, knee-high tufts that hang over; the filler of a meadow.", fescue},
    {"Meadow grass", "Broad, fresh green leaves; the body of a meadow.", meadowGrass},
    {"Seed stems", "A few upright stems with small seed heads, to sprinkle among leaves.", seedStems},
    {"Dry grass", "Late summer: straw from the tips down, green near the ground.", dryGrass},
    {"Oat grass", "Tall and loose, with many hanging seed heads.", oatGrass},
    {"Sedge", "Dense tussocks of stiff dark leaves, for wet ground.", sedge},
    {"Daisy", "White petals round a yellow disc.", daisy},
    {"Buttercup", "Five glossy yellow petals on a thin stem.", buttercup},
    {"Cornflower", "Deep blue heads with many petals.", cornflower},
    {"Poppy", "Large red petals that glow against the light.", poppy},
    {"White clover", "Low leaves of three with pale heads; covers the soil between grasses.", whiteClover},
    {"Red clover", "Taller leaves of three with pink heads.", redClover}};

std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace

const std::vector<PlantPreset>& plantPresets() {
  static const std::vector<PlantPreset> presets = [] {
    std::vector<PlantPreset> list;
    for (const Entry& entry : kEntries) {
      list.push_back({entry.name, entry.description, entry.make()});
      list.back().plant.name = lowerCase(entry.name);
    }
    return list;
  }();
  return presets;
}

Plant plantFromPreset(std::string_view name) {
  const auto& presets = plantPresets();
  const auto found =
      std::find_if(presets.begin(), presets.end(), [&](const PlantPreset& preset) { return preset.name == name; });
  return found == presets.end() ? Plant{} : found->plant;
}

}  // namespace sward::project
