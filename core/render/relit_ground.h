#pragma once

#include "bake/ground_bake.h"
#include "base/result.h"
#include "gpu/objects.h"
#include "bake/inspection.h"
#include "render/light_terms.h"
#include "render/programs.h"
#include "render/relit_layout.h"
#include "render/view_mode.h"

#include <array>
#include <bitset>
#include <vector>

#include <glm/glm.hpp>

namespace sward::render {

/// The relit sets in the order of their place in the buffer: slices with the soil, then the blades seen from +x, -x,
/// +y, -y.
inline constexpr std::size_t kSliceSet = 0;
inline constexpr std::size_t kSetCount = 5;
using SetMask = std::bitset<kSetCount>;

/// A ground's stacks on the GPU and their relit texels (shaders/include/layout.glsl).
class RelitGround {
 public:
  /// Uploads the stacks. Errors: shapes that do not fit each other, or textures beyond the driver's limit.
  static Result<RelitGround> create(const bake::GroundBake& ground);

  /// The light that the next relight() uses; relit sets become stale when it differs.
  void setIllumination(const lpt::Illumination& light);
  /// What texels hold after the next relight(): radiance, or a view mode's quantity. Errors: a mode whose inspection is
  /// missing, or that `ground`, the one that was uploaded, has not.
  Result<void> setMode(const ViewMode& mode, const bake::GroundBake& ground);
  /// Uploads what Visibility and Condition show. Errors: it does not fit the ground.
  Result<void> setInspection(const bake::Inspection& inspection);
  /// Relights those of `sets` that are stale (slices and soil go together), their mips and means.
  Result<void> relight(ProgramCache& programs, SetMask sets);
  void invalidate() { m_fresh.reset(); }

  const gpu::Texture& relit() const { return m_relitView; }
  const SetLayout& layout(std::size_t set) const { return set == kSliceSet ? m_sliceLayout : m_bladeLayout; }
  std::size_t base(std::size_t set) const { return m_bases[set]; }
  int tiles() const { return m_tiles; }
  int slabsOfTile() const { return m_slabs; }
  bool hasBlades() const { return m_slabs > 0; }
  double scale() const { return m_scaled ? m_scale : 1.0; }
  /// One plane of a relit set as the GPU holds it, decoded: straight radiance over scale(), coverage.
  std::vector<glm::vec4> readPlane(std::size_t set, int plane, int level) const;

 private:
  /// A LayerStack's bytes on the GPU.
  struct Stack {
    explicit Stack(const lpt::LayerStack& stack);
    lpt::Basis basis;
    int width, height, images, layers, channels, bits;
    std::vector<lpt::CoefficientRange> ranges;
    lpt::CommonResponse common;
    gpu::Buffer coefficients, surface, transmission, sky;
    gpu::Texture coefficientsView, surfaceView, transmissionView, skyView;
    gpu::Buffer condition, visibility;  ///< of an inspection
    gpu::Texture conditionView, visibilityView;
    bool transmits = false;
  };
  struct Target;

  Result<void> relightStack(ProgramCache& programs, const Stack& stack, const Target& target);
  LightTerms termsOf(const Stack& stack) const;
  std::vector<float> commonTerms(const Stack& stack) const;
  void setQuantity(gpu::Program& program, const Stack& stack, bool slices) const;
  Result<void> relightSlices(ProgramCache& programs);
  Result<void> relightBlades(ProgramCache& programs, std::size_t side);
  Result<void> makeMips(ProgramCache& programs, std::size_t set, int firstLevel);

  std::vector<Stack> m_stacks;  ///< slices, soil, then four blade sides when there are any
  SetLayout m_sliceLayout, m_bladeLayout;
  std::array<std::size_t, kSetCount> m_bases{};
  gpu::Buffer m_relit, m_patch, m_owners;
  gpu::Texture m_relitView, m_patchView, m_ownersView;
  int m_tiles = 0, m_slabs = 0, m_patchSlabs = 0, m_apron = 0, m_tileTexels = 0;
  float m_brightest = 1.0f;  ///< largest reflectance or transmittance of all stacks
  lpt::Illumination m_light;
  double m_scale = 1.0;
  ViewMode m_mode;
  bool m_scaled = true;             ///< texels hold radiance over m_scale, no quantity
  double m_coefficientRange = 1.0;  ///< that m_mode shows from end to end
  bool m_inspected = false;
  SetMask m_fresh;
};

}  // namespace sward::render
