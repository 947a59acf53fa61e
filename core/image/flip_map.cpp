#include "image/flip_map.h"

#include "base/parallel.h"
#include "image/colour.h"
#include "image/flip_filters.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sward::image {

namespace {

// The paper's constants, under its names.
constexpr float kColourPower = 0.7f;     // q_c
constexpr float kKneeShare = 0.4f;       // p_c: share of the greatest colour difference ...
constexpr float kKneeError = 0.95f;      // p_t: ... that is mapped to this error
constexpr float kFeaturePower = 0.5f;    // q_f
constexpr std::size_t kRowsAtOnce = 64;  // each range converts and filters the rows of its filters' radius anew

struct Matrices {
  glm::mat3 ratiosFromLinear;  ///< to X / Xn, Y / Yn, Z / Zn
  glm::mat3 linearFromRatios;

  Matrices() {
    for (int i = 0; i < 3; ++i) {
      glm::dvec3 unit(0.0);
      unit[i] = 1.0;
      ratiosFromLinear[i] = glm::vec3(xyzFromLinear(unit) / kWhiteXyz);
      linearFromRatios[i] = glm::vec3(linearFromXyz(unit * kWhiteXyz));
    }
  }
};

const Matrices& matrices() {
  static const Matrices kMatrices;
  return kMatrices;
}

// The paper's YyCxCz is an affine map of these: Yy = 116 y - 16, Cx = 500 (x - y), Cz = 200 (y - z) of the ratios x, y,
// z to white. Filters are linear and the weights of each sum to 1, so that filtering these gives the same colours.
struct Opponent {
  FlipPlane luminance;   ///< y
  FlipPlane redGreen;    ///< x - y
  FlipPlane blueYellow;  ///< y - z

  Opponent(int width, int rows) : luminance(width, rows), redGreen(width, rows), blueYellow(width, rows) {}
};

struct Rows {
  int begin;
  int end;
  int count() const { return end - begin; }
};

// The rows and `halo` more on both sides; beyond the image its outermost row is repeated.
Opponent toOpponent(const ShownColour& shown, int width, int height, Rows rows, int halo) {
  Opponent opponent(width, rows.count() + 2 * halo);
  const glm::mat3& ratiosFromLinear = matrices().ratiosFromLinear;
  for (int row = 0; row < opponent.luminance.rows; ++row) {
    const int y = std::clamp(rows.begin - halo + row, 0, height - 1);
    for (int x = 0; x < width; ++x) {
      const glm::vec3 ratios = ratiosFromLinear * shown(x, y);
      opponent.luminance.row(row)[x] = ratios.y;
      opponent.redGreen.row(row)[x] = ratios.x - ratios.y;
      opponent.blueYellow.row(row)[x] = ratios.y - ratios.z;
    }
  }
  return opponent;
}

Opponent asSeen(const Opponent& opponent, int halo, int rows, const FlipFilters& filters) {
  Opponent seen(opponent.luminance.width, rows);
  addFiltered(opponent.luminance, halo, filters.achromatic, filters.achromatic, seen.luminance);
  addFiltered(opponent.redGreen, halo, filters.redGreen, filters.redGreen, seen.redGreen);
  addFiltered(opponent.blueYellow, halo, filters.blueYellowWide, filters.blueYellowWide, seen.blueYellow);
  addFiltered(opponent.blueYellow, halo, filters.blueYellowNarrow, filters.blueYellowNarrow, seen.blueYellow);
  return seen;
}

float labCurve(float ratio) {
  constexpr float kKnee = 6.0f / 29.0f;
  return ratio > kKnee * kKnee * kKnee ? std::cbrt(ratio) : ratio / (3.0f * kKnee * kKnee) + 4.0f / 29.0f;
}

// L*, a*, b* of ratios to white, chroma scaled by 0.01 L* (Hunt's effect).
glm::vec3 huntLab(const glm::vec3& ratios) {
  const glm::vec3 curve(labCurve(ratios.x), labCurve(ratios.y), labCurve(ratios.z));
  const float lightness = 116.0f * curve.y - 16.0f;
  const float hunt = 0.01f * lightness;
  return {lightness, hunt * 500.0f * (curve.x - curve.y), hunt * 200.0f * (curve.y - curve.z)};
}

glm::vec3 huntLabAt(const Opponent& seen, int x, int row) {
  const float y = seen.luminance.row(row)[x];
  const glm::vec3 ratios(y + seen.redGreen.row(row)[x], y, y - seen.blueYellow.row(row)[x]);
  const glm::vec3 shown = glm::clamp(matrices().linearFromRatios * ratios, 0.0f, 1.0f);
  return huntLab(matrices().ratiosFromLinear * shown);
}

// HyAB: city block in lightness, Euclid in chroma; raised to the power q_c.
float colourDistance(const glm::vec3& a, const glm::vec3& b) {
  const float da = a.y - b.y;
  const float db = a.z - b.z;
  return std::pow(std::abs(a.x - b.x) + std::sqrt(da * da + db * db), kColourPower);
}

// The greatest distance of displayable colours is that of the green and blue primaries.
float greatestColourDistance() {
  const glm::mat3& ratiosFromLinear = matrices().ratiosFromLinear;
  return colourDistance(huntLab(ratiosFromLinear[1]), huntLab(ratiosFromLinear[2]));
}

// Distances of up to p_c of the greatest fill [0, p_t], the others the rest.
float colourError(float distance, float greatest) {
  const float knee = kKneeShare * greatest;
  if (distance < knee) return distance * kKneeError / knee;
  return kKneeError + (distance - knee) / (greatest - knee) * (1.0f - kKneeError);
}

/// Gradients of luminance in x and y by the edge and by the point detector.
struct Features {
  FlipPlane edgeX, edgeY, pointX, pointY;

