#include "bake/import.h"

#include "mesh/gltf_read.h"
#include "mesh/measure.h"
#include "project/assets.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace sward::bake {
namespace {

/// One-sided area of leaves over a unit of ground in a dense sward.
constexpr double kLeafAreaIndex = 5.0;
/// Files this much taller than the template's grass, or this low, were not drawn in metres or not for these views.
constexpr double kTallest = 1.25, kLowestM = 0.02;
/// Plants are at most this wide, in sides of the patch: wider ones would be few, and known again wherever they repeat.
constexpr double kWidest = 0.3;
/// Mean luminances of reflectance: of leaves, of solid parts (which let no light through), and under which a plant
/// reads as a silhouette.
constexpr double kLeafLuminance = 0.19, kSolidLuminance = 0.25, kDarkLuminance = 0.13;
/// Colour of plants whose file gives none (glTF's white).
constexpr glm::dvec3 kGrassColour(0.14, 0.22, 0.055);
constexpr double kNoColourLuminance = 0.5;  ///< leaves reflect less; half of white, since they transmit as well
/// Slabs for plants whose parts are wider than half a usual slab is thick: between coarse slabs they fall into cards.
constexpr int kSlicesOfWideParts = 32;

/// Height of the tallest grass of a project, or a meadow's.
double grassHeightM(const project::Project& project) {
  double height = 0.0;
  for (const project::Plant& p : project.patch.plants)
    if (p.kind == project::PlantKind::Grass) height = std::max(height, p.grass.heightM);
  return height > 0.0 ? height : 0.4;
}

/// For people: three significant digits.
std::string shortNumber(double value) {
  std::ostringstream text;
  text << std::setprecision(3) << value;
  return text.str();
}

/// Two significant digits.
double rounded(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return std::round(value / unit) * unit;
}

}  // namespace

Result<ImportedPlant> plantFromMesh(const std::filesystem::path& mesh, const project::Project& project,
                                    const std::filesystem::path& folder) {
  SWARD_ASSIGN(const mesh::Model model, mesh::readGltf(mesh));
  const mesh::Bounds box = mesh::bounds(model);
  const glm::dvec3 size = glm::dvec3(box.high) - glm::dvec3(box.low);
  const double ownHeightM = size.z, ownWidthM = std::max(size.x, size.y);
  const mesh::Measure measure = mesh::measure(model);
  ImportedPlant imported;
  imported.slices = project.sampling.slices;
  project::Plant& plant = imported.plant;
  std::vector<std::string>& notes = imported.notes;
  plant.name = mesh.stem().string();
  plant.kind = project::PlantKind::Gltf;
  plant.variants = 1;
  plant.tiltDeg = 12.0;  // one mesh alone: more variety in how it stands
  plant.gltf.path = project::assetPath(mesh, folder);
  plant.share = 0.0;
  const double heightM = grassHeightM(project);
  const std::string where = "patch.plants[0].";
  double scale = 1.0;
  if (!(ownHeightM >= kLowestM && ownHeightM <= kTallest * heightM)) scale = heightM / std::max(ownHeightM, 1e-9);
  scale = std::min(scale, kWidest * project.patch.sideM / std::max(ownWidthM, 1e-9));
  if (scale != 1.0) {
    plant.gltf.heightM = std::max(rounded(scale * ownHeightM), 0.002);
    scale = *plant.gltf.heightM / std::max(ownHeightM, 1e-9);
    notes.push_back("it stands " + shortNumber(*plant.gltf.heightM) + " m high to suit the template, the file says " +
                    shortNumber(ownHeightM) + " m (" + where + "gltf.heightM)");
  }
  plant.densityPerM2 =
      std::round(std::clamp(kLeafAreaIndex / std::max(scale * scale * measure.leafAreaM2, 1e-6), 4.0, 1500.0));
  notes.push_back(shortNumber(plant.densityPerM2) + " of them a square metre (" + where + "densityPerM2)");
  const double usual = measure.solidShare > 0.5 ? kSolidLuminance : kLeafLuminance;
  if (measure.luminance > 0.0 && measure.luminance < kDarkLuminance) {
    plant.gltf.material.emplace().brightness = rounded(std::min(usual / measure.luminance, 10.0));
    notes.push_back("its colours are dark (mean luminance " + shortNumber(measure.luminance) +
                    ") and were multiplied by " + shortNumber(plant.gltf.material->brightness) + " (" + where +
                    "gltf.material.brightness)");
  }
  if (measure.luminance > kNoColourLuminance) {
    plant.gltf.material.emplace().baseColour = kGrassColour;
    notes.push_back("it brings no colour of its own and is green (" + where + "gltf.material.baseColour)");
  }
  const double slabM = heightM / project.sampling.slices;
  if (scale * measure.partWidthM > 0.5 * slabM && project.sampling.slices < kSlicesOfWideParts) {
    imported.slices = kSlicesOfWideParts;
    notes.push_back("its parts are wide, so that it takes " + std::to_string(kSlicesOfWideParts) +
                    " slices (sampling.slices; fewer draw faster)");
  }
  return imported;
}

}  // namespace sward::bake
