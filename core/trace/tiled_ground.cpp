#include "trace/tiled_ground.h"

#include "trace/fast_floor.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace sward::trace {
namespace {

/// What the arithmetic of walks and the 16 bits of a clearance bear.
constexpr int kMaxTexels = 1 << 15;

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

Result<TiledGround> TiledGround::create(const GroundPlan& plan) {
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
  ground.m_texels.resize(plan.owner.size());
  for (std::size_t i = 0; i < plan.owner.size(); ++i) ground.m_texels[i].edge = plan.owner[i];
  ground.measureClearance();
  return ground;
}

// Chessboard distance to the nearest texel of another piece or tile, in two passes: on the way to that texel lies a
// neighbour of the own piece that is one step nearer.
void TiledGround::measureClearance() {
  const int side = m_tileTexels;
  const auto at = [&](std::size_t tile, int x, int y) -> Texel& {
    return m_texels[(tile * static_cast<std::size_t>(side) + static_cast<std::size_t>(y)) *
                        static_cast<std::size_t>(side) +
                    static_cast<std::size_t>(x)];
  };
  for (std::size_t tile = 0; tile < m_offsets.size() / 4; ++tile) {
    const auto relax = [&](int x, int y, int dx, int dy) {
      Texel& here = at(tile, x, y);
      const int nx = x + dx, ny = y + dy;
      const bool inside = nx >= 0 && ny >= 0 && nx < side && ny < side;
      const bool same = inside && m_offsets[tile * 4 + at(tile, nx, ny).edge] == m_offsets[tile * 4 + here.edge];
      const int allowed = same ? at(tile, nx, ny).clearance + 1 : 0;
      here.clearance = static_cast<std::uint16_t>(std::min<int>(here.clearance, allowed));
    };
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        at(tile, x, y).clearance = static_cast<std::uint16_t>(side);
        for (const auto& [dx, dy] : {std::pair{-1, -1}, {0, -1}, {1, -1}, {-1, 0}}) relax(x, y, dx, dy);
      }
    }
    for (int y = side - 1; y >= 0; --y) {
      for (int x = side - 1; x >= 0; --x) {
        for (const auto& [dx, dy] : {std::pair{1, 1}, {0, 1}, {-1, 1}, {1, 0}}) relax(x, y, dx, dy);
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
  return site;
}

glm::ivec2 TiledGround::shiftAt(const Site& site) const {
  const std::size_t tile = tileOf(site);
  glm::ivec2 shift = m_offsets[tile * 4 + texelOf(site, tile).edge];
  shift.x -= site.baseX;
  shift.y -= site.baseY;
  if (shift.x < 0) shift.x += m_patchTexels;
  if (shift.y < 0) shift.y += m_patchTexels;
  return shift;
}

GroundWalk::GroundWalk(const TiledGround& ground, const glm::dvec3& origin, const glm::dvec3& direction, double end) {
  start(ground, origin, direction, end);
  m_site = ground.siteOf(m_x.texel, m_y.texel);
  m_shift = ground.shiftAt(m_site);
  m_texel = ground.texelOf(m_site, ground.tileOf(m_site));
}

GroundWalk::GroundWalk(const TiledGround& ground, const glm::dvec3& origin, const glm::dvec3& direction, double end,
                       const glm::ivec2& shift) {
  start(ground, origin, direction, end);
  m_periodic = true;
  m_shift = shift;
}

void GroundWalk::start(const TiledGround& ground, const glm::dvec3& origin, const glm::dvec3& direction, double end) {
  const double texels = 1.0 / ground.texelM();
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

void GroundWalk::moveSite(const TiledGround& ground, std::int64_t dx, std::int64_t dy) {
  // Never further than to the neighbouring tile.
  const auto move = [&](int& within, int& cell, int& base, std::int64_t by, int cells) {
    within += static_cast<int>(by);
    if (within < 0) {
      within += ground.m_tileTexels;
      cell = cell == 0 ? cells - 1 : cell - 1;
      base -= ground.m_tileModPatch;
      if (base < 0) base += ground.m_patchTexels;
    } else if (within >= ground.m_tileTexels) {
      within -= ground.m_tileTexels;
      cell = cell + 1 == cells ? 0 : cell + 1;
      base += ground.m_tileModPatch;
      if (base >= ground.m_patchTexels) base -= ground.m_patchTexels;
    }
  };
  move(m_site.x, m_site.cellX, m_site.baseX, dx, ground.m_mapWidth);
  move(m_site.y, m_site.cellY, m_site.baseY, dy, ground.m_mapHeight);
}

// To the texel behind a border of one axis, met at t, which lies no further than `reach` texels away on either axis.
void GroundWalk::step(const TiledGround& ground, bool alongX, double t, int reach) {
  Axis& crossed = alongX ? m_x : m_y;
  Axis& other = alongX ? m_y : m_x;
  const std::int64_t from = crossed.texel, otherFrom = other.texel;
  const double place = crossed.origin + t * crossed.direction;
  // The border's own number, not the place's, which rounding may have put on either side.
  const std::int64_t border = floorOf(place + 0.5);
  crossed.texel = crossed.direction > 0.0 ? border : border - 1;
  other.texel = std::clamp<std::int64_t>(floorOf(other.origin + t * other.direction),
                                         other.direction > 0.0 ? otherFrom : otherFrom - reach,
                                         other.direction > 0.0 ? otherFrom + reach : otherFrom);
  if (m_periodic) return;
  const std::int64_t moved = crossed.texel - from, otherMoved = other.texel - otherFrom;
  moveSite(ground, alongX ? moved : otherMoved, alongX ? otherMoved : moved);
}

bool GroundWalk::next(const TiledGround& ground, WalkSegment& out) {
  if (!(m_t < m_end) || ++m_segments > kMaxSegments) return false;
  const int patch = ground.m_patchTexels;
  if (!m_periodic) m_shift = ground.shiftAt(m_site);
  const int px = wrapped(m_x.texel + m_shift.x, patch), py = wrapped(m_y.texel + m_shift.y, patch);
  const auto texel = static_cast<float>(ground.m_texelM);
  const auto place = [&](const Axis& axis, int onPatch) {
    const double within = axis.origin + m_t * axis.direction - static_cast<double>(axis.texel);
    return std::clamp(static_cast<float>(onPatch + within), 0.0f, static_cast<float>(patch)) * texel;
  };
  out.origin = {place(m_x, px), place(m_y, py), static_cast<float>(m_z + m_t * m_slope)};
  out.start = m_t;
  // The patch's own border ends a segment, too.
  const double borderX = m_x.leaves(m_x.direction > 0.0 ? patch - 1 - px : px);
  const double borderY = m_y.leaves(m_y.direction > 0.0 ? patch - 1 - py : py);
  const double border = std::min(borderX, borderY);
  const double last = std::min(border, m_end);
  while (true) {
    const int reach = m_periodic ? patch : m_texel.clearance;
    const double leavesX = m_x.leaves(reach), leavesY = m_y.leaves(reach);
    const double leaves = std::min(leavesX, leavesY);
    if (leaves >= last) {
      m_t = last;
      if (last < m_end) step(ground, borderX <= borderY, last, reach);
      break;
    }
    step(ground, leavesX <= leavesY, leaves, reach);
    const std::size_t tile = ground.tileOf(m_site);
    m_texel = ground.texelOf(m_site, tile);
    if (ground.shiftAt(m_site) != m_shift) {
      m_t = leaves;
      break;
    }
  }
  if (!m_periodic) m_texel = ground.texelOf(m_site, ground.tileOf(m_site));
  m_t = std::max(m_t, out.start);
  out.length = static_cast<float>(m_t - out.start);
  return true;
}

}  // namespace sward::trace
