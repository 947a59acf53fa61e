// Layer samples without rays: every triangle is held against the sub-samples that its outline on the image may cover,
// and each sub-sample keeps the nearest, as a z-buffer does, one for every slab.
#include "base/parallel.h"
#include "trace/fast_floor.h"
#include "trace/triangle_field.h"

#include <atomic>
#include <bit>
#include <cmath>

namespace sward::trace {
namespace {

constexpr std::uint64_t kNothing = ~std::uint64_t{0};
constexpr std::size_t kPartGrain = 32;

/// A triangle seen along an axis of the world: a along an image's rows, b across them, d along the axis; metres.
struct FlatTriangle {
  std::array<float, 3> a, b, d;
};

/// Least and greatest of three.
struct Extent {
  float low, high;
  Extent(float least, float most) : low(least), high(most) {}
  explicit Extent(const std::array<float, 3>& v)
      : low(std::min(v[0], std::min(v[1], v[2]))), high(std::max(v[0], std::max(v[1], v[2]))) {}
};

/// Extent of `values` over the part of a triangle whose `along` lies in [from, to], or a little more; all of it where
/// the triangle only touches that.
Extent extentWithin(const std::array<float, 3>& along, const std::array<float, 3>& values, float from, float to,
                    float slack) {
  const Extent all(values);
  float least = all.high, most = all.low;
  const auto include = [&](float value) {
    least = std::min(least, value);
    most = std::max(most, value);
  };
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t n = k == 2 ? 0 : k + 1;
    if (along[k] >= from && along[k] <= to) include(values[k]);
    for (const float border : {from, to}) {
      if ((along[k] < border) == (along[n] < border)) continue;
      include(values[k] + (border - along[k]) / (along[n] - along[k]) * (values[n] - values[k]));
    }
  }
  if (least > most) return all;
  return {std::max(all.low, least - slack), std::min(all.high, most + slack)};
}

struct Point {
  float u, v, d;  ///< barycentric, and along the axis
};

/// Points against a triangle.
class Inside {
 public:
  explicit Inside(const FlatTriangle& f)
      : m_f(f), m_a1(f.a[1] - f.a[0]), m_a2(f.a[2] - f.a[0]), m_b1(f.b[1] - f.b[0]), m_b2(f.b[2] - f.b[0]) {
    m_inverse = 1.0f / (m_a1 * m_b2 - m_b1 * m_a2);
  }
  /// Seen edge-on, it covers no point.
  bool empty() const { return !std::isfinite(m_inverse); }
  bool operator()(float a, float b, Point& point) const {
    const float da = a - m_f.a[0], db = b - m_f.b[0];
    point.u = (da * m_b2 - db * m_a2) * m_inverse;
    point.v = (m_a1 * db - m_b1 * da) * m_inverse;
    // One comparison that is seldom true, since three that are half the time cost more by wrong guesses than all else.
    if (!(std::min(std::min(point.u, point.v), 1.0f - (point.u + point.v)) >= 0.0f)) return false;
    point.d = m_f.d[0] + point.u * (m_f.d[1] - m_f.d[0]) + point.v * (m_f.d[2] - m_f.d[0]);
    return true;
  }

 private:
  const FlatTriangle& m_f;
  float m_a1, m_a2, m_b1, m_b2, m_inverse;
};

/// One layer set: its samples and what they found.
class View {
 public:
  View(LayerSet set, const TriangleField& field, const SamplingOptions& options, const LayerHits& out, int a, int b,
       int axis);

  /// Holds the triangle against the samples of every slab that it reaches.
  void cover(const FlatTriangle& flat, const Inside& inside, const TriangleField::Part& part, std::uint32_t triangle);
  /// Replaces the hits; visitPlaces(triangle, visit) as AxisPass::forPlaces.
  template <typename VisitPlaces>
  void pack(const TriangleField& field, const VisitPlaces& visitPlaces, LayerHits& out) const;

 private:
  struct Sample {
    float a, b;
  };
  std::size_t index(int layer, int y, int x, int subSample) const {
    const auto row =
        static_cast<std::size_t>(layer) * static_cast<std::size_t>(m_shape.height) + static_cast<std::size_t>(y);
    return (row * static_cast<std::size_t>(m_shape.width) + static_cast<std::size_t>(x)) *
               static_cast<std::size_t>(m_subSamples) +
           static_cast<std::size_t>(subSample);
  }
  std::uint64_t bitsOf(int layer, int y, int x, int subSample) const {
    const auto column = static_cast<std::size_t>(y * m_shape.width + x);
    return m_pattern.bitsOf(m_pattern.columnSeed(column), layer, subSample);
  }
  struct Cells {
    int x0, x1, y0, y1;
  };
  Cells cellsOf(const Extent& a, const Extent& b) const;
  void coverLayer(int layer, const Cells& cells, const Inside& inside, const TriangleField::Part& part,
                  std::uint32_t triangle);
  void keep(std::size_t sample, float t, std::uint32_t triangle);

