#include "project/limits.h"
#include "project/range_check.h"
#include "project/sequence.h"

#include "base/file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <set>

namespace sward::project {
namespace {

namespace fs = std::filesystem;

/// Collects what is wrong; the rules below add to it.
class Problems {
 public:
  void error(std::string where, std::string what, std::string remedy) {
    m_list.push_back({true, std::move(where), std::move(what), std::move(remedy)});
  }
  void warning(std::string where, std::string what, std::string remedy) {
    m_list.push_back({false, std::move(where), std::move(what), std::move(remedy)});
  }
  std::vector<Problem>& list() { return m_list; }

 private:
  std::vector<Problem> m_list;
};

std::string number(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

void checkAsset(const Project& project, const std::string& where, const std::string& asset, Problems& out) {
  const fs::path path = project.resolve(asset);
  std::error_code code;
  if (fs::is_regular_file(path, code)) return;
  const std::string what = fs::exists(path, code) ? "\"" + path.string() + "\" is not a file"
                                                  : "the file \"" + path.string() + "\" does not exist";
  out.error(where, what, "Paths start at the project's folder; correct it or put the file there.");
}

std::string lowerExtension(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

void checkGltf(const Project& project, const Plant& plant, const std::string& where, Problems& out) {
  const std::string path = where + ".gltf.path";
  if (plant.gltf.path.empty()) {
    return out.error(path, "the plant names no glTF file", "Give a .glb or .gltf file, relative to the project.");
  }
  const std::string extension = lowerExtension(plant.gltf.path);
  if (extension != ".glb" && extension != ".gltf") {
    return out.error(path, "\"" + plant.gltf.path + "\" is not a glTF file", "Give a .glb or .gltf file.");
  }
  checkAsset(project, path, plant.gltf.path, out);
}

/// Curves that leave nothing to grow. (Ranges are checked with all other values.)
void checkGrassCurves(const mesh::GrassShape& grass, const std::string& where, Problems& out) {
  const auto allZero = [](const base::Curve& curve) {
    const auto& points = curve.points();
    return !points.empty() &&
           std::none_of(points.begin(), points.end(), [](const base::CurvePoint& p) { return p.y > 0.0; });
  };
  if (allZero(grass.heightDistribution)) {
    out.error(where + ".heightDistribution", "the density is 0 at every height",
              "Raise one of its points above 0, or remove them all: heightVariation decides then.");
  }
  if (allZero(grass.profile)) {
    out.error(where + ".profile", "the blade has no width anywhere",
              "Raise one of its points above 0, or remove them all for the built-in form.");
  }
}

void checkPatch(const Project& project, Problems& out) {
  const Patch& patch = project.patch;
  double shares = 0.0;
  for (const Plant& plant : patch.plants) shares += plant.share;
  if (!patch.plants.empty() && !(shares > 0.0)) {
    out.error("patch.plants", "all shares are 0", "Give at least one plant a share above 0.");
  }
  double plants = 0.0;
  for (std::size_t i = 0; i < patch.plants.size(); ++i) {
    const Plant& plant = patch.plants[i];
    const std::string where = "patch.plants[" + std::to_string(i) + "]";
    if (plant.kind == PlantKind::Gltf) checkGltf(project, plant, where, out);
    if (plant.kind == PlantKind::Grass) checkGrassCurves(plant.grass, where + ".grass", out);
    if (shares > 0.0) plants += plant.densityPerM2 * patch.sideM * patch.sideM * plant.share / shares;
  }
  if (plants > kMaxPlants) {
    out.error("patch", "densities times area come to " + number(plants) + " plants",
              "At most " + number(kMaxPlants) + " are possible; make the patch smaller or the densities lower.");
  }
  if (patch.plants.empty()) {
    out.warning("patch.plants", "the patch has no plants", "Add some; bare soil is drawn otherwise.");
  }
  if (!patch.soil.texture.empty()) checkAsset(project, "patch.soil.texture", patch.soil.texture, out);
}

/// Days of a month; of February in a leap year when `leap`.
int daysOf(int month, bool leap) {
  constexpr std::array kDays{31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  return kDays[static_cast<std::size_t>(month - 1)] + (month == 2 && leap ? 1 : 0);
}

void checkDay(const std::string& where, int month, int day, bool leap, Problems& out) {
  if (month < 1 || month > 12 || day < 1 || day > 31 || day <= daysOf(month, leap)) return;
  out.error(where, "month " + std::to_string(month) + " has no day " + std::to_string(day),
            "Give 1 to " + std::to_string(daysOf(month, leap)) + ".");
}

/// Lights of each pattern, and where a project says how many; the sun's path may have fewer, since the sun does not
/// rise everywhere every day.
struct LightCount {
  std::int64_t count = 0;
  const char* where = "lights.count";
};

LightCount countLights(const scene::LightOptions& lights) {
  switch (lights.pattern) {
    case scene::LightPattern::Fibonacci:
      return {std::max(lights.count, 0), "lights.count"};
    case scene::LightPattern::List:
      return {static_cast<std::int64_t>(lights.directions.size()), "lights.directions"};
    case scene::LightPattern::Rings:
      return {std::int64_t{lights.rings.rings} * lights.rings.lightsPerRing + (lights.rings.zenith ? 1 : 0),
              "lights.rings"};
    case scene::LightPattern::SunPath:
      return {static_cast<std::int64_t>(lights.sunPath.dates.size()) * lights.sunPath.positions, "lights.sunPath"};
  }
  return {};
}

void checkList(const scene::LightOptions& lights, Problems& out) {
  for (std::size_t i = 0; i < lights.directions.size(); ++i) {
    if (lights.directions[i].elevationDeg < 0.0) {
      out.error("lights.directions[" + std::to_string(i) + "].elevationDeg",
                "the light stands at " + number(lights.directions[i].elevationDeg) + " degrees, under the horizon",
                "Give 0 to 90 degrees.");
    }
  }
}

void checkRings(const scene::RingOptions& rings, Problems& out) {
  if (rings.rings > 1 && !(rings.highestDeg > rings.lowestDeg)) {
    out.error("lights.rings.highestDeg", "the highest ring is no higher than the lowest", "Give more than lowestDeg.");
  }
  // On a circle round the zenith lx^2 + ly^2 is constant, so that two of the six functions of light are one.
  if (rings.rings == 1 && !rings.zenith) {
    out.warning("lights.rings", "a single ring does not tell how light changes with the height of the sun",
                "Set lights.rings.zenith, or use two rings.");
  }
}

void checkSunPath(const scene::SunPathOptions& path, Problems& out) {
  for (std::size_t i = 0; i < path.dates.size(); ++i) {
    checkDay("lights.sunPath.dates[" + std::to_string(i) + "].day", path.dates[i].month, path.dates[i].day, true, out);
  }
  // A day's path is a circle, on which the six functions of light are not independent either.
  if (path.dates.size() == 1) {
    out.warning("lights.sunPath.dates", "a single day does not tell how light changes across the sun's path",
                "Add a date months away, such as the other solstice.");
  }
}

void checkLights(const Project& project, Problems& out) {
  const scene::LightOptions& lights = project.lights;
  const LightCount lamps = countLights(lights);
  if (lamps.count < 1) {
    // The ranges of other patterns say so themselves.
    if (lights.pattern == scene::LightPattern::List) {
      out.error("lights.directions", "there are no lights",
                "List at least one direction, or set lights.pattern to fibonacci.");
    }
    return;
  }
  if (lights.pattern == scene::LightPattern::List) checkList(lights, out);
  if (lights.pattern == scene::LightPattern::Rings) checkRings(lights.rings, out);
  if (lights.pattern == scene::LightPattern::SunPath) checkSunPath(lights.sunPath, out);
  if (lamps.count > kMaxLights) {
    out.error(lamps.where, "these are " + std::to_string(lamps.count) + " lights",
              "At most " + std::to_string(kMaxLights) + " are possible.");
  }
  if (lamps.count < kFewLights) {
    out.warning(lamps.where, "there are only " + std::to_string(lamps.count) + " lights",
                "Use " + std::to_string(kFewLights) + " or more (15 is usual): relighting is a guess otherwise.");
  }
}

void checkSampling(const trace::SamplingOptions& sampling, Problems& out) {
  if (sampling.blades > 0 && sampling.sliceResolution % sampling.blades != 0) {
    out.error("sampling.sliceResolution",
              std::to_string(sampling.sliceResolution) + " texels cannot be divided among " +
                  std::to_string(sampling.blades) + " blades",
              "Make it a multiple of sampling.blades.");
  }
  // Tiles place the blades' slabs by slice texels, so a blade texel may not straddle two of them.
  if (sampling.sliceResolution > 0 && sampling.bladeWidth % sampling.sliceResolution != 0) {
    out.error("sampling.bladeWidth",
              std::to_string(sampling.bladeWidth) + " texels are no multiple of the slices' " +
                  std::to_string(sampling.sliceResolution),
              "Make it 1, 2, 3 ... times sampling.sliceResolution.");
  }
  if (sampling.bladeWidth % 2 != 0) {
    out.error("sampling.bladeWidth", std::to_string(sampling.bladeWidth) + " texels is odd", "Give an even number.");
  }
  const auto rays = [](int width, int height, int layers, int subSamples) {
    return static_cast<double>(width) * height * layers * subSamples;
  };
  const double slices =
      rays(sampling.sliceResolution, sampling.sliceResolution, sampling.slices, sampling.sliceSubSamples);
  const double blades = rays(sampling.bladeWidth, sampling.bladeHeight, sampling.blades, sampling.bladeSubSamples);
  if (slices > kMaxHitRays) {
    out.error("sampling.sliceSubSamples", "the slices come to " + number(slices) + " rays",
              "At most " + number(kMaxHitRays) + " are possible; lower the resolution, the layers or the sub-samples.");
  }
  if (blades > kMaxHitRays) {
    out.error("sampling.bladeSubSamples", "the blades come to " + number(blades) + " rays",
              "At most " + number(kMaxHitRays) + " are possible; lower the resolution, the layers or the sub-samples.");
  }
}

/// How tiles are cut: sizes that fit the patch and line up with the blades' slabs.
void checkTileSizes(const Project& project, Problems& out) {
  const tiles::TileOptions& t = project.tiles;
  const trace::SamplingOptions& s = project.sampling;
  if (t.resolution % 2 != 0) {
    out.error("tiles.resolution", std::to_string(t.resolution) + " texels is odd", "Give an even number.");
  }
  const int pitch = s.blades > 0 && s.sliceResolution % s.blades == 0 ? s.sliceResolution / s.blades : 0;
  if (pitch > 0 && t.resolution % 2 == 0 && (t.resolution / 2) % pitch != 0) {
    out.error("tiles.resolution",
              "half of it, " + std::to_string(t.resolution / 2) + " texels, is no multiple of a blade slab's " +
                  std::to_string(pitch) + " (sampling.sliceResolution / sampling.blades)",
              "Change one of the three, such as " + std::to_string(2 * pitch) + " for tiles.resolution.");
  }
  if (t.overlap > t.resolution / 4) {
    out.error("tiles.overlap", std::to_string(t.overlap) + " texels are more than a quarter of a tile",
              "Give at most " + std::to_string(t.resolution / 4) + ".");
  }
  if (t.resolution + 2 * t.overlap > s.sliceResolution) {
    out.error("tiles.resolution",
              "a diamond with its overlap, " + std::to_string(t.resolution + 2 * t.overlap) +
                  " texels, is larger than the patch of " + std::to_string(s.sliceResolution),
              "Make tiles.resolution or tiles.overlap smaller, or sampling.sliceResolution larger.");
  }
  if (t.apron > 0 && (t.apron & (t.apron - 1)) != 0) {
    out.error("tiles.apron", std::to_string(t.apron) + " texels is no power of two", "Give 1, 2, 4, 8, 16 or 32.");
  }
  if (t.apron > t.resolution / 2) {
    out.error("tiles.apron", std::to_string(t.apron) + " texels are more than half a tile",
              "Give at most " + std::to_string(t.resolution / 2) + ".");
  }
}

void checkTileCounts(const Project& project, Problems& out) {
  const tiles::TileOptions& t = project.tiles;
  const trace::SamplingOptions& s = project.sampling;
  const int pairs = t.coloursPerAxis * t.coloursPerAxis;
  const int count = pairs * t.tilesPerPair;
  if (t.tilesPerPair > pairs) {
    out.error("tiles.tilesPerPair",
              "only " + std::to_string(pairs) + " different tiles exist for a pair of " +
                  std::to_string(t.coloursPerAxis) + " colours an axis",
              "Give at most " + std::to_string(pairs) + ".");
  }
  if (s.blades * s.blades < 2 * t.coloursPerAxis) {
    out.error("tiles.coloursPerAxis",
              "the patch has " + std::to_string(s.blades * s.blades) + " places for " +
                  std::to_string(2 * t.coloursPerAxis) + " diamonds",
              "Use fewer colours, or more of sampling.blades (places are their square).");
  }
  if (count > kMaxTiles) {
    out.error("tiles.tilesPerPair", std::to_string(count) + " tiles do not fit in one byte a cell",
              "Keep coloursPerAxis squared times tilesPerPair at 255 or less.");
  }
  if (t.map == tiles::MapMethod::Hashed && t.tilesPerPair != pairs) {
    out.error("tiles.map", "a hashed map needs the complete set of tiles",
              "Set tiles.tilesPerPair to " + std::to_string(pairs) + ", or tiles.map to scan_order.");
  }
  const double side = t.resolution + 2.0 * t.apron;
  const double texels = count * side * side * project.sampling.slices;
  if (texels > kMaxTileTexels) {
    out.error("tiles", "the tiles come to " + number(texels) + " layer texels",
              "At most " + number(kMaxTileTexels) + " are possible; use fewer or smaller tiles, or fewer slices.");
  }
}

void checkTerrain(const Project& project, Problems& out) {
  const terrain::TerrainOptions& t = project.terrain;
  if (t.source != terrain::Source::Heightmap) return;
  if (t.heightmap.path.empty()) {
    return out.error("terrain.heightmap.path", "the terrain names no heightmap",
                     "Give a PNG, TIFF, EXR or .asc file, relative to the project, or set terrain.source to hills.");
  }
  checkAsset(project, "terrain.heightmap.path", t.heightmap.path, out);
  if (!(t.heightmap.heightHighM > t.heightmap.heightLowM)) {
    out.warning("terrain.heightmap.heightHighM", "white is no higher than black", "Give more than heightLowM.");
  }
}

void checkNeverFalls(const base::Curve& curve, const std::string& where, Problems& out) {
  const auto& points = curve.points();
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points[i].y >= points[i - 1].y) continue;
    return out.error(where,
                     "it falls from " + number(points[i - 1].y) + " at " + number(points[i - 1].x) + " to " +
                         number(points[i].y) + " at " + number(points[i].x),
                     "Weathering may rest but never go back; raise the later point.");
  }
}

void checkWither(const wither::WitherOptions& wither, Problems& out) {
  checkNeverFalls(wither.ageing.weathering, "wither.ageing.weathering", out);
  double shares = 0.0;
  for (std::size_t i = 0; i < wither.mingle.size(); ++i) {
    shares += wither.mingle[i].share;
    checkNeverFalls(wither.mingle[i].ageing, "wither.mingle[" + std::to_string(i) + "].ageing", out);
  }
  if (!wither.mingle.empty() && !(shares > 0.0)) {
    out.error("wither.mingle", "all shares are 0", "Give at least one sample a share above 0.");
  }
  if (wither.body.shrinkVein > wither.body.shrinkMesophyll) {
    out.error("wither.body.shrinkVein",
              number(wither.body.shrinkVein) + " is more than shrinkMesophyll's " + number(wither.body.shrinkMesophyll),
              "Veins keep their water longer: give at most as much.");
  }
  if (wither.texel.resolution % 8 != 0) {
    out.error("wither.texel.resolution", std::to_string(wither.texel.resolution) + " voxels are no multiple of 8",
              "Give a multiple of 8, such as 64, 128 or 256.");
  }
}

void checkViews(const Project& project, Problems& out) {
  if (project.views.empty()) {
    out.warning("views", "the project has no views", "Add one; a default view at eye height is used otherwise.");
  }
  std::set<std::string> names;
  for (std::size_t i = 0; i < project.views.size(); ++i) {
    const scene::View& view = project.views[i];
    const std::string where = "views[" + std::to_string(i) + "]";
    if (view.name.empty()) out.error(where + ".name", "the view has no name", "Name it.");
    if (!names.insert(view.name).second) {
      out.error(where + ".name", "another view is called \"" + view.name + "\" too", "Give each view its own name.");
    }
    const glm::dvec3 along = view.target - view.position;
    if (glm::dot(along, along) < 1e-12) {
      out.error(where + ".target", "the view looks at its own position", "Move target or position.");
    }
  }
}

void checkSequence(const Project& project, Problems& out) {
  const Sequence& sequence = project.sequence;
  const bool sun = !sequence.hourUtc.points().empty() || sequence.days > 0;
  if (sun && !project.sun.byMoment) {
    out.warning(sequence.days > 0 ? "sequence.days" : "sequence.hourUtc", "the sun stands at angles, and does not move",
                "Set sun.byMoment, so that date and hour place it.");
  }
  if (!project.sun.byMoment || sequence.days <= 0 || sequence.frames < 2) return;
  const int last = projectAt(project, sequence.frames - 1).sun.moment.year;
  if (last > 2050) {
    out.error("sequence.days", "the sequence ends in the year " + std::to_string(last),
              "The sun is known until 2050; let fewer days pass.");
  }
}

void checkRest(const Project& project, Problems& out) {
  if (project.fit.clusters != 2 && project.fit.clusters != 4) {
    out.error("fit.clusters", std::to_string(project.fit.clusters) + " groups of layers cannot be stored",
              "Give 2 or 4.");
  }
  if (project.fit.bits != 8 && project.fit.bits != 16) {
    out.error("fit.bits", std::to_string(project.fit.bits) + " bits cannot be stored", "Give 8 or 16.");
  }
  const std::int64_t pixels = std::int64_t{project.output.width} * project.output.height;
  if (pixels > kMaxPixels) {
    out.error("output", std::to_string(pixels) + " pixels are more than " + std::to_string(kMaxPixels),
              "Make the picture smaller.");
  }
  const scene::SunMoment& m = project.sun.moment;
  if (project.sun.byMoment) {
    checkDay("sun.moment.day", m.month, m.day, (m.year % 4 == 0 && m.year % 100 != 0) || m.year % 400 == 0, out);
  }
}

}  // namespace

std::vector<Problem> validate(const Project& project) {
  Problems problems;
  RangeCheck ranges("", problems.list());
  describe(ranges, project);
  checkPatch(project, problems);
  checkLights(project, problems);
  checkSampling(project.sampling, problems);
  checkTileSizes(project, problems);
  checkTileCounts(project, problems);
  checkWither(project.wither, problems);
  checkTerrain(project, problems);
  checkViews(project, problems);
  checkRest(project, problems);
  checkSequence(project, problems);
  return std::move(problems.list());
}

Result<void> requireValid(const Project& project) {
  std::vector<Problem> problems = validate(project);
  const auto fatal = std::find_if(problems.begin(), problems.end(), [](const Problem& p) { return p.fatal; });
  if (fatal == problems.end()) return {};
  return Error::badInput(fatal->what, fatal->where, fatal->remedy);
}

}  // namespace sward::project
