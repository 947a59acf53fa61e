#include "wither/pose.h"

#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace sward::wither {
namespace {

constexpr std::size_t kGrain = 4096;

/// Copies all that a pose does not write.
void prepare(const Points& rest, Points& moved) {
  if (moved.size() != rest.size() || moved.attachments.size() != rest.attachments.size()) moved = rest;
}

Result<void> check(const Points& points, std::size_t strands) {
  for (const Attachment& at : points.attachments) {
    if (at.strand < static_cast<std::int64_t>(strands)) continue;
    return Error::badInput("a point hangs on strand " + std::to_string(at.strand) + " of " + std::to_string(strands),
                           "points", "Give the strands that the points were made with.");
  }
  return {};
}

/// v turned in the plane of bendTo and up: what is up goes toward bendTo.
glm::vec3 turned(const glm::vec3& v, const glm::vec2& bendTo, float cosine, float sine) {
  const float in = v.x * bendTo.x + v.y * bendTo.y;
  const float more = (cosine - 1.0f) * in + sine * v.z;
  return {v.x + more * bendTo.x, v.y + more * bendTo.y, cosine * v.z - sine * in};
}

/// R S R^T of a symmetric matrix: its rows turned, then the columns of what that gives.
std::array<float, 6> turned(const std::array<float, 6>& s, const glm::vec2& bendTo, float cosine, float sine) {
  const glm::vec3 x = turned(glm::vec3(s[0], s[1], s[2]), bendTo, cosine, sine);
  const glm::vec3 y = turned(glm::vec3(s[1], s[3], s[4]), bendTo, cosine, sine);
  const glm::vec3 z = turned(glm::vec3(s[2], s[4], s[5]), bendTo, cosine, sine);
  const glm::vec3 a = turned(glm::vec3(x.x, y.x, z.x), bendTo, cosine, sine);
  const glm::vec3 b = turned(glm::vec3(x.y, y.y, z.y), bendTo, cosine, sine);
  const glm::vec3 c = turned(glm::vec3(x.z, y.z, z.z), bendTo, cosine, sine);
  return {a.x, a.y, a.z, b.y, b.z, c.z};
}

}  // namespace

SwardPose::SwardPose(std::span<const Strand> strands, const Season& season, std::span<const MingleSample> samples,
                     double weathering, const JobContext& job)
    : m_bodies(strands.size()), m_shares(strands.size() * kShares) {
  const SampleSeasons moments(season, samples, weathering);
  std::vector<std::vector<Node>> nodes(strands.size());
  base::parallelFor(job, strands.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const Strand& strand = strands[k];
      const double moment = moments[strand.sample];
      const BladeState state = season.stateAt(moment, strand.delay, strand.droop);
      const BentStrand bent(strand, state);
      for (const BentStrand::Node& node : bent.nodes()) {
        nodes[k].push_back({node.rest, static_cast<float>(node.cosine), node.now, static_cast<float>(node.sine)});
      }
      Body& body = m_bodies[k];
      body.segments = static_cast<float>(bent.nodes().size() - 1);
      body.bendTo = strand.bendTo;
      body.across = static_cast<float>(bent.across());
      body.area = static_cast<float>((1.0 - state.strainAlong) * (1.0 - state.strainAcross));
      body.rests = state.tipRad == 0.0 && state.strainAlong == 0.0 && state.strainAcross == 0.0;
      body.fresh = !(moment > 0.0);
      for (std::size_t i = 0; i < kShares; ++i) {
        m_shares[k * kShares + i] =
            season.sharesAt(moment, strand.delay, static_cast<double>(i) / static_cast<double>(kShares - 1));
      }
    }
  });
  for (std::size_t k = 0; k < strands.size(); ++k) {
    m_bodies[k].first = static_cast<std::uint32_t>(m_nodes.size());
    m_nodes.insert(m_nodes.end(), nodes[k].begin(), nodes[k].end());
  }
}

void SwardPose::moveRange(const Points& rest, Points& moved, std::size_t begin, std::size_t end) const {
  for (std::size_t i = begin; i < end; ++i) {
    const Attachment at = rest.attachments[i];
    if (at.strand < 0 || m_bodies[static_cast<std::size_t>(at.strand)].rests) {
      moved.positions[i] = rest.positions[i];
      moved.normals[i] = rest.normals[i];
      moved.tangents[i] = rest.tangents[i];
      moved.spread[i] = rest.spread[i];
      moved.areaM2[i] = rest.areaM2[i];
      continue;
    }
    const Body& body = m_bodies[static_cast<std::size_t>(at.strand)];
    const float place = std::clamp(at.s, 0.0f, 1.0f) * body.segments;
    const auto k = static_cast<std::uint32_t>(std::min(place, body.segments - 1.0f));
    const float t = place - static_cast<float>(k);
    const Node &a = m_nodes[body.first + k], &b = m_nodes[body.first + k + 1];
    float cosine = a.cosine + t * (b.cosine - a.cosine), sine = a.sine + t * (b.sine - a.sine);
    const float scale = 1.0f / std::sqrt(cosine * cosine + sine * sine);  // neighbours turn alike: near 1
    cosine *= scale;
    sine *= scale;
    const glm::vec3 offset = rest.positions[i] - (a.rest + t * (b.rest - a.rest));
    glm::vec3 now = a.now + t * (b.now - a.now) + body.across * turned(offset, body.bendTo, cosine, sine);
    now.z = std::max(now.z, std::min(0.0f, rest.positions[i].z));
    moved.positions[i] = now;
    moved.normals[i] = turned(rest.normals[i], body.bendTo, cosine, sine);
    moved.tangents[i] = turned(rest.tangents[i], body.bendTo, cosine, sine);
    moved.spread[i] = turned(rest.spread[i], body.bendTo, cosine, sine);
    moved.areaM2[i] = rest.areaM2[i] * body.area;
  }
}