  LayerShape m_shape;
  int m_subSamples;
  SamplePattern m_pattern;
  float m_cellsA, m_cellsB;  ///< a metre
  float m_layersPerMetre;
  std::vector<float> m_borders;  ///< of the slabs along the rays
  float m_sign, m_offset;        ///< distance along the rays = sign * d + offset
  std::vector<Sample> m_samples;
  /// Distance (the bits of a positive float are ordered like it) and number of the triangle: the least wins, whatever
  /// the order in which threads come.
  std::vector<std::uint64_t> m_found;
};

View::View(LayerSet set, const TriangleField& field, const SamplingOptions& options, const LayerHits& out, int a, int b,
           int axis)
    : m_shape(out.shape),
      m_subSamples(out.subSamples),
      m_pattern(set, static_cast<float>(field.patch().sideM), static_cast<float>(field.patch().heightM), out.shape,
                out.subSamples, options.seed),
      m_cellsA(static_cast<float>(m_shape.width) / glm::length(m_pattern.rays().uAxis)),
      m_cellsB(static_cast<float>(m_shape.height) / glm::length(m_pattern.rays().vAxis)),
      m_layersPerMetre(static_cast<float>(m_shape.layers) / m_pattern.rays().depth),
      m_sign(m_pattern.rays().direction[axis]),
      m_offset(-m_pattern.rays().origin[axis] * m_sign) {
  for (int layer = 0; layer <= m_shape.layers; ++layer) {
    m_borders.push_back(m_pattern.rays().border(layer, m_shape.layers));
  }
  m_samples.resize(index(m_shape.layers, 0, 0, 0));
  m_found.assign(m_samples.size(), kNothing);
  for (int y = 0; y < m_shape.height; ++y) {
    for (int x = 0; x < m_shape.width; ++x) {
      for (int layer = 0; layer < m_shape.layers; ++layer) {
        for (int s = 0; s < m_subSamples; ++s) {
          const glm::vec3 origin = m_pattern.originOf(x, y, s, bitsOf(layer, y, x, s));
          m_samples[index(layer, y, x, s)] = {origin[a], origin[b]};
        }
      }
    }
  }
}

void View::cover(const FlatTriangle& flat, const Inside& inside, const TriangleField::Part& part,
                 std::uint32_t triangle) {
  const SetRays& rays = m_pattern.rays();
  const Extent d(flat.d), a(flat.a), b(flat.b);
  const float t0 = m_sign * d.low + m_offset, t1 = m_sign * d.high + m_offset;
  const float slack = 16.0f * rays.rounding;  // the exact borders are asked for each point
  const auto layerAt = [&](float at) {
    return std::clamp(floorOf((at - rays.lead) * m_layersPerMetre), 0, m_shape.layers - 1);
  };
  const int first = layerAt(std::min(t0, t1) - slack), last = layerAt(std::max(t0, t1) + slack);
  const Cells all = cellsOf(a, b);
  // A long blade that leans through several slabs covers few of its cells in each. For a few, asking costs less.
  constexpr int kFew = 8;
  const bool clip = first != last && (all.x1 - all.x0 + 1) * (all.y1 - all.y0 + 1) * m_subSamples > kFew;
  for (int layer = first; layer <= last; ++layer) {
    if (!clip) {
      coverLayer(layer, all, inside, part, triangle);
      continue;
    }
    const auto l = static_cast<std::size_t>(layer);
    const float one = (m_borders[l] - slack - m_offset) * m_sign,
                other = (m_borders[l + 1] + slack - m_offset) * m_sign;
    const float from = std::min(one, other), to = std::max(one, other);
    coverLayer(layer,
               cellsOf(extentWithin(flat.d, flat.a, from, to, slack), extentWithin(flat.d, flat.b, from, to, slack)),
               inside, part, triangle);
  }
}

View::Cells View::cellsOf(const Extent& a, const Extent& b) const {
  const auto cell = [](float v, int count) { return std::clamp(floorOf(v), 0, count - 1); };
  return {cell(a.low * m_cellsA, m_shape.width), cell(a.high * m_cellsA, m_shape.width),
          cell(b.low * m_cellsB, m_shape.height), cell(b.high * m_cellsB, m_shape.height)};
}

void View::coverLayer(int layer, const Cells& cells, const Inside& inside, const TriangleField::Part& part,
                      std::uint32_t triangle) {
  const float start = m_borders[static_cast<std::size_t>(layer)], end = m_borders[static_cast<std::size_t>(layer) + 1];
  for (int y = cells.y0; y <= cells.y1; ++y) {
    const std::size_t first = index(layer, y, cells.x0, 0), after = index(layer, y, cells.x1 + 1, 0);
    for (std::size_t sample = first; sample < after; ++sample) {
      Point point;
      if (!inside(m_samples[sample].a, m_samples[sample].b, point)) continue;
      const float t = m_sign * point.d + m_offset;
      if (t < start || t > end) continue;
      if (part.alpha) {
        const auto offset = static_cast<int>(sample - first);
        const std::uint64_t bits = bitsOf(layer, y, cells.x0 + offset / m_subSamples, offset % m_subSamples);
        const std::uint32_t own = triangle - part.firstTriangle;
        const std::uint64_t chance = base::mix64(SamplePattern::rayId(bits), part.instance, own);
        if (!(base::unitFloat(chance) < mesh::alphaAt(*part.model, own, point.u, point.v))) continue;
      }
      keep(sample, t, triangle);
    }
  }
}

void View::keep(std::size_t sample, float t, std::uint32_t triangle) {
  const std::uint64_t mine = std::uint64_t{std::bit_cast<std::uint32_t>(t)} << 32 | triangle;
  std::atomic_ref<std::uint64_t> nearest(m_found[sample]);
  std::uint64_t held = nearest.load(std::memory_order_relaxed);
  while (mine < held && !nearest.compare_exchange_weak(held, mine, std::memory_order_relaxed)) {
  }
}

template <typename VisitPlaces>
void View::pack(const TriangleField& field, const VisitPlaces& visitPlaces, LayerHits& out) const {
  /// The kept hit again, with its barycentric coordinates.
  const auto rawHit = [&](std::size_t sample) {
    const auto triangle = static_cast<std::uint32_t>(m_found[sample]);
    const TriangleField::Part& part = field.partOf(triangle);
    RawHit kept{std::bit_cast<float>(static_cast<std::uint32_t>(m_found[sample] >> 32)),
                0.0f,
                0.0f,
                {part.instance, triangle - part.firstTriangle}};
    visitPlaces(part, part.model->triangles[kept.surface.triangle], [&](const FlatTriangle& flat) {
      Point point;
      if (!Inside(flat)(m_samples[sample].a, m_samples[sample].b, point) || m_sign * point.d + m_offset != kept.t)
        return;
      kept.u = point.u;
      kept.v = point.v;
    });
    return kept;
  };
  out.columnStart.assign(1, 0);
  out.hitStart.assign(1, 0);
  for (int y = 0; y < m_shape.height; ++y) {
    for (int x = 0; x < m_shape.width; ++x) {
      for (int layer = 0; layer < m_shape.layers; ++layer) {
        const std::size_t before = out.hits.size();
        for (int s = 0; s < m_subSamples; ++s) {
          const std::size_t sample = index(layer, y, x, s);
          if (m_found[sample] == kNothing) continue;
          out.hits.push_back(m_pattern.finish(field.patch(), rawHit(sample), x, y, layer, s));
        }
        if (out.hits.size() == before) continue;
        out.layer.push_back(static_cast<std::uint8_t>(layer));
        out.hitStart.push_back(static_cast<std::uint32_t>(out.hits.size()));
      }
      out.columnStart.push_back(static_cast<std::uint32_t>(out.layer.size()));
    }
  }
}

/// The layer sets that look along one axis: the slices, or the blades of both sides.
class AxisPass {
 public:
  AxisPass(std::vector<LayerSet> sets, const TriangleField& field, const SamplingOptions& options,
           std::span<LayerHits> all)
      : m_field(field),
        m_sets(std::move(sets)),
        m_slices(m_sets.front() == LayerSet::Slices),
        m_a(m_sets.front() == LayerSet::BladesPosX ? 1 : 0),
        m_b(m_slices ? 1 : 2),
        m_axis(m_slices ? 2 : 1 - m_a),
        m_side(static_cast<float>(field.patch().sideM)),
        m_patchesPerMetre(1.0f / m_side) {
    for (const LayerSet set : m_sets) m_views.emplace_back(set, field, options, hitsOf(all, set), m_a, m_b, m_axis);
  }

