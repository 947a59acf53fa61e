#pragma once

#include "project/project.h"
#include "project/spec.h"

/// The part of the schema that says what grows; see schema.h.
namespace sward::project {

template <typename A>
void describe(A& a, typename A::template Ref<mesh::LeafOptics> v) {
  a.field("translucency", v.translucency,
          percent(0.0, 1.0, Role::Colour)
              .says("Translucency",
                    "How much light passes through a leaf, against what it reflects. Raise it for thin blades that "
                    "glow against the sun; thick petals want little."));
  a.field("transmissionTint", v.transmissionTint,
          colour(4.0).soft(0.0, 2.0).says("Glow tint",
                                          "Tints the light that passes through a leaf, on top of the leaf's own "
                                          "colour. Real leaves glow yellower than they reflect."));
}

template <typename A>
void describe(A& a, typename A::template Ref<mesh::MaterialOverride> v) {
  a.field("baseColour", v.baseColour,
          colour().says("Base colour", "Replaces the colour and the texture that the glTF file gives."));
  a.field("alphaCutoff", v.alphaCutoff,
          percent(0.001, 0.999)
              .says("Alpha cut-off",
                    "Leaves are cut away where the texture's alpha is below this. Raise it when a coloured fringe "
                    "shows round the leaves."));
  a.field("optics", v.optics,
          of(Role::Colour).says("Leaf optics", "How the leaves let light through, which glTF files do not say."));
  a.field("brightness", v.brightness,
          range(0.05, 20.0, "", Role::Colour)
              .decades(0.2, 5.0)
              .says("Brightness", "Multiplies the file's own colours. Raise it for meshes that were painted dark."));
}

template <typename A>
void describe(A& a, typename A::template Ref<mesh::GrassShape> v) {
  a.field("bladesPerPlant", v.bladesPerPlant,
          range(1, 500, "blades")
              .soft(1, 60)
              .in("Size")
              .says("Blades per plant", "Leaves of one tuft. More make a plant denser without planting more of them."));
  a.field("heightM", v.heightM,
          range(0.002, 20.0, "m")
              .decades(0.02, 1.5)
              .in("Size")
              .says("Blade height", "Length along a blade before it bends, so bent grass stands lower than this."));
  a.field("heightVariation", v.heightVariation,
          percent(0.0, 0.5).in("Size").says("Height variation",
                                            "How much blades differ in height. Low for a mown lawn, high for a wild "
                                            "meadow."));
  a.field("heightDistribution", v.heightDistribution,
          range(0.0, 1.0)
              .axes("Height / blade height", "Density", 0.0, mesh::kHighestRelativeHeight)
              .in("Size")
              .says("Density by height",
                    "How many blades reach which height: two humps grow an under-layer with taller grass above. "
                    "Without points, Height variation decides."));
  a.field("widthM", v.widthM,
          range(0.0001, 1.0, "m")
              .decades(0.0005, 0.03)
              .in("Size")
              .says("Blade width", "Width of a blade where it is widest."));
  a.field("clumpRadiusM", v.clumpRadiusM,
          range(0.0, 2.0, "m")
              .soft(0.0, 0.2)
              .in("Size")
              .says("Tuft radius", "How far from the plant's middle its blades root. Small gives tight tussocks."));
  a.field("profile", v.profile,
          range(0.0, 1.0)
              .axes("Along the blade", "Relative width")
              .in("Shape")
              .says("Blade profile",
                    "Width along the blade, from root to tip. Without points the blade tapers like real grass."));
  a.field("bendDeg", v.bendDeg,
          angle(0.0, 180.0)
              .soft(0.0, 150.0)
              .in("Shape")
              .says("Bend", "How far a blade curves over from root to tip. Raise it for soft, hanging grass."));
  a.field("leanDeg", v.leanDeg,
          angle(0.0, 85.0).soft(0.0, 60.0).in("Shape").says(
              "Lean", "How far blades lean outward where they leave the ground."));
  a.field("twistDeg", v.twistDeg,
          angle(-1080.0, 1080.0)
              .soft(-180.0, 180.0)
              .in("Shape")
              .says("Twist", "How far a blade turns about itself from root to tip, which makes it glint unevenly."));
  a.field(
      "foldDeg", v.foldDeg,
      angle(0.0, 85.0).in("Shape").says(
          "Fold", "Crease along the midrib. It doubles the triangles and shows only close up; 0 keeps blades flat."));
  a.field("segments", v.segments,
          range(1, 64, "quads")
              .soft(1, 16)
              .in("Shape")
              .expert()
              .says("Segments", "Pieces along a blade. Raise it when strongly bent blades look angular."));
  a.field("seedHeadShare", v.seedHeadShare,
          percent(0.0, 1.0)
              .in("Seed heads")
              .says("Share of stems", "How many of the blades are stems that carry a seed head."));
  a.field("seedHeadColour", v.seedHeadColour,
          colour().in("Seed heads").says("Head colour", "Colour of the seed heads; their stems blend toward it."));
  a.field("rootColour", v.rootColour,
          colour().in("Colour").says("Root colour", "Colour where a blade leaves the ground."));
  a.field("tipColour", v.tipColour, colour().in("Colour").says("Tip colour", "Colour at the end of a blade."));
  a.field("colourAlong", v.colourAlong,
          range(0.0, 1.0, "", Role::Colour)
              .axes("Along the blade", "Part of tip colour")
              .in("Colour")
              .says("Colour along blade",
                    "Where the root's colour gives way to the tip's. More segments show finer steps; nothing is traced "
                    "anew."));
  a.field("colourVariation", v.colourVariation,
          percent(0.0, 1.0, Role::Colour)
              .soft(0.0, 0.5)
              .in("Colour")
              .says("Colour variation",
                    "How much blades differ in brightness and hue. More also dries some tips to straw."));
  a.field("optics", v.optics, of(Role::Colour).in("Colour").says("Leaf optics", "How the blades let light through."));
}

template <typename A>
void describe(A& a, typename A::template Ref<mesh::FlowerShape> v) {
  a.field("heightM", v.heightM,
          range(0.002, 20.0, "m")
              .decades(0.03, 1.5)
              .in("Size")
              .says("Stem height", "Length of the stem, from the ground to the flower head."));
  a.field("heightVariation", v.heightVariation,
          percent(0.0, 0.5).in("Size").says("Height variation", "How much flowers differ in height."));
  a.field("stemWidthM", v.stemWidthM,
          range(0.0001, 0.5, "m")
              .decades(0.0005, 0.02)
              .in("Size")
              .says("Stem width", "Thickness of the stem at its foot."));
  a.field("bendDeg", v.bendDeg,
          angle(0.0, 120.0)
              .soft(0.0, 90.0)
              .in("Size")
              .says("Bend", "How far the stem curves over. Raise it for heads that nod."));
  a.field("leaves", v.leaves,
          range(0, 200, "leaves").soft(0, 20).in("Leaves").says("Leaves", "Leaves along the lower part of the stem."));
  a.field("leafLengthM", v.leafLengthM,
          range(0.001, 5.0, "m")
              .decades(0.01, 0.4)
              .in("Leaves")
              .says("Leaf length", "Length of the lowest leaf; higher ones are smaller."));
  a.field("petals", v.petals,
          range(1, 200, "petals")
              .soft(3, 60)
              .in("Head")
              .says("Petals", "Petals of the head. More than twenty stand in two rings."));
  a.field("petalLengthM", v.petalLengthM,
          range(0.0005, 1.0, "m").decades(0.002, 0.06).in("Head").says("Petal length", "Length of one petal."));
  a.field("petalWidthM", v.petalWidthM,
          range(0.0002, 1.0, "m")
              .decades(0.001, 0.06)
              .in("Head")
              .says("Petal width", "Width of one petal where it is widest."));
  a.field("centreRadiusM", v.centreRadiusM,
          range(0.0002, 1.0, "m")
              .decades(0.001, 0.04)
              .in("Head")
              .says("Centre radius", "Size of the disc in the middle, from which the petals spread."));
  a.field("petalColour", v.petalColour, colour().in("Colour").says("Petal colour", "Colour of the petals."));
  a.field("centreColour", v.centreColour,
          colour().in("Colour").says("Centre colour", "Colour of the disc in the middle of the head."));
  a.field("leafColour", v.leafColour, colour().in("Colour").says("Leaf colour", "Colour of the leaves and the stem."));
  a.field("colourVariation", v.colourVariation,
          percent(0.0, 1.0, Role::Colour)
              .soft(0.0, 0.5)
              .in("Colour")
              .says("Colour variation", "How much flowers and leaves differ in brightness and hue."));
  a.field("optics", v.optics,
          of(Role::Colour)
              .in("Colour")
              .says("Leaf optics", "How the leaves let light through; petals pass their own colour."));
}

template <typename A>
void describe(A& a, typename A::template Ref<mesh::CloverShape> v) {
  a.field(
      "stems", v.stems,
      range(1, 500, "stems").soft(1, 40).in("Size").says("Stems", "Stems of one plant, each with a leaf or a head."));
  a.field("heightM", v.heightM,
          range(0.002, 20.0, "m")
              .decades(0.01, 0.5)
              .in("Size")
              .says("Stem height", "Length of the leaf stems; those of flower heads are a third longer."));
  a.field("heightVariation", v.heightVariation,
          percent(0.0, 0.5).in("Size").says("Height variation", "How much stems differ in height."));
  a.field("leafletLengthM", v.leafletLengthM,
          range(0.0005, 1.0, "m")
              .decades(0.003, 0.06)
              .in("Size")
              .says("Leaflet length", "Length of each of a leaf's three leaflets; flower heads grow with it."));
  a.field("spreadM", v.spreadM,
          range(0.0, 2.0, "m")
              .soft(0.0, 0.25)
              .in("Size")
              .says("Spread", "How far the plant creeps from its middle. More covers the ground more evenly."));
  a.field("headShare", v.headShare,
          percent(0.0, 1.0).in("Flower heads").says("Share of heads", "How many of the stems carry a flower head."));
  a.field("headColour", v.headColour,
          colour().in("Flower heads").says("Head colour", "Colour of the flower heads; their lower florets brown."));
  a.field("leafColour", v.leafColour, colour().in("Colour").says("Leaf colour", "Colour of the leaflets and stems."));
  a.field("colourVariation", v.colourVariation,
          percent(0.0, 1.0, Role::Colour)
              .soft(0.0, 0.5)
              .in("Colour")
              .says("Colour variation", "How much leaves and heads differ in brightness and hue."));
  a.field("optics", v.optics,
          of(Role::Colour)
              .in("Colour")
              .says("Leaf optics", "How the leaflets let light through; heads pass their own colour."));
}

template <typename A>
void describe(A& a, typename A::template Ref<mesh::GltfSource> v) {
  a.field("path", v.path,
          label().file(".glb .gltf").says("Mesh file", "The glTF 2.0 file of the plant, relative to the project."));
  a.field("heightM", v.heightM,
          range(0.002, 20.0, "m")
              .decades(0.02, 3.0)
              .says("Height", "Scales the plant to stand this high. Use it when the file is not in metres."));
  a.field("material", v.material,
          of(Role::Shape).says("Material", "Replaces or completes what the file says of its materials."));
}

template <typename A>
void describe(A& a, typename A::template Ref<Plant> v) {
  a.field("name", v.name, label().says("Name", "What the plant is called in the lists of this program."));
  a.field("kind", v.kind,
          of(Role::Shape)
              .says("Kind",
                    "What grows here. Each kind keeps its own settings, so switching back loses "
                    "nothing."));
  a.field("densityPerM2", v.densityPerM2,
          range(0.0, 100000.0, "plants/m2")
              .decades(1.0, 5000.0)
              .in("Amount")
              .says("Density", "Plants on a square metre where this plant grows alone. Raise it until no soil shows."));
  a.field("share", v.share,
          range(0.0, 1e6).soft(0.0, 1.0).steps(0.01).in("Amount").says(
              "Share of the ground", "Its part of the ground, relative to the shares of the other plants."));
  a.field("clumping", v.clumping,
          percent(0.0, 1.0).in("Amount").says(
              "Clumping", "From evenly spread to standing in clusters. High values show which tile stands where."));
  a.field("variants", v.variants,
          range(1, 64)
              .soft(1, 16)
              .in("Variation")
              .says("Variants",
                    "How many different plants are grown and repeated. More look less alike and trace slower."));
  a.field("sizeVariation", v.sizeVariation,
          percent(0.0, 0.45).in("Variation").says("Size variation", "How much whole plants differ in size."));
  a.field("tiltDeg", v.tiltDeg,
          angle(0.0, 60.0)
              .soft(0.0, 30.0)
              .in("Variation")
              .says("Tilt", "How far whole plants tilt from upright, each another way."));
  a.choice("grass", v.grass, v.kind == PlantKind::Grass,
           of(Role::Shape).says("Grass", "A tuft of blades, with seed heads if wanted."));
  a.choice("flower", v.flower, v.kind == PlantKind::Flower,
           of(Role::Shape).says("Flower", "A stem with leaves and one head of petals."));
  a.choice("clover", v.clover, v.kind == PlantKind::Clover,
           of(Role::Shape).says("Clover", "Stems with three leaflets each, and round flower heads."));
  a.choice("gltf", v.gltf, v.kind == PlantKind::Gltf,
           of(Role::Shape).says("Mesh", "A plant that was modelled elsewhere."));
}

template <typename A>
void describe(A& a, typename A::template Ref<Soil> v) {
  a.field("colour", v.colour, colour().says("Colour", "Colour of the bare ground between the plants."));
  a.field("colourVariation", v.colourVariation,
          percent(0.0, 1.0, Role::Colour).says("Colour variation", "How much the ground varies over centimetres."));
  a.field("texture", v.texture,
          label()
              .file(".png .jpg .jpeg .exr .tif .tiff")
              .says("Texture", "A picture laid over the whole patch in place of the colour. Its edges should meet."));
}

template <typename A>
void describe(A& a, typename A::template Ref<Patch> v) {
  a.field("sideM", v.sideM,
          range(0.02, 200.0, "m")
              .decades(0.2, 5.0)
              .says("Side length",
                    "Side of the square piece of ground that is grown and cut into tiles. Larger repeats less "
                    "and shows less detail."));
  a.field("plants", v.plants, range(0, 64, "plants").says("Plants", "What grows on the patch."));
  a.field("soil", v.soil, of(Role::Shape).says("Soil", "The ground under the plants."));
  a.field("seed", v.seed, of(Role::Shape).says("Seed", "Another number grows another patch of the same kind."));
}

}  // namespace sward::project
