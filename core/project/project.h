#pragma once

#include "base/curve.h"
#include "base/result.h"
#include "leaf/options.h"
#include "lpt/options.h"
#include "mesh/options.h"
#include "render/options.h"
#include "report/options.h"
#include "scene/options.h"
#include "terrain/options.h"
#include "tiles/options.h"
#include "trace/options.h"
#include "wither/options.h"

#include <filesystem>
#include <string>
#include <vector>

namespace sward::project {

inline constexpr int kFormatVersion = 1;

enum class PlantKind { Grass, Flower, Clover, Gltf };

/// One kind of plant of the patch.
struct Plant {
  std::string name = "grass";
  PlantKind kind = PlantKind::Grass;
  mesh::GrassShape
      grass;  ///< read when kind says so; the others keep their values, so that switching back loses nothing
  mesh::FlowerShape flower;
  mesh::CloverShape clover;
  mesh::GltfSource gltf;
  double densityPerM2 = 400;  ///< plants per square metre where it grows alone
  double share = 1.0;         ///< of the ground; shares are relative to their sum
  int variants = 6;           ///< different procedural plants that are grown
  double sizeVariation = 0.2;
  double tiltDeg = 5.0;
  double clumping = 0.0;  ///< 0 even to 1 clustered
  bool operator==(const Plant&) const = default;
};

struct Soil {
  glm::dvec3 colour{0.085, 0.062, 0.040};  ///< linear RGB
  double colourVariation = 0.25;           ///< relative, over centimetres
  std::string texture;                     ///< optional image, relative path; tiled over the patch
  bool operator==(const Soil&) const = default;
};

struct Patch {
  double sideM = 1.2;
  std::vector<Plant> plants;
  Soil soil;
  std::uint64_t seed = 1;
  bool operator==(const Patch&) const = default;
};

struct Output {
  int width = 1280;
  int height = 720;
  bool operator==(const Output&) const = default;
};

/// How a project changes over a sequence of frames. Everything else stays as the project says.
struct Sequence {
  int frames = 120;
  double framesPerSecond = 24.0;
  /// The season's moment, 0 to 1, over the share of the sequence, 0 (first frame) to 1 (last): may rest or go back.
  /// Empty: the whole season, evenly. wither.ageing.weathering turns it into the weathering degree.
  base::Curve season;
  base::Curve hourUtc;  ///< takes the place of sun.moment.hourUtc in the same way; empty: the project's own hour
  int days = 0;         ///< that pass from the first frame to the last, from sun.moment's date on
  bool operator==(const Sequence&) const = default;
};

/// The document: everything that a .sward file says. Plain values.
struct Project {
  std::string name;
  Patch patch;
  scene::LightOptions lights;
  trace::SamplingOptions sampling;
  lpt::FitOptions fit;
  tiles::TileOptions tiles;
  leaf::LeafOptions leaf;
  wither::WitherOptions wither;
  terrain::TerrainOptions terrain;
  scene::SunOptions sun;
  scene::SkyOptions sky;
  render::RenderOptions render;
  report::AccuracyOptions accuracy;
  std::vector<scene::View> views;
  Output output;
  Sequence sequence;
  std::filesystem::path folder;  ///< where relative asset paths start; set by load, not saved, not compared by toJson

  const scene::View* view(const std::string& name) const;
  std::filesystem::path resolve(const std::string& assetPath) const { return folder / assetPath; }
  /// Compares everything that a file says; the folder is left out, as toJson leaves it out.
  bool operator==(const Project& other) const;
};

/// One thing that is wrong with a project.
struct Problem {
  bool fatal = true;  ///< false: a warning
  std::string where;  ///< path of the value, such as "patch.plants[0].grass.heightM"
  std::string what;
  std::string remedy;
};

/// Every value out of its range, every missing or unreadable asset, every impossible combination. Empty when all is
/// well.
std::vector<Problem> validate(const Project& project);
/// The first fatal problem as an error; nothing when there is none.
Result<void> requireValid(const Project& project);

/// JSON text in a stable order, two-space indent, relative paths; parse(toJson(p)) == p.
std::string toJson(const Project& project);
/// Reads JSON text. Unknown keys, wrong types and versions from the future are errors with the value's path (and the
/// line for syntax errors); missing keys keep their defaults. `overrides` are "path=value" (value as JSON, or plain
/// text), applied before reading, such as "sun.angles.elevationDeg=20" or "patch.plants[0].share=0.5".
Result<Project> parse(const std::string& json, const std::filesystem::path& file,
                      const std::vector<std::string>& overrides = {});
Result<Project> load(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});
Result<void> save(const Project& project, const std::filesystem::path& file);

/// A starting project: its name and what it shows, in one line.
struct TemplateInfo {
  std::string name;
  std::string description;
};
/// The starting projects, the one that most begin with first.
std::vector<TemplateInfo> templates();
std::vector<std::string> templateNames();
Result<Project> fromTemplate(const std::string& name);

}  // namespace sward::project
