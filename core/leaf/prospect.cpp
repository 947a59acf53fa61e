#include "leaf/prospect.h"

#include "leaf/range_check.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace sward::leaf {
namespace {

constexpr double kLitConeDeg = 40.0;

// Abramowitz and Stegun 5.1.11; all terms are below 1 for x up to 1, so that little cancels.
double integralBySeries(double x) {
  double term = 1.0, sum = 0.0;
  for (int n = 1; n < 40; ++n) {
    term *= -x / n;
    const double add = -term / n;
    sum += add;
    if (std::abs(add) < 1e-18) break;
  }
  return sum - std::log(x) - std::numbers::egamma;
}

// Abramowitz and Stegun 5.1.22 as an even continued fraction, by Lentz' method.
double integralByFraction(double x) {
  double b = x + 1.0, c = std::numeric_limits<double>::max(), d = 1.0 / b, h = d;
  for (int n = 1; n < 200; ++n) {
    const double a = -1.0 * n * n;
    b += 2.0;
    d = 1.0 / (a * d + b);
    c = b + a / c;
    const double factor = c * d;
    h *= factor;
    if (std::abs(factor - 1.0) < 1e-16) break;
  }
  return h * std::exp(-x);
}

constexpr std::size_t kNodes = 24;
struct Quadrature {
  std::array<double, kNodes> at{}, weight{};
};

// Gauss and Legendre on [0, 1]: Newton's method from the usual cosines.
Quadrature gaussLegendre() {
  Quadrature q;
  constexpr double n = static_cast<double>(kNodes);
  for (std::size_t i = 0; i < kNodes; ++i) {
    double x = std::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) / (n + 0.5)), slope = 1.0;
    for (int step = 0; step < 8; ++step) {
      double p0 = 1.0, p1 = x;
      for (std::size_t k = 2; k <= kNodes; ++k) {
        const double order = static_cast<double>(k);
        const double p2 = ((2.0 * order - 1.0) * x * p1 - (order - 1.0) * p0) / order;
        p0 = p1;
        p1 = p2;
      }
      slope = n * (x * p1 - p0) / (x * x - 1.0);
      x -= p1 / slope;
    }
    q.at[i] = 0.5 * (1.0 + x);
    q.weight[i] = 1.0 / ((1.0 - x * x) * slope * slope);
  }
  return q;
}

// Mean over both polarisations; cosine of the angle in air.
double fresnelTransmission(double cosine, double n) {
  const double inside = std::sqrt(1.0 - (1.0 - cosine * cosine) / (n * n));
  const double s = (cosine - n * inside) / (cosine + n * inside);
  const double p = (inside - n * cosine) / (inside + n * cosine);
  return 1.0 - 0.5 * (s * s + p * p);
}

struct SinglePlate {
  double rLit, tLit;  ///< lit within the cone
  double r, t;        ///< lit diffusely
  double absorbed;    ///< 1 - r - t
};

// Allen et al. 1969: multiple reflections between the two surfaces. Of diffuse light that passes inward, 1/n^2 passes
// outward.
SinglePlate singlePlate(const PlateSurface& surface, const PlateTransmission& plate) {
  const double theta = plate.passed;
  const double out = surface.diffusePasses / (surface.index * surface.index), back = 1.0 - out;
  const double bounces = 1.0 / (1.0 - back * back * theta * theta);
  SinglePlate p{};
  p.tLit = surface.litPasses * theta * out * bounces;
  p.rLit = 1.0 - surface.litPasses + back * theta * p.tLit;
  p.t = surface.diffusePasses * theta * out * bounces;
  p.r = 1.0 - surface.diffusePasses + back * theta * p.t;
  // 1 - r - t with the lines above inserted, so that nothing cancels where the plate hardly absorbs.
  p.absorbed = surface.diffusePasses * plate.absorbed / (1.0 - back * theta);
  return p;
}

// `count` plates, diffusely lit (Stokes 1862), count >= 0. With a and b as PROSPECT has them and A = 1 - r - t,
//   D^2 = (1 + r + t)(1 + r - t)(1 - r + t) A,  a - 1 = (A (1 - r + t) + D) / 2r,  b - 1 = (A (1 - t + r) + D) / 2t,
//   R = a (1 - c) / (a^2 - c),  T = sqrt(c) (a^2 - 1) / (a^2 - c),  c = b^(-2 count);
// b^(2 count) itself overflows in dark leaves.
PlateLight pile(const SinglePlate& p, double count) {
  if (!(count > 0.0)) return {0.0, 1.0};
  if (!(p.absorbed > 0.0)) {
    const double t = p.t / (p.t + (1.0 - p.t) * count);
    return {1.0 - t, t};
  }
  const double d = std::sqrt((1.0 + p.r + p.t) * (1.0 + p.r - p.t) * (1.0 - p.r + p.t) * p.absorbed);
  const double aLess1 = (p.absorbed * (1.0 - p.r + p.t) + d) / (2.0 * p.r), a = 1.0 + aLess1;
  const double bLess1 =
      p.t > 0.0 ? (p.absorbed * (1.0 - p.t + p.r) + d) / (2.0 * p.t) : std::numeric_limits<double>::infinity();
  const double exponent = count * std::log1p(bLess1);
  const double oneLessC = -std::expm1(-2.0 * exponent), aSquareLess1 = aLess1 * (a + 1.0);
  const double scale = 1.0 / (aSquareLess1 + oneLessC);
  return {a * oneLessC * scale, std::exp(-exponent) * aSquareLess1 * scale};
}

