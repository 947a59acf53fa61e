#include "trace/tiled_ground.h"

#include "trace/fast_floor.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace sward::trace {
namespace {

/// What the arithmetic of walks and the bits of a reach bear.
constexpr int kMaxTexels = 1 << 15;
constexpr int kMaxReach = 63;  ///< fits TiledGround::Texel

Error badPlan(const std::string& what) {
  return Error::badInput(what, "ground plan", "Make it of a baked ground (bake::groundPlan).");
}

std::int64_t floorModulo(std::int64_t value, std::int64_t period) {
  const std::int64_t rest = value % period;
  return rest < 0 ? rest + period : rest;
}
int wrapped(std::int64_t value, int period) {
  return static_cast<int>(floorModulo(value, period));
}

Result<void> checkPlan(const GroundPlan& plan) {
  if (!std::isfinite(plan.patchSideM) || plan.patchSideM <= 0.0) return badPlan("the patch has no size");
  const auto fits = [](int n) { return n >= 1 && n <= kMaxTexels; };
  if (!fits(plan.patchTexels) || !fits(plan.tileTexels) || !fits(plan.mapWidth) || !fits(plan.mapHeight)) {
    return badPlan("a number of texels or cells is not in 1 to " + std::to_string(kMaxTexels));
  }
  const std::size_t tileArea = static_cast<std::size_t>(plan.tileTexels) * static_cast<std::size_t>(plan.tileTexels);
  const std::size_t cells = static_cast<std::size_t>(plan.mapWidth) * static_cast<std::size_t>(plan.mapHeight);
  if (plan.owner.size() != plan.offsets.size() * tileArea || plan.map.size() != cells) {
    return badPlan("owners or map have not the length that tiles and cells ask for");
  }
  if (std::any_of(plan.owner.begin(), plan.owner.end(), [](std::uint8_t edge) { return edge > 3; })) {
    return badPlan("a texel is owned by an edge that a tile has not");
  }
  if (std::any_of(plan.map.begin(), plan.map.end(), [&](std::uint8_t tile) { return tile >= plan.offsets.size(); })) {
    return badPlan("the map names a tile that there is not");
  }
  return {};
}

}  // namespace

Result<TiledGround> TiledGround::create(const GroundPlan& plan, const scene::Patch& patch) {
  SWARD_TRY(checkPlan(plan));
  TiledGround ground;
  ground.m_texelM = plan.patchSideM / plan.patchTexels;
  ground.m_patchTexels = plan.patchTexels;
  ground.m_tileTexels = plan.tileTexels;
  ground.m_mapWidth = plan.mapWidth;
  ground.m_mapHeight = plan.mapHeight;
  ground.m_tileModPatch = plan.tileTexels % plan.patchTexels;
  for (const auto& offsets : plan.offsets) {
    for (const glm::ivec2& offset : offsets) {
      ground.m_offsets.emplace_back(wrapped(offset.x, plan.patchTexels), wrapped(offset.y, plan.patchTexels));
    }
  }
  ground.m_map = plan.map;
  const HeightField heights(patch, plan.patchTexels);
  ground.m_heightUnit = heights.unitM();
  for (int quadrant = 0; quadrant < 4; ++quadrant) ground.look(plan, heights, quadrant);
  return ground;
}

// The largest square of one piece ahead of a texel is one larger than the least of those of its three neighbours ahead,
// where they belong to the same piece; squares stay within their tile.
void TiledGround::look(const GroundPlan& plan, const HeightField& heights, int quadrant) {
  const int side = m_tileTexels;
  const int dx = (quadrant & 1) != 0 ? -1 : 1, dy = (quadrant & 2) != 0 ? -1 : 1;
  Texels& texels = m_quadrants[static_cast<std::size_t>(quadrant)];
  texels.resize(plan.owner.size());
  const auto at = [&](std::size_t tile, int x, int y) {
    return (tile * static_cast<std::size_t>(side) + static_cast<std::size_t>(y)) * static_cast<std::size_t>(side) +
           static_cast<std::size_t>(x);
  };
  for (std::size_t tile = 0; tile < m_offsets.size() / 4; ++tile) {
    const auto offsetOf = [&](std::size_t texel) { return m_offsets[tile * 4 + plan.owner[texel]]; };
    for (int j = side - 1; j >= 0; --j) {
      for (int i = side - 1; i >= 0; --i) {
        const int x = dx > 0 ? i : side - 1 - i, y = dy > 0 ? j : side - 1 - j;
        const std::size_t here = at(tile, x, y);
        const glm::ivec2 offset = offsetOf(here);
        int reach = 0;
        if (i + 1 < side && j + 1 < side) {
          const std::array ahead{at(tile, x + dx, y), at(tile, x, y + dy), at(tile, x + dx, y + dy)};
          if (std::all_of(ahead.begin(), ahead.end(), [&](std::size_t t) { return offsetOf(t) == offset; })) {
            const auto reachOf = [&](std::size_t n) -> int { return texels[ahead[n]].reach; };
            reach = std::min(1 + std::min({reachOf(0), reachOf(1), reachOf(2)}), kMaxReach);
          }
        }
        const int cornerX = dx > 0 ? x : x - reach, cornerY = dy > 0 ? y : y - reach;
        texels[here].edge = plan.owner[here] & 3u;
        texels[here].reach = static_cast<std::uint8_t>(reach) & 63u;
        texels[here].top = heights.over(wrapped(cornerX + offset.x, m_patchTexels),
                                        wrapped(cornerY + offset.y, m_patchTexels), reach + 1);
      }
    }
  }
}

