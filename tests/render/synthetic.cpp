#include "render/synthetic.h"

#include "base/random.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sward::testing {
namespace {

/// A little of every feature and function.
lpt::CommonResponse commonResponse(int layers) {
  lpt::CommonResponse common;
  common.channels = 2;
  for (int layer = 0; layer < layers; ++layer) {
    for (int channel = 0; channel < 2; ++channel) {
      for (int function = 0; function < lpt::CommonResponse::kFunctions; ++function) {
        const bool coordinate = function == lpt::CommonResponse::kFunctions - 1;
        const float size = coordinate ? 0.6f : 0.02f;
        for (const float feature : {0.4f, 1.0f, -0.7f, 0.3f, 0.5f})
          common.values.push_back(size * (feature - 0.02f * static_cast<float>(layer + function % 3)));
      }
    }
  }
  return common;
}

/// Layers of one set over the whole patch, before they are cut to tiles and quantised.
struct Layers {
  lpt::LayerStackInput input;
  std::vector<float> nearest;  ///< per texel: depth of what is in it, smaller is nearer

  Layers(const SyntheticOptions& options, int width, int height, int layers) {
    input.basis = options.basis;
    input.width = width;
    input.height = height;
    input.layers = layers;
    const std::size_t texels =
        static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * static_cast<std::size_t>(layers);
    const std::size_t items = options.basis == lpt::Basis::Lpt ? texels / static_cast<std::size_t>(layers) : texels;
    input.coefficients.assign(items * 2 * static_cast<std::size_t>(lpt::stackCoefficients(options.basis)), 0.0f);
    input.coverage.assign(texels, 0.0f);
    input.reflectance.assign(texels, glm::vec3(0.1f));
    input.transmittance.assign(texels, glm::vec3(0.05f));
    input.sky.assign(texels, glm::vec2(0.3f, 0.1f));
    nearest.assign(texels, 1e9f);
    if (options.common && options.basis == lpt::Basis::Lpt) input.common = commonResponse(layers);
  }