struct Coefficients {
  std::array<PlateSurface, kSamples> surface;
  std::array<Absorption, kSamples> absorption;
};

Coefficients tabulated(Calibration calibration) {
  Coefficients c;
  for (std::size_t i = 0; i < kSamples; ++i) {
    c.absorption[i] = absorptionAt(wavelengthNm(i), calibration);
    c.surface[i] = plateSurface(c.absorption[i].refractiveIndex);
  }
  return c;
}

const Coefficients& coefficients(Calibration calibration) {
  static const Coefficients five = tabulated(Calibration::Prospect5), late = tabulated(Calibration::ProspectD);
  return calibration == Calibration::Prospect5 ? five : late;
}

double opticalDepth(const LeafContents& c, const Absorption& a) {
  return c.chlorophyll * a.chlorophyll + c.carotenoid * a.carotenoid + c.brown * a.brown + c.waterCm * a.water +
         c.dryMatter * a.dryMatter;
}

}  // namespace

double exponentialIntegral(double x) {
  return x < 1.0 ? integralBySeries(x) : integralByFraction(x);
}

PlateTransmission plateTransmission(double k) {
  if (!(k > 0.0)) return {};
  // E1 is below exp(-k)/k: both underflow together, and k^2 E1 with them.
  if (k > 700.0) return {0.0, 1.0};
  const double tail = k * k * exponentialIntegral(k), passes = std::exp(-k);
  return {(1.0 - k) * passes + tail, -std::expm1(-k) + k * passes - tail};
}

double meanFresnelTransmission(double alphaDeg, double n) {
  static const Quadrature quadrature = gaussLegendre();
  const double edge = alphaDeg >= 90.0 ? 0.0 : std::cos(alphaDeg * std::numbers::pi / 180.0);
  // With mu the cosine: integral of T 2 mu dmu from the edge to 1, over sin^2 alpha = 1 - edge^2.
  double sum = 0.0;
  for (std::size_t i = 0; i < kNodes; ++i) {
    const double mu = edge + (1.0 - edge) * quadrature.at[i];
    sum += quadrature.weight[i] * fresnelTransmission(mu, n) * 2.0 * mu;
  }
  return sum / (1.0 + edge);
}

PlateSurface plateSurface(double index) {
  return {index, meanFresnelTransmission(kLitConeDeg, index), meanFresnelTransmission(90.0, index)};
}

PlateLight platesLight(const PlateSurface& surface, double depth, double structure, SurfaceLight light) {
  const SinglePlate one = singlePlate(surface, plateTransmission(depth / structure));
  const PlateLight more = pile(one, structure - 1.0);
  const double between = 1.0 / (1.0 - more.reflectance * one.r);
  PlateLight leaf{one.rLit + one.tLit * more.reflectance * one.t * between, one.tLit * more.transmittance * between};
  leaf.reflectance -= (1.0 - light.share) * (1.0 - surface.litPasses);
  return leaf;
}

Result<void> checkContents(const LeafContents& c) {
  const std::string where = "contents of the leaf";
  SWARD_TRY(checkRange("structure", c.structure, 1.0, 100.0, "plates", where));
  SWARD_TRY(checkRange("chlorophyll", c.chlorophyll, 0.0, 1000.0, "ug/cm2", where));
  SWARD_TRY(checkRange("carotenoid", c.carotenoid, 0.0, 1000.0, "ug/cm2", where));
  SWARD_TRY(checkRange("brown", c.brown, 0.0, 100.0, "units", where));
  SWARD_TRY(checkRange("waterCm", c.waterCm, 0.0, 10.0, "cm", where));
  return checkRange("dryMatter", c.dryMatter, 0.0, 1.0, "g/cm2", where);
}

PlateLight leafLightAt(const LeafContents& contents, double nm, Calibration calibration, SurfaceLight light) {
  const Absorption absorption = absorptionAt(nm, calibration);
  return platesLight(plateSurface(absorption.refractiveIndex), opticalDepth(contents, absorption), contents.structure,
                     light);
}

Result<LeafSpectra> leafSpectra(const LeafContents& contents, Calibration calibration, SurfaceLight light) {
  SWARD_TRY(checkContents(contents));
  const Coefficients& c = coefficients(calibration);
  LeafSpectra spectra;
  for (std::size_t i = 0; i < kSamples; ++i) {
    const PlateLight leaf =
        platesLight(c.surface[i], opticalDepth(contents, c.absorption[i]), contents.structure, light);
    spectra.reflectance[i] = leaf.reflectance;
    spectra.transmittance[i] = leaf.transmittance;
  }
  return spectra;
}

}  // namespace sward::leaf
