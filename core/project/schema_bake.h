#pragma once

#include "project/limits.h"
#include "project/project.h"
#include "project/schema_scene.h"
#include "project/spec.h"

/// The part of the schema that says how plants become relightable tiles; see schema.h.
namespace sward::project {

template <typename A>
void describe(A& a, typename A::template Ref<scene::RingOptions> v) {
  a.field("rings", v.rings, range(1, 16, "rings").soft(1, 6).says("Rings", "Rings of lights, one above the other."));
  a.field("lightsPerRing", v.lightsPerRing,
          range(1, 64, "lights").soft(3, 16).says("Lights per ring", "Lights of each ring, spread evenly round it."));
  a.field("lowestDeg", v.lowestDeg,
          angle(0.0, 90.0).says("Lowest ring", "Elevation of the lowest ring. Lower it if the sun will stand low."));
  a.field("highestDeg", v.highestDeg,
          angle(0.0, 90.0).says("Highest ring", "Elevation of the highest ring; the others stand between."));
  a.field("zenith", v.zenith,
          of(Role::Shape)
              .says("Light above",
                    "One more light straight above. Without it a single ring cannot tell how "
                    "light changes with height."));
}

template <typename A>
void describe(A& a, typename A::template Ref<scene::SunDate> v) {
  a.field("month", v.month, range(1, 12).says("Month", "Month of the date, 1 to 12."));
  a.field("day", v.day, range(1, 31).says("Day", "Day of the month."));
}

template <typename A>
void describe(A& a, typename A::template Ref<scene::SunPathOptions> v) {
  a.field("latitudeDeg", v.latitudeDeg,
          angle(-90.0, 90.0).says("Latitude", "Degrees north of the equator; negative is south."));
  a.field("dates", v.dates,
          range(1, 24, "dates").says("Dates", "Days whose sun is baked. Two or more far apart keep relighting sound."));
  a.field("positions", v.positions,
          range(1, 48, "lights").soft(1, 16).says("Lights per day", "Lights along each day, from morning to evening."));
  a.field("lowestDeg", v.lowestDeg,
          angle(0.0, 60.0).soft(0.0, 30.0).says("Lowest sun", "The sun counts from this elevation on."));
}

template <typename A>
void describe(A& a, typename A::template Ref<scene::LightOptions> v) {
  a.field("pattern", v.pattern,
          of(Role::Shape).says("Pattern", "How the baked light directions are spread over the sky."));
  a.field("count", v.count,
          range(1, kMaxLights, "lights")
              .soft(6, 64)
              .says("Lights",
                    "Directions of the Fibonacci pattern. More relight more truly and trace longer; 15 is usual."));
  a.field("directions", v.directions,
          range(0, kMaxLights, "lights").says("Directions", "The light directions of the pattern that lists them."));
  a.choice("rings", v.rings, v.pattern == scene::LightPattern::Rings,
           of(Role::Shape).says("Rings of lights", "How many rings, and where they stand."));
  a.choice("sunPath", v.sunPath, v.pattern == scene::LightPattern::SunPath,
           of(Role::Shape).says("Path of the sun", "The place and the days."));
}

template <typename A>
void describe(A& a, typename A::template Ref<trace::SamplingOptions> v) {
  a.field("sliceResolution", v.sliceResolution,
          range(8, 2048, "texels")
              .soft(64, 512)
              .steps(16)
              .in("Slices")
              .says("Slice resolution",
                    "Texels along the patch in each level layer. Doubling it shows finer blades "
                    "and traces four times as long."));
  // At most 64, since layer indices are stored as bytes and textures hold one array layer a slab.
  a.field("slices", v.slices,
          range(1, 64, "layers")
              .soft(4, 32)
              .in("Slices")
              .says("Slices", "Level layers over the height of the grass. More show finer depth and parallax."));
  a.field("sliceSubSamples", v.sliceSubSamples,
          range(1, 256, "rays a texel")
              .soft(1, 16)
              .in("Slices")
              .expert()
              .says("Slice rays", "Rays that look for plants in each texel of a slice. Raise it against grain."));
  a.field("bladeWidth", v.bladeWidth,
          range(8, 4096, "texels")
              .soft(64, 1024)
              .steps(16)
              .in("Blades")
              .says("Blade image width", "Texels along the patch in each upright layer; a multiple of the slices'."));
  a.field("bladeHeight", v.bladeHeight,
          range(4, 2048, "texels")
              .soft(16, 256)
              .steps(8)
              .in("Blades")
              .says("Blade image height", "Texels over the height of the grass in each upright layer."));
  a.field("blades", v.blades,
          range(1, 64, "layers")
              .soft(4, 32)
              .in("Blades")
              .says("Blades", "Upright layers along each side of the patch. They carry views across the grass."));
  a.field("bladeSubSamples", v.bladeSubSamples,
          range(1, 256, "rays a texel")
              .soft(1, 16)
              .in("Blades")
              .expert()
              .says("Blade rays", "Rays that look for plants in each texel of an upright layer."));
  a.field("visibilityDirections", v.visibilityDirections,
          range(1, 1024, "directions")
              .soft(4, 64)
              .in("Light")
              .expert()
              .says("Sky directions",
                    "Directions that test how much of the sky a leaf sees. Raise it when shaded "
                    "grass looks blotchy."));
  a.field(
      "seed", v.seed,
      of(Role::Shape).in("Light").expert().says("Seed", "Another number places the rays elsewhere in their texels."));
}

template <typename A>
void describe(A& a, typename A::template Ref<lpt::FitOptions> v) {
  a.field("basis", v.basis, of(Role::Shape).says("Representation", "What is kept of how a texel answers light."));
  a.field(
      "coordinate", v.coordinate,
      of(Role::Shape).expert().says("Layers by", "What tells the layers of a column apart in a layered polynomial."));
  a.field("clusters", v.clusters,
          range(2, 4, "groups")
              .steps(2)
              .expert()
              .says("Groups of layers", "Of clustered LPT: 2 or 4 polynomials for each column."));
  a.field("paper", v.paper,
          of(Role::Shape)
              .expert()
              .says("As in the paper",
                    "Fits without smoothing, as first published. For "
                    "comparisons; pictures get worse."));
  a.field("layerRidge", v.layerRidge,
          range(0.0, 100.0)
              .decades(0.0001, 1.0)
              .in("Smoothing")
              .expert()
              .says("Layer smoothing",
                    "Holds back changes from layer to layer. Raise it when relit grass shows speckles."));
  a.field("lightRidge", v.lightRidge,
          range(0.0, 100.0)
              .decades(0.0001, 1.0)
              .in("Smoothing")
              .expert()
              .says("Light smoothing",
                    "Holds back changes from light to light. Raise it when lights between the baked ones "
                    "look wrong."));
  a.field("bits", v.bits,
          range(8, 16, "bits")
              .steps(8)
              .in("Storage")
              .expert()
              .says("Bits", "Of a stored coefficient, 8 or 16. 16 doubles the memory and avoids banding."));
  a.field("clampQuantile", v.clampQuantile,
          percent(0.0, 0.49).soft(0.0, 0.05).in("Storage").expert().says(
              "Cut extremes",
              "Share of the extreme coefficients that are cut off before storing. A little sharpens "
              "the rest."));
}

template <typename A>
void describe(A& a, typename A::template Ref<tiles::TileOptions> v) {
  a.field("resolution", v.resolution,
          range(8, 512, "texels")
              .soft(32, 256)
              .steps(16)
              .in("Tiles")
              .says("Tile size",
                    "Texels along a tile's side. Larger tiles repeat less and leave fewer of them in a patch."));
  a.field("coloursPerAxis", v.coloursPerAxis,
          range(1, 4, "colours")
              .in("Tiles")
              .says("Edge colours", "Kinds of edges along each axis. More make more tiles that differ."));
  a.field("tilesPerPair", v.tilesPerPair,
          range(1, 16, "tiles")
              .soft(1, 9)
              .in("Tiles")
              .says("Choices", "Tiles to choose from at each place. Two hide most repetition; more cost memory."));
  a.field("overlap", v.overlap,
          range(0, 128, "texels")
              .soft(0, 64)
              .in("Seams")
              .says("Overlap", "Band in which a seam may wander, on each side. Widen it where seams show."));
  a.field("seam", v.seam, of(Role::Shape).in("Seams").says("Seam method", "How the seam of least cost is found."));
  a.field("domain", v.domain,
          of(Role::Shape).in("Seams").expert().says("Seam lights", "The lights under which a seam must not show."));
  a.field("apron", v.apron,
          range(1, 64, "texels")
              .soft(1, 32)
              .in("Seams")
              .expert()
              .says("Apron",
                    "Border kept round a tile for filtering, a power of two. Raise it when tiles' edges show far "
                    "away."));
  // Shaders count the cells in floats, exact up to 2^24.
  a.field("mapWidth", v.mapWidth,
          range(1, 3900, "cells")
              .decades(16, 3900)
              .in("Ground")
              .says("Ground width",
                    "Tiles from west to east before the ground "
                    "repeats."));
  a.field("mapHeight", v.mapHeight,
          range(1, 3900, "cells")
              .decades(16, 3900)
              .in("Ground")
              .says("Ground depth",
                    "Tiles from south to north before the ground "
                    "repeats."));
  a.field("map", v.map, of(Role::Shape).in("Ground").says("Laying", "How tiles are chosen for the ground."));
  a.field("seed", v.seed,
          of(Role::Shape).in("Ground").says("Seed", "Another number cuts other tiles and lays them differently."));
}

}  // namespace sward::project