TiledGround::Site TiledGround::siteOf(std::int64_t x, std::int64_t y) const {
  Site site;
  site.x = wrapped(x, m_tileTexels);
  site.y = wrapped(y, m_tileTexels);
  site.baseX = wrapped(x - site.x, m_patchTexels);
  site.baseY = wrapped(y - site.y, m_patchTexels);
  site.cellX = wrapped((x - site.x) / m_tileTexels + m_mapWidth / 2, m_mapWidth);
  site.cellY = wrapped((y - site.y) / m_tileTexels + m_mapHeight / 2, m_mapHeight);
  site.tile = tileOf(site);
  return site;
}

glm::ivec2 TiledGround::shiftAt(std::int64_t x, std::int64_t y) const {
  const Site site = siteOf(x, y);
  const glm::ivec2 offset = m_offsets[site.tile * 4 + m_quadrants[0][texelIndex(site)].edge];
  return {wrapped(offset.x - site.baseX, m_patchTexels), wrapped(offset.y - site.baseY, m_patchTexels)};
}

GroundWalk::GroundWalk(const TiledGround& ground, const glm::dvec3& origin, const glm::dvec3& direction, double end)
    : m_ground(&ground) {
  start(origin, direction, end);
  const std::size_t quadrant = (m_x.direction < 0.0 ? 1u : 0u) + (m_y.direction < 0.0 ? 2u : 0u);
  m_texels = ground.m_quadrants[quadrant].data();
  m_site = ground.siteOf(m_x.texel, m_y.texel);
  look();
}

GroundWalk::GroundWalk(const TiledGround& ground, const glm::dvec3& origin, const glm::dvec3& direction, double end,
                       const glm::ivec2& shift)
    : m_ground(&ground), m_offset(shift) {
  start(origin, direction, end);
  m_texel.top = HeightField::kSteps;
}

void GroundWalk::start(const glm::dvec3& origin, const glm::dvec3& direction, double end) {
  const double texels = 1.0 / m_ground->texelM();
  const auto axis = [&](double from, double along) {
    Axis out;
    out.origin = from * texels;
    // So little that no border is ever reached, and its inverse no number: along the other axis.
    const double narrow = along * texels;
    if (std::isfinite(1.0 / narrow)) {
      out.direction = narrow;
      out.inverse = 1.0 / narrow;
    }
    out.texel = floorOf(out.origin);
    return out;
  };
  m_x = axis(origin.x, direction.x);
  m_y = axis(origin.y, direction.y);
  m_z = origin.z;
  m_slope = direction.z;
  m_end = end;
}

// Reads the texel where the walk is.
void GroundWalk::look() {
  m_texel = m_texels[m_ground->texelIndex(m_site)];
  m_offset = m_ground->m_offsets[m_site.tile * 4 + m_texel.edge];
}

// Of the texel where the walk is, in [0, patch).
glm::ivec2 GroundWalk::shiftHere() const {
  const int patch = m_ground->m_patchTexels;
  glm::ivec2 shift{m_offset.x - m_site.baseX, m_offset.y - m_site.baseY};
  if (shift.x < 0) shift.x += patch;
  if (shift.y < 0) shift.y += patch;
  return shift;
}

glm::ivec2 GroundWalk::shift() const {
  const int patch = m_ground->m_patchTexels;
  return {wrapped(m_piece.patchX - m_piece.x, patch), wrapped(m_piece.patchY - m_piece.y, patch)};
}

