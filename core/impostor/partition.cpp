#include "impostor/partition.h"

#include "base/random.h"
#include "mesh/parts.h"

#include <algorithm>
#include <limits>
#include <string>
#include <unordered_map>

namespace sward::impostor {
namespace {

constexpr int kMostSteps = 60;
constexpr double kSmallPiece = 0.1;  ///< of the model's extent

/// What is clustered: a triangle of something large, or all of a small piece.
struct Piece {
  glm::dvec3 middle{0.0};
  double areaM2 = 0.0;
};
struct Pieces {
  std::vector<Piece> all;
  std::vector<std::uint32_t> ofTriangle;
};

struct Triangle {
  glm::dvec3 middle{0.0};
  double areaM2 = 0.0;
};
Triangle triangleOf(const mesh::Model& model, const glm::uvec3& corners) {
  const glm::dvec3 a(model.positions[corners.x]), b(model.positions[corners.y]), c(model.positions[corners.z]);
  return {(a + b + c) / 3.0, 0.5 * glm::length(glm::cross(b - a, c - a))};
}

/// Extent of each connected piece, by its name.
std::unordered_map<std::uint32_t, Box> boxesOf(const mesh::Model& model, const mesh::Parts& parts) {
  std::unordered_map<std::uint32_t, Box> boxes;
  for (std::size_t t = 0; t < model.triangles.size(); ++t) {
    for (int corner = 0; corner < 3; ++corner) {
      const glm::dvec3 p(model.positions[model.triangles[t][corner]]);
      const auto [found, isNew] = boxes.try_emplace(parts.ofTriangle[t], Box{p, p});
      if (isNew) continue;
      found->second.low = glm::min(found->second.low, p);
      found->second.high = glm::max(found->second.high, p);
    }
  }
  return boxes;
}

Pieces piecesOf(const mesh::Model& model) {
  const mesh::Parts parts = mesh::findParts(model);
  const mesh::Bounds bounds = mesh::bounds(model);
  const double small = kSmallPiece * static_cast<double>(glm::length(bounds.high - bounds.low));
  const auto boxes = boxesOf(model, parts);
  std::unordered_map<std::uint32_t, std::uint32_t> whole;  // a small piece's name to its number
  Pieces pieces;
  for (std::size_t t = 0; t < model.triangles.size(); ++t) {
    const Triangle triangle = triangleOf(model, model.triangles[t]);
    auto piece = static_cast<std::uint32_t>(pieces.all.size());
    if (boxes.at(parts.ofTriangle[t]).radius() * 2.0 < small) {
      piece = whole.try_emplace(parts.ofTriangle[t], piece).first->second;
    }
    if (piece == pieces.all.size()) pieces.all.emplace_back();
    pieces.all[piece].middle += triangle.areaM2 * triangle.middle;
    pieces.all[piece].areaM2 += triangle.areaM2;
    pieces.ofTriangle.push_back(piece);
  }
  for (std::size_t t = 0; t < model.triangles.size(); ++t) {
    Piece& piece = pieces.all[pieces.ofTriangle[t]];
    if (piece.areaM2 == 0.0) piece.middle = triangleOf(model, model.triangles[t]).middle;
  }
  for (Piece& piece : pieces.all) {
    if (piece.areaM2 > 0.0) piece.middle /= piece.areaM2;
  }
  return pieces;
}

double squaredDistance(const glm::dvec3& a, const glm::dvec3& b) {
  return glm::dot(a - b, a - b);
}

/// k-means++: each further centre is a piece chosen by area times squared distance to the centres before.
std::vector<glm::dvec3> firstCentres(const std::vector<Piece>& pieces, std::size_t count, base::Random& random) {
  std::vector<glm::dvec3> centres;
  std::vector<double> away(pieces.size(), std::numeric_limits<double>::infinity());
  std::size_t chosen = 0;
  while (centres.size() < count) {
    double sum = 0.0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (!centres.empty()) away[i] = std::min(away[i], squaredDistance(pieces[i].middle, centres.back()));
      sum += pieces[i].areaM2 * (centres.empty() ? 1.0 : away[i]);
    }
    if (!centres.empty() && !(sum > 0.0)) break;  // all pieces lie on centres
    double left = random.uniform() * sum;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const double weight = pieces[i].areaM2 * (centres.empty() ? 1.0 : away[i]);
      if (weight > 0.0) chosen = i;
      left -= weight;
      if (left < 0.0) break;
    }
    centres.push_back(pieces[chosen].middle);
  }
  return centres;
}

/// Lloyd's steps; clusters that lose all their pieces go.
std::vector<std::uint32_t> cluster(const std::vector<Piece>& pieces, std::vector<glm::dvec3>& centres) {
  std::vector<std::uint32_t> of(pieces.size(), 0);
  for (int step = 0; step < kMostSteps; ++step) {
    bool moved = step == 0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      std::uint32_t nearest = of[i];
      for (std::uint32_t c = 0; c < centres.size(); ++c) {
        if (squaredDistance(pieces[i].middle, centres[c]) < squaredDistance(pieces[i].middle, centres[nearest])) {
          nearest = c;
        }
      }
      moved = moved || nearest != of[i];
      of[i] = nearest;
    }
    if (!moved) break;
    std::vector<glm::dvec3> sums(centres.size(), glm::dvec3(0.0));
    std::vector<double> areas(centres.size(), 0.0);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      sums[of[i]] += pieces[i].areaM2 * pieces[i].middle;
      areas[of[i]] += pieces[i].areaM2;
    }
    for (std::size_t c = 0; c < centres.size(); ++c) {
      if (areas[c] > 0.0) centres[c] = sums[c] / areas[c];
    }
  }
  return of;
}

/// Numbers clusters in the order in which triangles use them, so that none is empty.
Partition numbered(const mesh::Model& model, const Pieces& pieces, const std::vector<std::uint32_t>& of,
                   const std::vector<glm::dvec3>& centres) {
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number(centres.size(), kNone);
  Partition out;
  double area = 0.0;
  for (std::size_t t = 0; t < model.triangles.size(); ++t) {
    const std::uint32_t from = of[pieces.ofTriangle[t]];
    if (number[from] == kNone) {
      number[from] = static_cast<std::uint32_t>(out.boxes.size());
      const glm::dvec3 first(model.positions[model.triangles[t].x]);
      out.boxes.push_back({first, first});
    }
    Box& box = out.boxes[number[from]];
    for (int corner = 0; corner < 3; ++corner) {
      const glm::dvec3 p(model.positions[model.triangles[t][corner]]);
      box.low = glm::min(box.low, p);
      box.high = glm::max(box.high, p);
    }
    out.ofTriangle.push_back(number[from]);
    const Triangle triangle = triangleOf(model, model.triangles[t]);
    out.spreadM2 += triangle.areaM2 * squaredDistance(triangle.middle, centres[from]);
    area += triangle.areaM2;
  }
  if (area > 0.0) out.spreadM2 /= area;
  return out;
}

}  // namespace

Result<Partition> partition(const mesh::Model& model, int parts, std::uint64_t seed) {
  if (parts < 1 || parts > 4096) {
    return Error::badInput(std::to_string(parts) + " parts", "impostor planes", "Give 1 to 4096");
  }
  if (model.empty()) return Partition{};
  const Pieces pieces = piecesOf(model);
  base::Random random(base::mix64(seed, 0x7061727473));
  std::vector<glm::dvec3> centres = firstCentres(pieces.all, static_cast<std::size_t>(parts), random);
  const std::vector<std::uint32_t> of = cluster(pieces.all, centres);
  return numbered(model, pieces, of, centres);
}

}  // namespace sward::impostor
