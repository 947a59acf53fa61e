#pragma once

#include "project/project.h"

namespace sward::bake::test {

/// A whole ground that bakes in a fraction of a second: 32 x 32 x 4 slices, 6 lights, tiles of 8 texels.
inline project::Project smallProject() {
  project::Project project;
  project.patch.sideM = 0.4;
  project::Plant grass;
  grass.densityPerM2 = 300;
  grass.share = 0.8;
  grass.variants = 2;
  grass.grass.segments = 3;
  grass.grass.heightM = 0.2;
  grass.grass.widthM = 0.012;
  project::Plant flower;
  flower.name = "flower";
  flower.kind = project::PlantKind::Flower;
  flower.densityPerM2 = 40;
  flower.share = 0.2;
  flower.variants = 1;
  project.patch.plants = {grass, flower};
  project.lights.pattern = scene::LightPattern::List;
  project.lights.directions = {{0, 90}, {0, 35}, {72, 25}, {144, 35}, {216, 25}, {288, 35}};
  project.sampling.sliceResolution = 32;
  project.sampling.slices = 4;
  project.sampling.bladeWidth = 32;
  project.sampling.bladeHeight = 16;
  project.sampling.blades = 8;
  project.sampling.visibilityDirections = 4;
  project.tiles.resolution = 16;
  project.tiles.overlap = 3;
  project.tiles.apron = 2;
  project.tiles.mapWidth = 20;
  project.tiles.mapHeight = 10;
  project.views.push_back({});
  return project;
}

}  // namespace sward::bake::test
