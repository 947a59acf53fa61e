#include "leaf/spectra.h"

#include "leaf/spectra_lobes.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace sward::leaf {
namespace {

double lobeSum(std::span<const Lobe> lobes, double constant, double nm) {
  double sum = constant;
  for (const Lobe& lobe : lobes) {
    const double u = (nm - lobe.centreNm) / lobe.widthNm;
    sum += lobe.amplitude * std::exp(-0.5 * u * u);
  }
  // Where nothing is absorbed, a fit goes below zero by as much as it misses.
  return std::max(0.0, sum);
}

}  // namespace

Absorption absorptionAt(double nm, Calibration calibration) {
  Absorption a;
  if (calibration == Calibration::Prospect5) {
    a.refractiveIndex = lobeSum(kProspect5IndexLobes, kProspect5IndexConstant, nm);
    a.chlorophyll = lobeSum(kProspect5ChlorophyllLobes, kProspect5ChlorophyllConstant, nm);
    a.carotenoid = lobeSum(kProspect5CarotenoidLobes, kProspect5CarotenoidConstant, nm);
  } else {
    a.refractiveIndex = lobeSum(kProspectDIndexLobes, kProspectDIndexConstant, nm);
    a.chlorophyll = lobeSum(kProspectDChlorophyllLobes, kProspectDChlorophyllConstant, nm);
    a.carotenoid = lobeSum(kProspectDCarotenoidLobes, kProspectDCarotenoidConstant, nm);
  }
  a.brown = lobeSum(kBrownLobes, kBrownConstant, nm);
  a.water = lobeSum(kWaterLobes, kWaterConstant, nm);
  a.dryMatter = lobeSum(kDryMatterLobes, kDryMatterConstant, nm);
  return a;
}

PigmentAbsorbance pigmentAbsorbanceAt(double nm) {
  return {lobeSum(kChlorophyllALobes, kChlorophyllAConstant, nm),
          lobeSum(kChlorophyllBLobes, kChlorophyllBConstant, nm),
          lobeSum(kMeanCarotenoidLobes, kMeanCarotenoidConstant, nm)};
}

Observer observerAt(double nm) {
  return {lobeSum(kObserverXLobes, kObserverXConstant, nm), lobeSum(kObserverYLobes, kObserverYConstant, nm),
          lobeSum(kObserverZLobes, kObserverZConstant, nm)};
}

double daylightAt(double nm) {
  return lobeSum(kDaylightD65Lobes, kDaylightD65Constant, nm);
}

}  // namespace sward::leaf