  std::size_t texel(int layer, int x, int y) const {
    return (static_cast<std::size_t>(layer) * static_cast<std::size_t>(input.height) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(input.width) +
           static_cast<std::size_t>(x);
  }
};

struct Point {
  glm::dvec3 position;  ///< metres; x and y may lie outside the patch
  glm::vec3 colour;
  glm::dvec2 facing;  ///< horizontal normal of the blade
  double shade = 1.0;
};

int wrapped(double value, double side, int count) {
  const double turns = value / side;
  return std::clamp(static_cast<int>((turns - std::floor(turns)) * count), 0, count - 1);
}

/// The response of both channels: bright toward the light, dark deep in the grass, a little of every function.
void writeResponse(Layers& layers, int layer, int x, int y, const Point& point) {
  lpt::LayerStackInput& in = layers.input;
  const bool lptBasis = in.basis == lpt::Basis::Lpt;
  const std::size_t item = lptBasis ? layers.texel(0, x, y) : layers.texel(layer, x, y);
  const auto count = static_cast<std::size_t>(lpt::stackCoefficients(in.basis));
  const auto a = static_cast<float>(0.5 * point.shade);
  const glm::vec2 n = glm::vec2(point.facing) * static_cast<float>(0.12 * point.shade);
  for (std::size_t channel = 0; channel < 2; ++channel) {
    const float sign = channel == 0 ? 1.0f : -0.6f;
    const float level = channel == 0 ? a : 0.6f * a;
    float* b = in.coefficients.data() + (item * 2 + channel) * count;
    if (lptBasis) {
      const float values[10] = {-0.1f * a,   -0.15f * a, 0.1f * a,   0.02f,      0.01f * n.x,
                                0.01f * n.y, sign * n.x, sign * n.y, -0.15f * a, level};
      std::copy(std::begin(values), std::end(values), b);
    } else if (in.basis == lpt::Basis::Constant) {
      *b = level + 0.3f * n.x;
    } else {
      const float values[6] = {-0.1f * a, -0.15f * a, 0.02f, sign * n.x, sign * n.y, level};
      std::copy(std::begin(values), std::end(values), b);
    }
  }
}

void put(Layers& layers, int layer, int x, int y, double depth, const Point& point) {
  const std::size_t texel = layers.texel(layer, x, y);
  if (static_cast<float>(depth) >= layers.nearest[texel]) return;
  layers.nearest[texel] = static_cast<float>(depth);
  layers.input.coverage[texel] = 1.0f;
  layers.input.reflectance[texel] = point.colour;
  layers.input.transmittance[texel] = point.colour * glm::vec3(0.7f, 0.9f, 0.4f);
  const auto sky = static_cast<float>(0.15 + 0.55 * point.shade);
  layers.input.sky[texel] = glm::vec2(0.7f, 0.3f) * sky;
  writeResponse(layers, layer, x, y, point);
}

struct PatchLayers {
  Layers slices;
  std::array<Layers, 4> blades;
};

void putEverywhere(PatchLayers& patch, const SyntheticOptions& options, const Point& point) {
  const double side = options.patchSideM;
  const double height = point.position.z / options.heightM;
  if (height < 0.0 || height >= 1.0) return;
  const int n = options.layers;
  put(patch.slices, std::clamp(static_cast<int>((1.0 - height) * n), 0, n - 1),
      wrapped(point.position.x, side, options.patchTexels), wrapped(point.position.y, side, options.patchTexels),
      1.0 - height, point);
  const int row = static_cast<int>(height * options.bladeRows);
  const int width = options.patchTexels * options.bladeTexelsPerSlice;
  for (int axis = 0; axis < 2; ++axis) {
    const double across = axis == 0 ? point.position.x : point.position.y;
    const double along = axis == 0 ? point.position.y : point.position.x;
    const int slab = wrapped(across, side, options.blades);
    const double inSlab = across / side - std::floor(across / side);
    const int column = wrapped(along, side, width);
    put(patch.blades[static_cast<std::size_t>(axis * 2)], options.blades - 1 - slab, column, row, 1.0 - inSlab, point);
    put(patch.blades[static_cast<std::size_t>(axis * 2 + 1)], slab, column, row, inSlab, point);
  }
}

void growBlade(PatchLayers& patch, const SyntheticOptions& options, base::Random& random) {
  const double side = options.patchSideM;
  const glm::dvec2 root(random.uniform(0.0, side), random.uniform(0.0, side));
  const double length = options.heightM * random.uniform(0.45, 1.0);
  const double turn = random.uniform(0.0, 2.0 * std::numbers::pi);
  const double bend = random.uniform(0.1, 0.6);
  const double width = random.uniform(0.003, 0.007);
  const glm::dvec2 lean(std::cos(turn), std::sin(turn));
  const glm::dvec2 flat(-lean.y, lean.x);
  const glm::vec3 root0(0.10f, 0.13f, 0.03f);
  const glm::vec3 tip =
      glm::vec3(0.16f, 0.24f, 0.05f) + glm::vec3(0.16f, 0.08f, 0.02f) * static_cast<float>(random.uniform(0.0, 1.0));
  constexpr int kAlong = 240, kAcross = 5;
  for (int i = 0; i < kAlong; ++i) {
    const double s = (i + 0.5) / kAlong;
    Point point;
    const glm::dvec2 at = root + lean * (bend * length * s * s);
    point.colour = glm::mix(root0, tip, static_cast<float>(s));
    point.facing = lean;
    point.shade = 0.1 + 0.9 * s * s;
    for (int j = 0; j < kAcross; ++j) {
      const glm::dvec2 xy = at + flat * (width * (1.0 - s * s) * ((j + 0.5) / kAcross - 0.5));
      point.position = {xy.x, xy.y, length * s * (1.0 - 0.3 * bend * s)};
      putEverywhere(patch, options, point);
    }
  }
}

/// Coverage c of a slice layer, and of blade texels so that extinction a metre is the same.
void fillEvenly(PatchLayers& patch, const SyntheticOptions& options) {
  const double perM = -std::log1p(-options.evenCoverage) / (options.heightM / options.layers);
  const double bladeCoverage = -std::expm1(-perM * options.patchSideM / options.blades);
  const auto fill = [&](Layers& layers, double coverage) {
    Point point{{}, glm::vec3(0.2f, 0.3f, 0.1f), {0.0, 0.0}, 1.0};
    for (int layer = 0; layer < layers.input.layers; ++layer)
      for (int y = 0; y < layers.input.height; ++y)
        for (int x = 0; x < layers.input.width; ++x) put(layers, layer, x, y, 0.0, point);
    std::fill(layers.input.coverage.begin(), layers.input.coverage.end(), static_cast<float>(coverage));
  };
  fill(patch.slices, options.evenCoverage);
  for (Layers& side : patch.blades) fill(side, bladeCoverage);
}

/// South-west corner of a tile on the patch, at a multiple of the slabs' width.
glm::ivec2 tileCorner(const SyntheticOptions& options, int tile) {
  const int slab = options.patchTexels / options.blades;
  const auto bits = base::mix64(options.seed, 77, static_cast<std::uint64_t>(tile));
  if (options.tileTexels == options.patchTexels) return {0, 0};
  return {static_cast<int>(bits % static_cast<std::uint64_t>(options.blades)) * slab,
          static_cast<int>((bits >> 20) % static_cast<std::uint64_t>(options.blades)) * slab};
}

/// Cuts tiles with aprons from a layer set of the patch.
lpt::LayerStackInput cutTiles(const SyntheticOptions& options, const lpt::LayerStackInput& patch) {
  lpt::LayerStackInput out = patch;
  out.images = options.tiles;
  out.width = out.height = options.tileTexels + 2 * options.apron;
  for (auto* values : {&out.coefficients, &out.coverage}) values->clear();
  out.reflectance.clear();
  out.transmittance.clear();
  out.sky.clear();
  const bool perColumn = patch.basis == lpt::Basis::Lpt;
  const std::size_t count =
      static_cast<std::size_t>(patch.channels) * static_cast<std::size_t>(lpt::stackCoefficients(patch.basis));
  for (int tile = 0; tile < options.tiles; ++tile) {
    const glm::ivec2 corner = tileCorner(options, tile);
    for (int layer = 0; layer < patch.layers; ++layer) {
      for (int y = 0; y < out.height; ++y) {
        for (int x = 0; x < out.width; ++x) {
          const int n = options.patchTexels;
          const int px = ((corner.x + x - options.apron) % n + n) % n,
                    py = ((corner.y + y - options.apron) % n + n) % n;
          const std::size_t texel = (static_cast<std::size_t>(layer) * static_cast<std::size_t>(patch.height) +
                                     static_cast<std::size_t>(py)) *
                                        static_cast<std::size_t>(patch.width) +
                                    static_cast<std::size_t>(px);
          out.coverage.push_back(patch.coverage[texel]);
          out.reflectance.push_back(patch.reflectance[texel]);
          if (!patch.transmittance.empty()) out.transmittance.push_back(patch.transmittance[texel]);
          out.sky.push_back(patch.sky[texel]);
          if (perColumn && layer > 0) continue;
          const auto first = patch.coefficients.begin() + static_cast<std::ptrdiff_t>(texel * count);
          out.coefficients.insert(out.coefficients.end(), first, first + static_cast<std::ptrdiff_t>(count));
        }
      }
    }
  }
  return out;
}

lpt::LayerStackInput soilInput(const SyntheticOptions& options) {
  const auto texels = static_cast<std::size_t>(options.patchTexels) * static_cast<std::size_t>(options.patchTexels);
  lpt::LayerStackInput soil;
  soil.basis = lpt::Basis::Ptm;
  soil.width = soil.height = options.patchTexels;
  soil.layers = 1;
  soil.channels = 1;
  soil.coverage.assign(texels, 1.0f);
  soil.sky.assign(texels, glm::vec2(0.25f, 0.0f));
  for (std::size_t i = 0; i < texels && options.soilReflectance >= 0.0; ++i) {
    soil.reflectance.emplace_back(static_cast<float>(options.soilReflectance));
    for (const float b : {-0.05f, -0.05f, 0.0f, 0.0f, 0.0f, 0.5f}) soil.coefficients.push_back(b);
  }
  for (std::size_t i = 0; i < texels && options.soilReflectance < 0.0; ++i) {
    const float grain = base::unitFloat(base::mix64(options.seed, 5, i));
    soil.reflectance.push_back(glm::vec3(0.11f, 0.08f, 0.05f) * (0.7f + 0.6f * grain));
    for (const float b : {-0.05f, -0.05f, 0.0f, 0.01f * grain, 0.01f, 0.2f + 0.1f * grain})
      soil.coefficients.push_back(b);
  }
  return soil;
}

std::vector<tiles::BladeOwner> ownersOf(const SyntheticOptions& options) {
  const int slabTexels = options.patchTexels / options.blades;
  std::vector<tiles::BladeOwner> owners;
  for (int axis = 0; axis < 2; ++axis) {
    for (int tile = 0; tile < options.tiles; ++tile) {
      const glm::ivec2 corner = tileCorner(options, tile);
      for (int slab = 0; slab < options.tileTexels / slabTexels; ++slab) {
        for (int along = 0; along < options.tileTexels; ++along) {
          const int across = (corner[axis] / slabTexels + slab) % options.blades;
          owners.push_back({static_cast<std::uint16_t>(across),
                            static_cast<std::uint16_t>((corner[1 - axis] + along) % options.patchTexels)});
        }
      }
    }
  }
  return owners;
}

}  // namespace

bake::GroundBake syntheticGround(const SyntheticOptions& options) {
  const int bladeWidth = options.patchTexels * options.bladeTexelsPerSlice;
  const Layers blade(options, bladeWidth, options.bladeRows, options.blades);
  PatchLayers patch{Layers(options, options.patchTexels, options.patchTexels, options.layers),
                    {blade, blade, blade, blade}};
  if (options.evenCoverage > 0.0) {
    fillEvenly(patch, options);
  } else {
    base::Random random(options.seed);
    for (int i = 0; i < options.plants; ++i) growBlade(patch, options, random);
  }
  lpt::FitOptions fit;
  fit.basis = options.basis;
  fit.bits = options.bits;
  bake::GroundBake out;
  out.patchSideM = options.patchSideM;
  out.heightM = options.heightM;
  out.tiles.resolution = options.tileTexels;
  out.tiles.apron = options.apron;
  out.tiles.patchResolution = options.patchTexels;
  out.tiles.tiles.resize(static_cast<std::size_t>(options.tiles));
  out.slices = lpt::quantise(cutTiles(options, patch.slices.input), fit, false, {});
  lpt::FitOptions soilFit = fit;
  soilFit.basis = lpt::Basis::Ptm;
  out.soil = lpt::quantise(cutTiles(options, soilInput(options)), soilFit, false, {});
  for (std::size_t i = 0; i < 4; ++i) out.blades[i] = lpt::quantise(patch.blades[i].input, fit, true, {});
  out.bladeOwners = ownersOf(options);
  out.bladesPerPatch = options.blades;
  out.map.width = out.map.height = options.mapSide;
  for (int i = 0; i < options.mapSide * options.mapSide; ++i)
    out.map.tiles.push_back(static_cast<std::uint8_t>(base::mix64(options.seed, 3, static_cast<std::uint64_t>(i)) %
                                                      static_cast<std::uint64_t>(options.tiles)));
  return out;
}

}  // namespace sward::testing
