#include "report/hard_cases.h"

#include "base/random.h"
#include "trace/layers.h"

#include <cmath>
#include <memory>
#include <numbers>

namespace sward::report {
namespace {

/// Leaning strips on a patch of side 1, as one model.
mesh::Model strips() {
  constexpr int kStrips = 60;
  mesh::Model model;
  model.materials.emplace_back();
  base::Random random(72);
  for (int i = 0; i < kStrips; ++i) {
    const double azimuth = 2.0 * std::numbers::pi * random.uniform(), lean = random.uniform(0.1, 0.9);
    const glm::vec3 out(std::cos(azimuth), std::sin(azimuth), 0.0), across(-out.y, out.x, 0.0f);
    const glm::vec3 corner(random.uniform(0.1, 0.9), random.uniform(0.1, 0.9), 0.0);
    const glm::vec3 side = 0.08f * across,
                    up = 0.25f * (static_cast<float>(std::sin(lean)) * out + glm::vec3(0, 0, std::cos(lean)));
    const auto first = static_cast<std::uint32_t>(model.positions.size());
    for (const glm::vec2 st : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)}) {
      model.positions.push_back(corner + st.x * side + st.y * up);
      model.normals.push_back(glm::normalize(glm::cross(side, up)));
      model.uvs.push_back(st);
      model.colours.emplace_back(1.0f);
    }
    model.triangles.emplace_back(first, first + 1, first + 2);
    model.triangles.emplace_back(first, first + 2, first + 3);
    model.triangleMaterial.insert(model.triangleMaterial.end(), 2, 0u);
  }
  return model;
}

trace::SamplingOptions samplingOptions() {
  trace::SamplingOptions options;
  options.sliceResolution = 12;
  options.slices = 8;
  return options;
}

}  // namespace

Result<HardCase> patchCase(std::string name, double scale, const JobContext& job) {
  mesh::Model model = strips();
  for (glm::vec3& position : model.positions) position *= static_cast<float>(scale);
  auto patch = std::make_shared<scene::Patch>();
  patch->sideM = scale;
  patch->heightM = 0.25 * scale;
  patch->models.push_back(std::make_shared<mesh::Model>(std::move(model)));
  patch->instances.emplace_back();
  SWARD_ASSIGN(const auto scene, trace::PatchScene::create(patch, job));
  const trace::SamplingOptions options = samplingOptions();
  SWARD_ASSIGN(const trace::LayerHits hits, trace::sampleHits(*scene, trace::LayerSet::Slices, options, job));
  SWARD_ASSIGN(trace::LayerVisibility seen, trace::sampleVisibility(*scene, hits, options, job));
  HardCase out;
  out.name = std::move(name);
  out.expectation = "traced; the same samples at every size, since no threshold is a length";
  out.columns = hits.shape.columns();
  out.layers = hits.shape.layers;
  out.channels = 2;
  out.lights = hemisphereLights(15);
  out.columnStart = hits.columnStart;
  out.layer = hits.layer;
  for (std::size_t t = 0; t < hits.texels(); ++t) out.coverage.push_back(hits.coverage(t));
  out.visibility = std::move(seen.visibility);
  out.samples.resize(out.lights.size() * 2);
  for (std::size_t k = 0; k < out.lights.size(); ++k) {
    SWARD_ASSIGN(trace::LayerLuminance light, trace::sampleLuminance(*scene, hits, out.lights[k], job));
    out.samples[k] = std::move(light.reflected);
    out.samples[out.lights.size() + k] = std::move(light.transmitted);
  }
  return out;
}

}  // namespace sward::report
