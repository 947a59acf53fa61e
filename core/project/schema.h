#pragma once

#include "project/project.h"

#include <limits>

/// The one description of every field of a project: its name in the file, its range with a unit, and what it decides.
/// Reading, writing, range checks, unknown keys, paths in messages and bake keys are archives that walk it.
///
/// An archive A has `template <class T> using Ref` (T& or const T&) and
///   a.version(n)                  the format's version, first
///   a.field(name, value, spec)    a number, flag, word, text, vector, curve, struct, list of structs, or optional one
///   a.choice(name, value, used)   a struct that another value may switch off; unused ones are kept but not checked
namespace sward::project {

/// What a change of a value invalidates: every hit and shadow, the colours alone, or nothing.
enum class Role { Shape, Colour, Label };

struct Spec {
  double low = -std::numeric_limits<double>::max();  ///< every number must be finite in any case
  double high = std::numeric_limits<double>::max();
  const char* unit = "";
  Role role = Role::Shape;
  const char* label = "";  ///< the field's name for people, such as "Blade height"
  const char* help = "";   ///< what it decides, in a sentence or two: the editor's tooltip

  constexpr Spec says(const char* newLabel, const char* newHelp) const {
    Spec spec = *this;
    spec.label = newLabel;
    spec.help = newHelp;
    return spec;
  }
};
constexpr Spec range(double low, double high, const char* unit = "", Role role = Role::Shape) {
  return {low, high, unit, role};
}
constexpr Spec colour(double high = 1.0) {
  return {0.0, high, "", Role::Colour};
}
constexpr Spec label() {
  Spec spec;
  spec.role = Role::Label;
  return spec;
}

template <typename A>
void describe(A& a, typename A::template Ref<mesh::LeafOptics> v) {
  a.field("translucency", v.translucency, range(0.0, 1.0, "", Role::Colour));
  a.field("transmissionTint", v.transmissionTint, colour(4.0));
}

template <typename A>
void describe(A& a, typename A::template Ref<mesh::MaterialOverride> v) {
  a.field("baseColour", v.baseColour, colour());
  a.field("alphaCutoff", v.alphaCutoff, range(0.001, 0.999));
  a.field("optics", v.optics, colour());
  a.field("brightness", v.brightness, range(0.05, 20.0, "", Role::Colour));
}

template <typename A>
void describe(A& a, typename A::template Ref<mesh::GrassShape> v) {
  a.field("bladesPerPlant", v.bladesPerPlant, range(1, 500, "blades"));
  a.field("segments", v.segments, range(1, 64, "quads"));
  a.field("heightM", v.heightM, range(0.002, 20.0, "m"));
  a.field("heightVariation", v.heightVariation, range(0.0, 0.5));
  a.field("widthM", v.widthM, range(0.0001, 1.0, "m"));
  a.field("profile", v.profile, range(0.0, 1.0));
  a.field("bendDeg", v.bendDeg, range(0.0, 180.0, "degrees"));
  a.field("leanDeg", v.leanDeg, range(0.0, 85.0, "degrees"));
  a.field("twistDeg", v.twistDeg, range(-1080.0, 1080.0, "degrees"));
  a.field("foldDeg", v.foldDeg, range(0.0, 85.0, "degrees"));
  a.field("clumpRadiusM", v.clumpRadiusM, range(0.0, 2.0, "m"));
  a.field("seedHeadShare", v.seedHeadShare, range(0.0, 1.0));
  a.field("rootColour", v.rootColour, colour());
  a.field("tipColour", v.tipColour, colour());
  a.field("seedHeadColour", v.seedHeadColour, colour());
  a.field("colourVariation", v.colourVariation, colour());
  a.field("optics", v.optics, colour());
}

template <typename A>
void describe(A& a, typename A::template Ref<mesh::FlowerShape> v) {
  a.field("heightM", v.heightM, range(0.002, 20.0, "m"));
  a.field("heightVariation", v.heightVariation, range(0.0, 0.5));
  a.field("stemWidthM", v.stemWidthM, range(0.0001, 0.5, "m"));
  a.field("leaves", v.leaves, range(0, 200, "leaves"));
  a.field("leafLengthM", v.leafLengthM, range(0.001, 5.0, "m"));
  a.field("petals", v.petals, range(1, 200, "petals"));
  a.field("petalLengthM", v.petalLengthM, range(0.0005, 1.0, "m"));
  a.field("petalWidthM", v.petalWidthM, range(0.0002, 1.0, "m"));
  a.field("centreRadiusM", v.centreRadiusM, range(0.0002, 1.0, "m"));
  a.field("bendDeg", v.bendDeg, range(0.0, 120.0, "degrees"));
  a.field("petalColour", v.petalColour, colour());
  a.field("centreColour", v.centreColour, colour());
  a.field("leafColour", v.leafColour, colour());
  a.field("colourVariation", v.colourVariation, colour());
  a.field("optics", v.optics, colour());
}

template <typename A>
void describe(A& a, typename A::template Ref<mesh::CloverShape> v) {
  a.field("stems", v.stems, range(1, 500, "stems"));
  a.field("heightM", v.heightM, range(0.002, 20.0, "m"));
  a.field("heightVariation", v.heightVariation, range(0.0, 0.5));
  a.field("leafletLengthM", v.leafletLengthM, range(0.0005, 1.0, "m"));
  a.field("spreadM", v.spreadM, range(0.0, 2.0, "m"));
  a.field("headShare", v.headShare, range(0.0, 1.0));
  a.field("leafColour", v.leafColour, colour());
  a.field("headColour", v.headColour, colour());
  a.field("colourVariation", v.colourVariation, colour());
  a.field("optics", v.optics, colour());
}

template <typename A>
void describe(A& a, typename A::template Ref<mesh::GltfSource> v) {
  a.field("path", v.path, label());
  a.field("heightM", v.heightM, range(0.002, 20.0, "m"));
  a.field("material", v.material);
}

template <typename A>
void describe(A& a, typename A::template Ref<Plant> v) {
  a.field("name", v.name, label());
  a.field("kind", v.kind);
  a.field("densityPerM2", v.densityPerM2, range(0.0, 100000.0, "plants/m2"));
  a.field("share", v.share, range(0.0, 1e6));
  a.field("variants", v.variants, range(1, 64));
  a.field("sizeVariation", v.sizeVariation, range(0.0, 0.45));
  a.field("tiltDeg", v.tiltDeg, range(0.0, 60.0, "degrees"));
  a.field("clumping", v.clumping, range(0.0, 1.0));
  a.choice("grass", v.grass, v.kind == PlantKind::Grass);
  a.choice("flower", v.flower, v.kind == PlantKind::Flower);
  a.choice("clover", v.clover, v.kind == PlantKind::Clover);
  a.choice("gltf", v.gltf, v.kind == PlantKind::Gltf);
}

template <typename A>
void describe(A& a, typename A::template Ref<Soil> v) {
  a.field("colour", v.colour, colour());
  a.field("colourVariation", v.colourVariation, colour());
  a.field("texture", v.texture, label());
}

template <typename A>
void describe(A& a, typename A::template Ref<Patch> v) {
  a.field("sideM", v.sideM, range(0.02, 200.0, "m"));
  a.field("plants", v.plants, range(0, 64, "plants"));
  a.field("soil", v.soil);
  a.field("seed", v.seed);
}

template <typename A>
void describe(A& a, typename A::template Ref<scene::SunAngles> v) {
  a.field("azimuthDeg", v.azimuthDeg, range(0.0, 360.0, "degrees"));
  a.field("elevationDeg", v.elevationDeg, range(-90.0, 90.0, "degrees"));
}

template <typename A>
void describe(A& a, typename A::template Ref<scene::SunMoment> v) {
  a.field("year", v.year, range(1950, 2050));
  a.field("month", v.month, range(1, 12));
  a.field("day", v.day, range(1, 31));
  a.field("hourUtc", v.hourUtc, range(0.0, 23.999999, "hours"));
  a.field("latitudeDeg", v.latitudeDeg, range(-90.0, 90.0, "degrees"));
  a.field("longitudeDeg", v.longitudeDeg, range(-180.0, 180.0, "degrees"));
}

template <typename A>
void describe(A& a, typename A::template Ref<scene::SunOptions> v) {
  a.field("byMoment", v.byMoment);
  a.choice("angles", v.angles, !v.byMoment);
  a.choice("moment", v.moment, v.byMoment);
  a.field("intensity", v.intensity, range(0.0, 1000.0));
}

template <typename A>
void describe(A& a, typename A::template Ref<scene::SkyOptions> v) {
  a.field("turbidity", v.turbidity, range(1.7, 10.0));
  a.field("intensity", v.intensity, range(0.0, 1000.0));
  a.field("hazeKm", v.hazeKm, range(0.0, 10000.0, "km"));
}

template <typename A>
void describe(A& a, typename A::template Ref<scene::View> v) {
  a.field("name", v.name);
  a.field("position", v.position, range(-1e6, 1e6, "m"));
  a.field("target", v.target, range(-1e6, 1e6, "m"));
  a.field("focalLengthMm", v.focalLengthMm, range(1.0, 2000.0, "mm"));
  a.field("exposureEv", v.exposureEv, range(-20.0, 20.0, "stops"));
}

template <typename A>
void describe(A& a, typename A::template Ref<scene::LightOptions> v) {
  a.field("pattern", v.pattern);
  a.field("count", v.count, range(1, 1024, "lights"));
  a.field("directions", v.directions, range(0, 1024, "lights"));
}

template <typename A>
void describe(A& a, typename A::template Ref<trace::SamplingOptions> v) {
  a.field("sliceResolution", v.sliceResolution, range(8, 2048, "texels"));
  // At most 64, since layer indices are stored as bytes and textures hold one array layer a slab.
  a.field("slices", v.slices, range(1, 64, "layers"));
  a.field("bladeWidth", v.bladeWidth, range(8, 4096, "texels"));
  a.field("bladeHeight", v.bladeHeight, range(4, 2048, "texels"));
  a.field("blades", v.blades, range(1, 64, "layers"));
  a.field("sliceSubSamples", v.sliceSubSamples, range(1, 256, "rays a texel"));
  a.field("bladeSubSamples", v.bladeSubSamples, range(1, 256, "rays a texel"));
  a.field("visibilityDirections", v.visibilityDirections, range(1, 1024, "directions"));
  a.field("seed", v.seed);
}

template <typename A>
void describe(A& a, typename A::template Ref<lpt::FitOptions> v) {
  a.field("basis", v.basis);
  a.field("paper", v.paper);
  a.field("layerRidge", v.layerRidge, range(0.0, 100.0));
  a.field("lightRidge", v.lightRidge, range(0.0, 100.0));
  a.field("bits", v.bits, range(8, 16, "bits"));
  a.field("clampQuantile", v.clampQuantile, range(0.0, 0.49));
}

template <typename A>
void describe(A& a, typename A::template Ref<tiles::TileOptions> v) {
  a.field("resolution", v.resolution, range(8, 512, "texels"));
  a.field("coloursPerAxis", v.coloursPerAxis, range(1, 4, "colours"));
  a.field("tilesPerPair", v.tilesPerPair, range(1, 16, "tiles"));
  a.field("overlap", v.overlap, range(0, 128, "texels"));
  a.field("apron", v.apron, range(1, 64, "texels"));
  a.field("seam", v.seam);
  a.field("domain", v.domain);
  // Shaders count the cells in floats, exact up to 2^24.
  a.field("mapWidth", v.mapWidth, range(1, 3900, "cells"));
  a.field("mapHeight", v.mapHeight, range(1, 3900, "cells"));
  a.field("map", v.map);
  a.field("seed", v.seed);
}

template <typename A>
void describe(A& a, typename A::template Ref<render::RenderOptions> v) {
  a.field("method", v.method);
  a.field("viewTransform", v.viewTransform);
  a.field("bladeAngleDeg", v.bladeAngleDeg, range(1.0, 89.0, "degrees"));
  a.field("samples", v.samples, range(1, 4096, "samples a pixel"));
  a.field("macroVariation", v.macroVariation, range(0.0, 1.0));
  a.field("macroScaleM", v.macroScaleM, range(0.01, 100000.0, "m"));
  a.field("gridBendM", v.gridBendM, range(0.0, 2.0, "m"));
}

template <typename A>
void describe(A& a, typename A::template Ref<Output> v) {
  a.field("width", v.width, range(1, 16384, "pixels"));
  a.field("height", v.height, range(1, 16384, "pixels"));
}

template <typename A>
void describe(A& a, typename A::template Ref<Project> v) {
  a.version(kFormatVersion);
  a.field("name", v.name, label());
  a.field("patch", v.patch);
  a.field("lights", v.lights);
  a.field("sampling", v.sampling);
  a.field("fit", v.fit);
  a.field("tiles", v.tiles);
  a.field("sun", v.sun);
  a.field("sky", v.sky);
  a.field("render", v.render);
  a.field("views", v.views, range(0, 1000, "views"));
  a.field("output", v.output);
}

}  // namespace sward::project
