#pragma once

#include "project/project.h"
#include "project/spec.h"

/// The part of the schema that says how a baked ground is lit and looked at; see schema.h.
namespace sward::project {

template <typename A>
void describe(A& a, typename A::template Ref<terrain::HillOptions> v) {
  a.field("seed", v.seed, of(Role::Shape).says("Seed", "Another number grows other hills."));
  a.field("amplitudeM", v.amplitudeM,
          range(0.0, 5000.0, "m")
              .decades(0.5, 500.0)
              .says("Height", "From the lowest valley to the highest top. The ground at the origin stays at 0."));
  a.field("featureSizeM", v.featureSizeM,
          range(1.0, 100000.0, "m").decades(10.0, 5000.0).says("Hill size", "Distance between neighbouring hills."));
  a.field("octaves", v.octaves,
          range(1, 7, "octaves").says("Detail", "Sizes of hills, each half as large as the one before."));
  a.field("ruggedness", v.ruggedness,
          percent(0.0, 1.0).says("Ruggedness", "From round downs to sharp ridges with much small relief."));
}

template <typename A>
void describe(A& a, typename A::template Ref<terrain::HeightmapOptions> v) {
  a.field("path", v.path,
          label()
              .file(".png .tif .tiff .exr .asc")
              .says("File", "A PNG, TIFF or EXR (its first channel), or an ESRI ASCII grid, relative to the project."));
  a.field("extentXM", v.extentXM,
          range(0.0, 1e6, "m")
              .soft(0.0, 5000.0)
              .says("Width", "West to east, from the first sample to the last. 0 takes the file's own cell size."));
  a.field(
      "heightLowM", v.heightLowM,
      range(-12000.0, 12000.0, "m").soft(-100.0, 100.0).says("Lowest", "Height of black, in images of 8 or 16 bits."));
  a.field(
      "heightHighM", v.heightHighM,
      range(-12000.0, 12000.0, "m").soft(0.0, 500.0).says("Highest", "Height of white, in images of 8 or 16 bits."));
  a.field("verticalScale", v.verticalScale,
          range(-10000.0, 10000.0, "m")
              .soft(0.0, 5.0)
              .says("Vertical scale", "Metres that a value of 1 stands for, in float images and grids."));
  a.field("smoothM", v.smoothM,
          range(0.0, 1000.0, "m")
              .soft(0.0, 20.0)
              .says("Smoothing", "Radius of a blur. Raise it where 8 bits show as terraces."));
  a.field("position", v.position,
          range(-1e6, 1e6, "m")
              .soft(-2000.0, 2000.0)
              .says("Position", "Where the map's middle lies, east and north; the third is added to all heights."));
}

template <typename A>
void describe(A& a, typename A::template Ref<terrain::TerrainOptions> v) {
  a.field("source", v.source, of(Role::Shape).says("Form", "What the ground is: level, hills, or a map of heights."));
  a.choice("hills", v.hills, v.source == terrain::Source::Hills, of(Role::Shape).says("Hills", "Grown hills."));
  a.choice("heightmap", v.heightmap, v.source == terrain::Source::Heightmap,
           of(Role::Shape).says("Heightmap", "Heights from a file."));
}

template <typename A>
void describe(A& a, typename A::template Ref<scene::SunAngles> v) {
  a.field("azimuthDeg", v.azimuthDeg,
          angle(0.0, 360.0).says("Azimuth", "Compass direction of the light, clockwise from north: 90 is east."));
  a.field(
      "elevationDeg", v.elevationDeg,
      angle(-90.0, 90.0).soft(0.0, 90.0).says("Elevation", "Height over the horizon: 0 is sunset, 90 straight above."));
}

template <typename A>
void describe(A& a, typename A::template Ref<scene::SunMoment> v) {
  a.field("year", v.year, range(1950, 2050).in("Date").says("Year", "Year of the date; it hardly moves the sun."));
  a.field("month", v.month, range(1, 12).in("Date").says("Month", "Month of the date, 1 to 12."));
  a.field("day", v.day, range(1, 31).in("Date").says("Day", "Day of the month."));
  a.field("hourUtc", v.hourUtc,
          range(0.0, 23.999999, "hours")
              .steps(0.25)
              .in("Date")
              .says("Hour (UTC)", "Time of the day at Greenwich, not local time: 13.5 is half past one."));
  a.field("latitudeDeg", v.latitudeDeg,
          angle(-90.0, 90.0).in("Place").says("Latitude", "Degrees north of the equator; negative is south."));
  a.field("longitudeDeg", v.longitudeDeg,
          angle(-180.0, 180.0).in("Place").says("Longitude", "Degrees east of Greenwich; negative is west."));
}

template <typename A>
void describe(A& a, typename A::template Ref<scene::SunOptions> v) {
  a.field("byMoment", v.byMoment,
          of(Role::Shape)
              .says("By date and place",
                    "Puts the sun where it stands at a date, hour and place. Otherwise "
                    "two angles say where."));
  a.choice("angles", v.angles, !v.byMoment, of(Role::Shape).says("Angles", "Where the sun stands."));
  a.choice("moment", v.moment, v.byMoment,
           of(Role::Shape).says("Date and place", "When and from where the sun is seen."));
  a.field("intensity", v.intensity,
          range(0.0, 1000.0)
              .decades(0.1, 10.0)
              .says("Sun strength",
                    "Multiplies the sunlight; 1 is physical. Lower it for an "
                    "overcast look."));
}

template <typename A>
void describe(A& a, typename A::template Ref<scene::SkyOptions> v) {
  a.field("turbidity", v.turbidity,
          range(1.7, 10.0).says("Turbidity", "Haze in the air: 2 is a clear deep blue sky, 10 a milky one."));
  a.field("intensity", v.intensity,
          range(0.0, 1000.0)
              .decades(0.1, 10.0)
              .says("Sky strength",
                    "Multiplies the light of the sky; 1 is physical. Raise it for "
                    "softer shadows."));
  a.field(
      "hazeKm", v.hazeKm,
      range(0.0, 10000.0, "km")
          .decades(0.2, 100.0)
          .says("Haze distance", "How far one sees before haze hides two thirds of the ground. 0 switches haze off."));
}

template <typename A>
void describe(A& a, typename A::template Ref<scene::View> v) {
  a.field("name", v.name, label().says("Name", "What the view is called in lists and after --view."));
  a.field("position", v.position,
          range(-1e6, 1e6, "m")
              .soft(-50.0, 50.0)
              .steps(0.05)
              .says("Position", "Where the camera stands: east, north and up from the patch's middle."));
  a.field("target", v.target,
          range(-1e6, 1e6, "m").soft(-50.0, 50.0).steps(0.05).says("Target", "The point that the camera looks at."));
  a.field("focalLengthMm", v.focalLengthMm,
          range(1.0, 2000.0, "mm")
              .decades(12.0, 200.0)
              .says("Focal length", "Lens for a sensor 36 mm wide: 24 is wide, 50 normal, 135 a telephoto."));
  a.field("exposureEv", v.exposureEv,
          range(-20.0, 20.0, "stops")
              .soft(-4.0, 4.0)
              .steps(0.1)
              .says("Exposure", "Brightens or darkens on top of the automatic exposure; one stop doubles the light."));
}

template <typename A>
void describe(A& a, typename A::template Ref<render::RenderOptions> v) {
  a.field(
      "method", v.method,
      of(Role::Shape).in("Method").says("Method", "How the baked layers are drawn. March is the best and fastest."));
  a.field("bladeAngleDeg", v.bladeAngleDeg,
          angle(1.0, 89.0)
              .soft(10.0, 60.0)
              .in("Method")
              .expert()
              .says("Blade fade angle",
                    "Upright layers fade out where one looks down more steeply than this from "
                    "the vertical."));
  a.field("samples", v.samples,
          range(1, 4096, "samples a pixel")
              .decades(1.0, 64.0)
              .in("Method")
              .says("Samples", "Samples of each pixel of a picture. Raise it when edges of leaves look ragged."));
  a.field("viewTransform", v.viewTransform,
          of(Role::Shape).in("Look").says("View transform", "How light becomes the colours of the picture."));
  a.field("macroVariation", v.macroVariation,
          percent(0.0, 1.0).soft(0.0, 0.5).in("Look").says(
              "Patchiness", "Brighter and darker patches over metres, as meadows have. It hides that tiles repeat."));
  a.field("macroScaleM", v.macroScaleM,
          range(0.01, 100000.0, "m")
              .decades(0.5, 100.0)
              .in("Look")
              .says("Patch size", "Width of the brighter and darker patches."));
  a.field(
      "gridBendM", v.gridBendM,
      range(0.0, 2.0, "m")
          .in("Look")
          .expert()
          .says("Grid bend",
                "Bends the rows of tiles, so that none can be followed to the horizon. Texels are laid in cells that "
                "show other parts of their block instead. 0 turns both off."));
}

template <typename A>
void describe(A& a, typename A::template Ref<report::AccuracyOptions> v) {
  a.field("metric", v.metric,
          of(Role::Shape)
              .says("Metric",
                    "How the error against the ray-traced reference is counted. The commands render and bake then "
                    "pick layers, lights and fit; the window shows the project's own."));
  a.field("bound", v.bound,
          range(0.0, 1000.0)
              .soft(0.0, 1.0)
              .says("Bound", "The largest error (RMSE, FLIP), or the least likeness (PSNR in dB, SSIM)."));
}

template <typename A>
void describe(A& a, typename A::template Ref<Output> v) {
  a.field("width", v.width,
          range(1, 16384, "pixels").soft(320, 4096).says("Width", "Width of the picture that is rendered."));
  a.field("height", v.height,
          range(1, 16384, "pixels").soft(240, 4096).says("Height", "Height of the picture that is rendered."));
}

template <typename A>
void describe(A& a, typename A::template Ref<Sequence> v) {
  a.field("frames", v.frames,
          range(1, 100000, "frames").soft(1, 1000).says("Frames", "How many pictures the sequence has."));
  a.field("framesPerSecond", v.framesPerSecond,
          range(0.01, 1000.0, "frames/s")
              .decades(1.0, 60.0)
              .says("Frame rate", "Pictures shown in a second: how fast the season plays."));
  a.field("season", v.season,
          range(0.0, 1.0)
              .axes("Sequence", "Season")
              .says("Season over frames",
                    "Which moment of the season each frame shows, 0 to 1. It may rest or go back. Without points the "
                    "whole season passes evenly."));
  a.field("hourUtc", v.hourUtc,
          range(0.0, 23.999999, "hours")
              .axes("Sequence", "Hour (UTC)")
              .in("Sun")
              .expert()
              .says("Hour over frames",
                    "Which hour of the day each frame shows, with the sun by date and place. Without points the hour "
                    "stays as the sun has it."));
  a.field("days", v.days,
          range(0, 3660, "days")
              .soft(0, 183)
              .in("Sun")
              .expert()
              .says("Days that pass",
                    "From the first frame to the last, with the sun by date and place: it sinks "
                    "towards winter as the sward withers."));
}

}  // namespace sward::project