void SwardPose::ageRange(const Points& rest, const AgeColour& colour, Points& moved, std::size_t begin,
                         std::size_t end) const {
  for (std::size_t i = begin; i < end; ++i) {
    moved.diffuse[i] = rest.diffuse[i];
    moved.transmitted[i] = rest.transmitted[i];
    const Attachment at = rest.attachments[i];
    if (!colour || at.strand < 0 || m_bodies[static_cast<std::size_t>(at.strand)].fresh) continue;
    const double place = std::clamp(static_cast<double>(at.s), 0.0, 1.0) * static_cast<double>(kShares - 1);
    const std::size_t k = std::min(static_cast<std::size_t>(place), kShares - 2);
    const double t = place - static_cast<double>(k);
    const Season::Shares* shares = &m_shares[static_cast<std::size_t>(at.strand) * kShares + k];
    colour(moved.diffuse[i], moved.transmitted[i],
           {shares[0].water + t * (shares[1].water - shares[0].water),
            shares[0].chlorophyll + t * (shares[1].chlorophyll - shares[0].chlorophyll)});
  }
}

template <typename Range>
Result<void> SwardPose::forRanges(const Points& rest, Points& moved, const JobContext& job, const Range& range) const {
  SWARD_TRY(check(rest, m_bodies.size()));
  prepare(rest, moved);
  base::parallelFor(job, rest.size(), kGrain, range);
  if (job.cancelled()) return Error::cancelled();
  return {};
}

Result<void> SwardPose::move(const Points& rest, Points& moved, const JobContext& job) const {
  return forRanges(rest, moved, job, [&](std::size_t begin, std::size_t end) { moveRange(rest, moved, begin, end); });
}

Result<void> SwardPose::age(const Points& rest, const AgeColour& colour, Points& moved, const JobContext& job) const {
  return forRanges(rest, moved, job,
                   [&](std::size_t begin, std::size_t end) { ageRange(rest, colour, moved, begin, end); });
}

Result<void> SwardPose::moveAndAge(const Points& rest, const AgeColour& colour, Points& moved,
                                   const JobContext& job) const {
  return forRanges(rest, moved, job, [&](std::size_t begin, std::size_t end) {
    moveRange(rest, moved, begin, end);
    ageRange(rest, colour, moved, begin, end);
  });
}

Result<void> pose(const Points& rest, std::span<const Strand> strands, const Season& season,
                  std::span<const MingleSample> samples, double weathering, const AgeColour& colour, Points& moved,
                  const JobContext& job) {
  const SwardPose posed(strands, season, samples, weathering, job);
  return posed.moveAndAge(rest, colour, moved, job);
}

Result<void> paperPose(const Points& rest, std::span<const Strand> strands, const Season& season,
                       std::span<const MingleSample> samples, double weathering, Points& moved, const JobContext& job) {
  constexpr double kLargest = 175.0 * std::numbers::pi / 180.0;
  SWARD_TRY(check(rest, strands.size()));
  moved = rest;
  const SampleSeasons moments(season, samples, weathering);
  std::vector<double> tips;
  for (const Strand& strand : strands) {
    tips.push_back(season.stateAt(moments[strand.sample], strand.delay, strand.droop).tipRad);
  }
  base::parallelFor(job, rest.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (rest.attachments[i].strand < 0) continue;
      const auto k = static_cast<std::size_t>(rest.attachments[i].strand);
      const double top = strands[k].vein.back().z;
      const auto height = static_cast<double>(rest.positions[i].z);
      if (!(tips[k] > 0.0) || !(height > 0.0) || !(top > 0.0)) continue;
      const double angle = std::min(tips[k] * (top / height) * (top / height), kLargest);
      const auto turn = [&](const auto& v, double by) {
        return turned(v, strands[k].bendTo, static_cast<float>(std::cos(by)), static_cast<float>(std::sin(by)));
      };
      const glm::vec3 root = strands[k].vein.front();
      glm::vec3& now = moved.positions[i];
      now = root + turn(rest.positions[i] - root, angle);
      now.z = std::max(now.z, std::min(0.0f, rest.positions[i].z));
      const glm::vec3 line = now - root;  // the foot of an upright blade is its root
      const float length = glm::length(line);
      if (length > 0.0f && glm::dot(rest.tangents[i], rest.tangents[i]) > 0.0f) moved.tangents[i] = line / length;
      moved.normals[i] = turn(rest.normals[i], angle);
      moved.spread[i] = turn(rest.spread[i], angle);
    }
  });
  if (job.cancelled()) return Error::cancelled();
  return {};
}

}  // namespace sward::wither
