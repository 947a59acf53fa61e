#include "lpt/representation.h"

#include "base/check.h"
#include "lpt/marched.h"
#include "lpt/representation_kinds.h"

namespace sward::lpt {

namespace detail {

void checkRelight(const Texels& texels, std::size_t channels, std::span<const std::span<float>> out) {
  SWARD_CHECK_EQ(out.size(), channels);
  for (const std::span<float>& channel : out) SWARD_CHECK_EQ(channel.size(), texels.layer.size());
}

}  // namespace detail

const Method* findMethod(std::string_view name) {
  if (name == "ptm16") name = "ptm";
  for (const Method& method : kMethods) {
    if (method.name == name) return &method;
  }
  return nullptr;
}

Result<std::unique_ptr<Representation>> represent(const RepresentationInput& input, const FitOptions& options,
                                                  bool quantised, const JobContext& job) {
  SWARD_CHECK(input.hits != nullptr);
  SWARD_CHECK_EQ(input.hits->shape.columns(), input.fit.columns);
  switch (options.basis) {
    case Basis::Lpt:
      return detail::representLpt(input, options, quantised, job);
    case Basis::Ptm:
      return detail::representPtm(input, options, quantised, job);
    case Basis::Constant:
      return detail::representConstant(input, options, quantised, job);
    case Basis::Clustered:
      return detail::representClustered(input, options, detail::LayerGroups::Adaptive, quantised, job);
    case Basis::Hsh:
      return detail::representHsh(input, options, 2, quantised, job);
    case Basis::Sampled:
      return Error::failed("light that is traced for one sun is not fitted", "fit.basis", "Choose another method");
    case Basis::Marched:
      break;
  }
  return representMarched(input, options, quantised, job);
}

}  // namespace sward::lpt