  Features(const FlipPlane& luminance, int halo, int rows, const FlipFilters& filters)
      : edgeX(luminance.width, rows),
        edgeY(luminance.width, rows),
        pointX(luminance.width, rows),
        pointY(luminance.width, rows) {
    addFiltered(luminance, halo, filters.edge, filters.smooth, edgeX);
    addFiltered(luminance, halo, filters.smooth, filters.edge, edgeY);
    addFiltered(luminance, halo, filters.point, filters.smooth, pointX);
    addFiltered(luminance, halo, filters.smooth, filters.point, pointY);
  }

  static float length(const FlipPlane& x, const FlipPlane& y, std::size_t i) {
    return std::sqrt(x.values[i] * x.values[i] + y.values[i] * y.values[i]);
  }
  float edge(std::size_t i) const { return length(edgeX, edgeY, i); }
  float point(std::size_t i) const { return length(pointX, pointY, i); }
};

// The greater of both detectors' differences, brought to [0, 1]: no gradient is longer than sqrt(2).
float featureError(const Features& reference, const Features& test, std::size_t i) {
  const float edges = std::abs(reference.edge(i) - test.edge(i));
  const float points = std::abs(reference.point(i) - test.point(i));
  return std::min(1.0f, std::pow(std::max(edges, points) / std::numbers::sqrt2_v<float>, kFeaturePower));
}

/// What is needed of one image for a range of rows.
struct Side {
  Opponent seen;
  Features features;

  static Side of(const ShownColour& shown, int width, int height, Rows rows, const FlipFilters& filters) {
    const int halo = std::max(filters.spatialRadius(), filters.featureRadius());
    const Opponent opponent = toOpponent(shown, width, height, rows, halo);
    return {asSeen(opponent, halo, rows.count(), filters), Features(opponent.luminance, halo, rows.count(), filters)};
  }
};

void fillRows(const Side& reference, const Side& test, float greatest, Rows rows, Image& map) {
  for (int row = 0; row < rows.count(); ++row) {
    for (int x = 0; x < map.width; ++x) {
      const std::size_t i =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(map.width) + static_cast<std::size_t>(x);
      const float distance = colourDistance(huntLabAt(reference.seen, x, row), huntLabAt(test.seen, x, row));
      const float colour = std::clamp(colourError(distance, greatest), 0.0f, 1.0f);
      map.at(x, rows.begin + row, 0) = std::pow(colour, 1.0f - featureError(reference.features, test.features, i));
    }
  }
}

}  // namespace

void fillFlipMap(const ShownColour& reference, const ShownColour& test, double pixelsPerDegree, const JobContext& job,
                 Image& map) {
  const FlipFilters filters(pixelsPerDegree);
  const float greatest = greatestColourDistance();
  base::parallelFor(job, static_cast<std::size_t>(map.height), kRowsAtOnce, [&](std::size_t begin, std::size_t end) {
    const Rows rows{static_cast<int>(begin), static_cast<int>(end)};
    fillRows(Side::of(reference, map.width, map.height, rows, filters),
             Side::of(test, map.width, map.height, rows, filters), greatest, rows, map);
  });
}

}  // namespace sward::image