void GroundWalk::moveSite(std::int64_t dx, std::int64_t dy) {
  const TiledGround& ground = *m_ground;
  // Never further than to the neighbouring tile.
  const auto move = [&](int& within, int& cell, int& base, std::int64_t by, int cells) {
    within += static_cast<int>(by);
    if (within < 0) {
      within += ground.m_tileTexels;
      cell = cell == 0 ? cells - 1 : cell - 1;
      base -= ground.m_tileModPatch;
      if (base < 0) base += ground.m_patchTexels;
      return true;
    }
    if (within >= ground.m_tileTexels) {
      within -= ground.m_tileTexels;
      cell = cell + 1 == cells ? 0 : cell + 1;
      base += ground.m_tileModPatch;
      if (base >= ground.m_patchTexels) base -= ground.m_patchTexels;
      return true;
    }
    return false;
  };
  const bool leftX = move(m_site.x, m_site.cellX, m_site.baseX, dx, ground.m_mapWidth);
  const bool leftY = move(m_site.y, m_site.cellY, m_site.baseY, dy, ground.m_mapHeight);
  if (leftX || leftY) m_site.tile = ground.tileOf(m_site);
}

// To the texel behind a border of one axis, met at t, which lies at most `reach` texels ahead on either axis.
void GroundWalk::step(bool alongX, double t, int reach) {
  Axis& crossed = alongX ? m_x : m_y;
  Axis& other = alongX ? m_y : m_x;
  const std::int64_t from = crossed.texel, otherFrom = other.texel;
  // The border's own number, not the place's, which rounding may have put on either side.
  const std::int64_t border = floorOf(crossed.at(t) + 0.5);
  crossed.texel = crossed.direction > 0.0 ? border : border - 1;
  other.texel = std::clamp<std::int64_t>(floorOf(other.at(t)), other.direction > 0.0 ? otherFrom : otherFrom - reach,
                                         other.direction > 0.0 ? otherFrom + reach : otherFrom);
  if (m_texels == nullptr) return;
  const std::int64_t moved = crossed.texel - from, otherMoved = other.texel - otherFrom;
  moveSite(alongX ? moved : otherMoved, alongX ? otherMoved : moved);
  look();
}

GroundWalk::Piece GroundWalk::beginPiece() const {
  const int patch = m_ground->m_patchTexels;
  Piece piece;
  piece.x = m_x.texel;
  piece.y = m_y.texel;
  if (m_texels != nullptr) {
    piece.patchX = m_site.x + m_offset.x;
    piece.patchY = m_site.y + m_offset.y;
    if (piece.patchX >= patch) piece.patchX %= patch;
    if (piece.patchY >= patch) piece.patchY %= patch;
  } else {
    piece.patchX = wrapped(m_x.texel + m_offset.x, patch);
    piece.patchY = wrapped(m_y.texel + m_offset.y, patch);
  }
  piece.borderX = m_x.leaves(m_x.direction > 0.0 ? patch - 1 - piece.patchX : piece.patchX);
  piece.borderY = m_y.leaves(m_y.direction > 0.0 ? patch - 1 - piece.patchY : piece.patchY);
  return piece;
}

bool GroundWalk::next(WalkSegment& out) {
  while (m_t < m_end && ++m_pieces <= kMaxPieces) {
    m_piece = beginPiece();
    if (walkPiece(m_piece, out)) return true;
  }
  return false;
}

// Walks over one piece; false where the ray passes above everything on it.
bool GroundWalk::walkPiece(const Piece& piece, WalkSegment& out) {
  const int patch = m_ground->m_patchTexels;
  const double border = std::min(piece.borderX, piece.borderY), last = std::min(border, m_end);
  const glm::ivec2 shift = shiftHere();
  double from = kNever, to = 0.0;  // of what is not above everything
  while (true) {
    const int reach = m_texels != nullptr ? m_texel.reach : patch;
    const double leavesX = m_x.leaves(reach), leavesY = m_y.leaves(reach);
    const double leaves = std::min(leavesX, leavesY), stop = std::min(leaves, last);
    const double lowest = m_z + m_slope * (m_slope < 0.0 ? stop : m_t);
    if (lowest <= m_texel.top * m_ground->m_heightUnit) {
      from = std::min(from, m_t);
      to = stop;
    }
    m_t = std::max(stop, m_t);
    if (leaves >= last) {
      if (last < m_end) step(piece.borderX <= piece.borderY, last, reach);
      break;
    }
    step(leavesX <= leavesY, leaves, reach);
    if (shiftHere() != shift) break;
  }
  if (from > to) return false;
  const auto texel = static_cast<float>(m_ground->m_texelM);
  const auto place = [&](const Axis& axis, std::int64_t world, int onPatch) {
    const double within = axis.at(from) - static_cast<double>(world);
    return std::clamp(static_cast<float>(onPatch + within), 0.0f, static_cast<float>(patch)) * texel;
  };
  out.origin = {place(m_x, piece.x, piece.patchX), place(m_y, piece.y, piece.patchY),
                static_cast<float>(m_z + from * m_slope)};
  out.start = from;
  out.length = static_cast<float>(to - from);
  return true;
}

}  // namespace sward::trace
