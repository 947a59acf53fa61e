#pragma once

#include "project/schema_bake.h"
#include "project/schema_plants.h"
#include "project/schema_scene.h"
#include "project/schema_wither.h"

/// The one description of every field of a project: its name in the file, its range with a unit, what it decides, and
/// its label and help for people. Reading, writing, range checks, unknown keys, paths in messages, bake keys, the
/// reference and the editor's panels are archives that walk it.
///
/// An archive A has `template <class T> using Ref` (T& or const T&) and
///   a.version(n)                        the format's version, first
///   a.field(name, value, spec)          a number, flag, word, text, vector, curve, struct, list of structs; any of
///                                       them may be std::optional
///   a.choice(name, value, used, spec)   a struct that another value may switch off; unused ones are kept, not checked
/// A struct's fields come in the order of the file, those of one Spec::group side by side.
namespace sward::project {

template <typename A>
void describe(A& a, typename A::template Ref<Project> v) {
  a.version(kFormatVersion);
  a.field("name", v.name, label().says("Name", "What the project is called."));
  a.field("patch", v.patch, of(Role::Shape).says("Patch", "The piece of ground that is grown and baked."));
  a.field("lights", v.lights,
          of(Role::Shape)
              .says("Light directions",
                    "The lights under which the patch is baked. The sun can then stand "
                    "anywhere among them."));
  a.field("sampling", v.sampling,
          of(Role::Shape).says("Sampling", "How finely the patch is cut into layers and texels."));
  a.field("fit", v.fit, of(Role::Shape).says("Relighting", "How the answer to light is fitted and stored."));
  a.field("tiles", v.tiles, of(Role::Shape).says("Tiles", "How the patch is cut into tiles and laid over the ground."));
  a.field("leaf", v.leaf, of(Role::Colour).says("Leaf colour", "What leaves contain, and how they dry to straw."));
  a.field("wither", v.wither,
          of(Role::Shape).says("Withering", "How the sward goes from green to straw through an autumn."));
  a.field("terrain", v.terrain,
          of(Role::Shape).says("Terrain", "Hills and heightmaps under the grass. Nothing is baked anew."));
  a.field("sun", v.sun,
          of(Role::Shape).says("Sun", "Where the sun stands and how strong it is. Nothing is baked anew."));
  a.field("sky", v.sky, of(Role::Shape).says("Sky", "The air: clear or hazy. Nothing is baked anew."));
  a.field("render", v.render, of(Role::Shape).says("Drawing", "How the ground is drawn. Nothing is baked anew."));
  a.field(
      "accuracy", v.accuracy,
      of(Role::Shape).says("Accuracy", "The error that pictures may have; the cheapest bake that keeps it is chosen."));
  a.field("views", v.views, range(0, 1000, "views").says("Views", "Named cameras."));
  a.field("output", v.output, of(Role::Shape).says("Picture", "Size of the picture that is rendered."));
  a.field("sequence", v.sequence,
          of(Role::Shape)
              .says("Sequence", "How many frames render --frames draws, and what changes from one to the next."));
}

}  // namespace sward::project
