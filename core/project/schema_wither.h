#pragma once

#include "project/project.h"
#include "project/spec.h"

/// The part of the schema that says how the sward ages; see schema.h.
namespace sward::project {

template <typename A>
void describe(A& a, typename A::template Ref<leaf::LeafOptions> v) {
  a.field("model", v.model, of(Role::Colour).says("Leaf model", "How a leaf's colour follows from its pigments."));
  a.field("chlorophyll", v.chlorophyll,
          range(0.0, 1000.0, "\u00b5g/cm\u00b2")
              .soft(5.0, 80.0)
              .in("Fresh leaf")
              .says("Chlorophyll", "Of a fresh leaf. More is a darker, deeper green."));
  a.field("carotenoid", v.carotenoid,
          range(0.0, 1000.0, "\u00b5g/cm\u00b2")
              .soft(0.0, 20.0)
              .in("Fresh leaf")
              .says("Carotenoid", "The yellow that shows once the green has gone."));
  a.field("waterCm", v.waterCm,
          range(0.0, 10.0, "cm")
              .soft(0.002, 0.05)
              .in("Fresh leaf")
              .expert()
              .says("Water", "Thickness of the water in a fresh leaf."));
  a.field("dryMatter", v.dryMatter,
          range(0.0, 1.0, "g/cm\u00b2")
              .soft(0.001, 0.02)
              .in("Fresh leaf")
              .expert()
              .says("Dry matter", "Of a leaf, fresh or dry. More is darker straw."));
  a.field("structure", v.structure,
          range(1.0, 100.0, "plates")
              .soft(1.0, 3.0)
              .in("Fresh leaf")
              .expert()
              .says("Structure", "Plates that the leaf scatters like: more is paler and lets less light through."));
  a.field("brownWhenDry", v.brownWhenDry,
          range(0.0, 100.0)
              .soft(0.0, 2.0)
              .in("Dry leaf")
              .says("Brown when dry", "Brown pigment without water: raise it for brown rather than golden straw."));
  a.field("carotenoidWhenDry", v.carotenoidWhenDry,
          range(0.0, 1000.0, "\u00b5g/cm\u00b2")
              .soft(0.0, 20.0)
              .in("Dry leaf")
              .says("Yellow when dry", "Carotenoid without water; as much as the fresh leaf's gives orange straw."));
  a.field("structureWhenDry", v.structureWhenDry,
          range(1.0, 100.0, "plates")
              .soft(1.0, 5.0)
              .in("Dry leaf")
              .expert()
              .says("Structure when dry", "Air between dry cell walls makes straw bright."));
  a.field("surfaceShare", v.surfaceShare,
          percent(0.0, 1.0).in("Surface").expert().says(
              "Surface light", "Part of the colourless light from the leaf's surface that its colour holds."));
  a.field("subtractionLevel", v.subtractionLevel,
          range(0.0, 1.0)
              .in("Subtraction")
              .expert()
              .says("Bare reflectance", "Of a leaf without pigments, in the subtraction model."));
  a.field("subtractionStrength", v.subtractionStrength,
          range(0.0, 1000.0)
              .soft(0.0, 5.0)
              .in("Subtraction")
              .expert()
              .says("Pigment strength", "What a fresh leaf's pigments take away, in the subtraction model."));
  a.field("subtractionTransmission", v.subtractionTransmission,
          range(0.0, 1.0)
              .in("Subtraction")
              .expert()
              .says("Light through", "Transmittance over reflectance, which the subtraction model does not give."));
}

template <typename A>
void describe(A& a, typename A::template Ref<wither::AgeingOptions> v) {
  a.field("autumn", v.autumn,
          of(Role::Shape).in("Autumn").says("Autumn", "Which course water and chlorophyll take over the season."));
  a.field("water", v.water,
          range(0.0, 1.0)
              .axes("Season", "Water")
              .in("Autumn")
              .says("Water",
                    "Share of their water that leaves keep over the season, for an autumn of your own. Dry blades "
                    "shrink and fall. Without points it is the normal autumn's."));
  a.field("chlorophyll", v.chlorophyll,
          range(0.0, 1.0, "", Role::Colour)
              .axes("Season", "Chlorophyll")
              .in("Autumn")
              .says("Chlorophyll",
                    "Share of their green that leaves keep over the season, for an autumn of your own. Without points "
                    "it is the normal autumn's."));
  a.field("weathering", v.weathering,
          range(0.0, 1.0)
              .axes("Season", "Weathering")
              .in("Autumn")
              .says("Weathering over time",
                    "The weathering degree over the season; it may rest but never fall. Without points both run "
                    "together."));
  a.field("tipLead", v.tipLead,
          percent(0.0, 1.0, Role::Colour)
              .soft(0.0, 0.6)
              .in("Blades")
              .says("Tips first",
                    "How much of the season a blade's tip is ahead of its root: green lingers at the roots."));
  a.field("variation", v.variation,
          percent(0.0, 0.5).in("Blades").says(
              "Blades differ", "How much of the season blades start earlier or later than one another."));
}

template <typename A>
void describe(A& a, typename A::template Ref<wither::BodyOptions> v) {
  a.field("droopDeg", v.droopDeg,
          angle(0.0, 170.0)
              .in("Falling")
              .says("Droop", "How far the tip of a dry blade has turned over. 0 lets dry blades stand."));
  a.field("droopVariation", v.droopVariation,
          percent(0.0, 1.0).in("Falling").says("Droop variation", "How much blades differ in it."));
  a.field("response", v.response,
          range(0.001, 1.0, "seasons")
              .decades(0.005, 0.5)
              .in("Falling")
              .expert()
              .says("Response", "How long a blade takes to follow the water that it has lost."));
  a.field(
      "shrinkMesophyll", v.shrinkMesophyll,
      percent(0.0, 0.95)
          .in("Shrinking")
          .says("Flesh shrinks", "Volume that the flesh of a blade loses with all its water: dry blades are thin."));
  a.field("shrinkVein", v.shrinkVein,
          percent(0.0, 0.9)
              .in("Shrinking")
              .says("Vein shrinks", "The same of the vein, at most the flesh's: dry blades are a little shorter."));
  a.field("stiffening", v.stiffening,
          range(1.0, 100.0)
              .decades(1.0, 20.0)
              .in("Shrinking")
              .expert()
              .says("Stiffening", "How much stiffer blades are at the season's end, which slows their shrinking."));
}

template <typename A>
void describe(A& a, typename A::template Ref<wither::TexelOptions> v) {
  a.field("resolution", v.resolution,
          range(8, 512, "voxels")
              .soft(32, 256)
              .steps(8)
              .says("Texel resolution",
                    "Voxels along each side of the block that stands for the sward, a multiple of 8. Twice as many "
                    "show finer blades."));
  a.field("proportion", v.proportion,
          range(0.1, 100.0, "points")
              .decades(0.5, 50.0)
              .says("Points a voxel",
                    "Points that stand for a full voxel while the sward ages. More is truer and slower."));
  a.field("splatVoxels", v.splatVoxels,
          range(0.2, 2.0, "voxels")
              .soft(0.3, 1.2)
              .expert()
              .says("Point size", "Spread of a point when it becomes voxels again; larger is smoother."));
}

template <typename A>
void describe(A& a, typename A::template Ref<wither::MingleSample> v) {
  a.field("name", v.name, label().says("Name", "What the sample is called in lists."));
  a.field("share", v.share,
          range(0.0, 1000.0)
              .soft(0.0, 1.0)
              .steps(0.05)
              .says("Share", "How many of the blades belong to it, against the other samples."));
  a.field("density", v.density,
          range(0.0, 10.0).soft(0.0, 2.0).steps(0.05).says(
              "Density", "Times as many blades as its share gives: below 1 the sward thins out."));
  a.field("ageing", v.ageing,
          range(0.0, 1.0)
              .axes("Weathering of the sward", "Its own weathering")
              .says("Own ageing",
                    "How weathered its blades are when the sward is so weathered. Flat and low stays green, steep is "
                    "early straw. Without points it ages as the sward does."));
}

template <typename A>
void describe(A& a, typename A::template Ref<wither::WitherOptions> v) {
  a.field(
      "weathering", v.weathering,
      percent(0.0, 1.0).says("Weathering degree", "How far the season has gone: 0 is green summer, 1 winter straw."));
  a.field("ageing", v.ageing, of(Role::Shape).says("Ageing", "How water and chlorophyll leave the blades."));
  a.field("body", v.body, of(Role::Shape).says("Body", "How blades fall and shrink as they dry."));
  a.field("texel", v.texel, of(Role::Shape).says("Texel", "The block of voxels that stands for the ageing sward."));
  a.field(
      "mingle", v.mingle,
      range(0, 64, "samples").says("Mingling", "Samples of blades that age each by their own curve and stand mixed."));
}

}  // namespace sward::project