  void cover(const TriangleField::Part& part) {
    std::uint32_t triangle = part.firstTriangle;
    for (const glm::uvec3& corner : part.model->triangles) {
      forPlaces(part, corner, [&](const FlatTriangle& flat) { coverPlace(flat, part, triangle); });
      ++triangle;
    }
  }
  void pack(std::span<LayerHits> all, std::size_t view) const {
    m_views[view].pack(
        m_field, [this](const auto& part, const auto& corner, const auto& visit) { forPlaces(part, corner, visit); },
        hitsOf(all, m_sets[view]));
  }
  std::size_t views() const { return m_views.size(); }

 private:
  static LayerHits& hitsOf(std::span<LayerHits> all, LayerSet set) { return all[static_cast<std::size_t>(set)]; }

  /// Calls visit(moved triangle) for every place, whole patches apart, at which it may be seen in the images.
  template <typename Visit>
  void forPlaces(const TriangleField::Part& part, const glm::uvec3& corner, const Visit& visit) const {
    const glm::vec3* vertices = m_field.positions().data() + part.firstVertex;
    FlatTriangle flat;
    for (int k = 0; k < 3; ++k) {
      const glm::vec3& p = vertices[corner[k]];
      const auto i = static_cast<std::size_t>(k);
      flat.a[i] = p[m_a];
      flat.b[i] = p[m_b];
      flat.d[i] = p[m_axis];
    }
    // Periodic are x and y: the image's axes in slices, one of them and the rays' in blades.
    const Extent a(flat.a), c(m_slices ? flat.b : flat.d);
    if (a.low >= 0.0f && c.low >= 0.0f && a.high < m_side && c.high < m_side) return visit(flat);
    const auto patchOf = [this](float v) { return floorOf(v * m_patchesPerMetre); };
    for (int i = patchOf(a.low); i <= patchOf(a.high); ++i) {
      for (int j = patchOf(c.low); j <= patchOf(c.high); ++j) {
        FlatTriangle moved = flat;
        for (std::size_t k = 0; k < 3; ++k) {
          moved.a[k] -= static_cast<float>(i) * m_side;
          (m_slices ? moved.b : moved.d)[k] -= static_cast<float>(j) * m_side;
        }
        visit(moved);
      }
    }
  }

