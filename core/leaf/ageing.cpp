#include "leaf/ageing.h"

#include "image/colour.h"
#include "leaf/colour.h"
#include "leaf/pigment_subtraction.h"
#include "leaf/range_check.h"

#include <algorithm>
#include <string>

namespace sward::leaf {
namespace {

// A channel is no wavelength: that of a saturated colour may hold more than all of the light. Both colours then move
// towards their greys, whose sum is below 1, until no channel gives back more than arrives.
void keepEnergy(GamutColour& r, GamutColour& t) {
  const double greyR = image::xyzFromLinear(r.linear).y, greyT = image::xyzFromLinear(t.linear).y;
  const double grey = greyR + greyT;
  double kept = 1.0;
  for (int c = 0; c < 3; ++c) {
    const double sum = r.linear[c] + t.linear[c];
    if (sum > 1.0) kept = std::min(kept, std::max(0.0, (1.0 - grey) / (sum - grey)));
  }
  if (kept == 1.0) return;
  r = {greyR + kept * (r.linear - greyR), 1.0 - kept * (1.0 - r.desaturation)};
  t = {greyT + kept * (t.linear - greyT), 1.0 - kept * (1.0 - t.desaturation)};
}

LeafColourDetail colourOf(const Spectrum& reflectance, const Spectrum& transmittance) {
  GamutColour r = intoGamut(linearFromSpectrum(reflectance)), t = intoGamut(linearFromSpectrum(transmittance));
  keepEnergy(r, t);
  return {{r.linear, t.linear}, r.desaturation, t.desaturation, 0};
}

}  // namespace

Result<void> checkOptions(const LeafOptions& options) {
  SWARD_TRY(checkContents(freshContents(options)));
  const std::string where = "colour of the leaf";
  SWARD_TRY(checkRange("structureWhenDry", options.structureWhenDry, 1.0, 100.0, "plates", where));
  SWARD_TRY(checkRange("brownWhenDry", options.brownWhenDry, 0.0, 100.0, "units", where));
  SWARD_TRY(checkRange("carotenoidWhenDry", options.carotenoidWhenDry, 0.0, 1000.0, "ug/cm2", where));
  SWARD_TRY(checkRange("surfaceShare", options.surfaceShare, 0.0, 1.0, "", where));
  SWARD_TRY(checkRange("subtractionLevel", options.subtractionLevel, 0.0, 1.0, "", where));
  SWARD_TRY(checkRange("subtractionStrength", options.subtractionStrength, 0.0, 100.0, "", where));
  SWARD_TRY(checkRange("subtractionTransmission", options.subtractionTransmission, 0.0, 1.0, "", where));
  // Light that is neither reflected nor lost passes.
  if (options.subtractionLevel * (1.0 + options.subtractionTransmission) > 1.0 &&
      options.model == LeafOptions::Model::Subtraction) {
    return Error::badInput("subtractionLevel and subtractionTransmission give back more light than arrives", where,
                           "Lower one until level x (1 + transmission) is 1 at most.");
  }
  return {};
}

Result<LeafColourDetail> leafColour(const LeafContents& contents, SurfaceLight light) {
  SWARD_ASSIGN(const LeafSpectra s, leafSpectra(contents, Calibration::ProspectD, light));
  return colourOf(s.reflectance, s.transmittance);
}

LeafContents freshContents(const LeafOptions& options) {
  return {options.structure, options.chlorophyll, options.carotenoid, 0.0, options.waterCm, options.dryMatter};
}

LeafContents agedContents(const LeafOptions& options, double chlorophyllShare, double waterShare) {
  const double lost = 1.0 - waterShare;
  LeafContents aged = freshContents(options);
  aged.chlorophyll *= chlorophyllShare;
  aged.waterCm *= waterShare;
  aged.structure += lost * (options.structureWhenDry - options.structure);
  aged.brown = lost * lost * options.brownWhenDry;
  aged.carotenoid += lost * lost * (options.carotenoidWhenDry - options.carotenoid);
  return aged;
}

Result<LeafColourDetail> agedColour(const LeafOptions& options, double chlorophyllShare, double waterShare) {
  SWARD_TRY(checkOptions(options));
  SWARD_TRY(checkRange("the share of chlorophyll", chlorophyllShare, 0.0, 1.0, "", "colour of a leaf"));
  SWARD_TRY(checkRange("the share of water", waterShare, 0.0, 1.0, "", "colour of a leaf"));
  if (options.model == LeafOptions::Model::Plates) {
    return leafColour(agedContents(options, chlorophyllShare, waterShare), {options.surfaceShare});
  }
  SWARD_ASSIGN(const SubtractionSpectra s, subtractionSpectra(options, chlorophyllShare));
  LeafColourDetail detail = colourOf(s.reflectance, s.transmittance);
  detail.clampedSamples = s.clamped;
  return detail;
}

Result<AgeingColours> AgeingColours::build(const LeafOptions& options) {
  AgeingColours table;
  table.m_nodes.reserve(kChlorophyllNodes * kWaterNodes);
  for (std::size_t j = 0; j < kWaterNodes; ++j) {
    for (std::size_t i = 0; i < kChlorophyllNodes; ++i) {
      const double root = static_cast<double>(i) / static_cast<double>(kChlorophyllNodes - 1);
      const double water = static_cast<double>(j) / static_cast<double>(kWaterNodes - 1);
      SWARD_ASSIGN(const LeafColourDetail detail, agedColour(options, root * root, water));
      Node& node = table.m_nodes.emplace_back();
      for (int c = 0; c < 3; ++c) {
        node[static_cast<std::size_t>(c)] = static_cast<float>(detail.colour.reflectance[c]);
        node[static_cast<std::size_t>(c) + 3] = static_cast<float>(detail.colour.transmittance[c]);
      }
    }
  }
  return table;
}

}  // namespace sward::leaf