  void coverPlace(const FlatTriangle& flat, const TriangleField::Part& part, std::uint32_t triangle) {
    const Inside inside(flat);
    if (inside.empty()) return;
    for (View& view : m_views) view.cover(flat, inside, part, triangle);
  }

  const TriangleField& m_field;
  std::vector<LayerSet> m_sets;
  bool m_slices;
  int m_a, m_b, m_axis;
  float m_side, m_patchesPerMetre;
  std::vector<View> m_views;
};

}  // namespace

Result<std::vector<LayerHits>> passHits(const TriangleField& field, const SamplingOptions& options,
                                        const JobContext& job) {
  std::vector<LayerHits> all;
  for (const LayerSet set : kAllLayerSets) {
    SWARD_ASSIGN(LayerHits started, startHits(set, options));
    all.push_back(std::move(started));
  }
  sampleGround(field.patch().sideM, options.seed, all[static_cast<std::size_t>(LayerSet::Ground)]);
  if (job.cancelled()) return Error::cancelled();
  std::vector<AxisPass> passes;
  passes.emplace_back(std::vector{LayerSet::Slices}, field, options, all);
  passes.emplace_back(std::vector{LayerSet::BladesPosX, LayerSet::BladesNegX}, field, options, all);
  passes.emplace_back(std::vector{LayerSet::BladesPosY, LayerSet::BladesNegY}, field, options, all);
  const auto parts = field.parts();
  base::ProgressCounter progress(job, "hits", parts.size());
  base::parallelFor(job, parts.size(), kPartGrain, [&](std::size_t begin, std::size_t end) {
    for (AxisPass& pass : passes) {
      for (std::size_t i = begin; i < end; ++i) pass.cover(parts[i]);
    }
    progress.add(end - begin);
  });
  if (job.cancelled()) return Error::cancelled();
  std::vector<std::pair<const AxisPass*, std::size_t>> views;
  for (const AxisPass& pass : passes) {
    for (std::size_t view = 0; view < pass.views(); ++view) views.emplace_back(&pass, view);
  }
  base::parallelFor(job, views.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) views[i].first->pack(all, views[i].second);
  });
  if (job.cancelled()) return Error::cancelled();
  return all;
}

}  // namespace sward::trace
