#include "leaf/measured_leaves.h"

#include <array>

namespace sward::leaf {
namespace {

using TenNm = std::array<double, 36>;  ///< 400, 410, ... 750 nm

constexpr TenNm kLawnGrass = {0.0251, 0.0276, 0.0298, 0.0308, 0.0315, 0.0348, 0.0363, 0.0364, 0.0367,
                              0.0371, 0.0397, 0.0473, 0.0639, 0.0835, 0.0934, 0.0965, 0.0947, 0.0840,
                              0.0720, 0.0658, 0.0630, 0.0600, 0.0554, 0.0534, 0.0500, 0.0451, 0.0423,
                              0.0392, 0.0388, 0.0481, 0.0917, 0.1646, 0.2560, 0.3724, 0.4959, 0.5939};
constexpr TenNm kAspenGreen = {0.0495, 0.0495, 0.0500, 0.0524, 0.0554, 0.0567, 0.0575, 0.0577, 0.0585,
                               0.0595, 0.0614, 0.0679, 0.0852, 0.1077, 0.1201, 0.1247, 0.1210, 0.1062,
                               0.0918, 0.0844, 0.0811, 0.0766, 0.0714, 0.0688, 0.0659, 0.0610, 0.0583,
                               0.0563, 0.0572, 0.0676, 0.1255, 0.2259, 0.3258, 0.4024, 0.4459, 0.4651};
constexpr TenNm kAspenYellowGreen = {0.0537, 0.0537, 0.0542, 0.0557, 0.0586, 0.0596, 0.0617, 0.0635, 0.0646,
                                     0.0680, 0.0844, 0.1324, 0.2111, 0.2787, 0.3157, 0.3346, 0.3403, 0.3319,
                                     0.3173, 0.3077, 0.3039, 0.2949, 0.2808, 0.2739, 0.2643, 0.2400, 0.2155,
                                     0.1825, 0.1756, 0.2423, 0.3648, 0.4422, 0.4823, 0.5038, 0.5140, 0.5178};
constexpr TenNm kAspenYellow = {0.0422, 0.0422, 0.0428, 0.0457, 0.0501, 0.0519, 0.0549, 0.0583, 0.0600,
                                0.0641, 0.0824, 0.1372, 0.2309, 0.3142, 0.3641, 0.3914, 0.4068, 0.4181,
                                0.4256, 0.4309, 0.4354, 0.4374, 0.4370, 0.4374, 0.4379, 0.4345, 0.4253,
                                0.4059, 0.4023, 0.4328, 0.4615, 0.4707, 0.4731, 0.4740, 0.4744, 0.4744};
constexpr TenNm kGoldenGrass = {0.0426, 0.0513, 0.0609, 0.0708, 0.0802, 0.0890, 0.0974, 0.1053, 0.1129,
                                0.1203, 0.1275, 0.1346, 0.1416, 0.1485, 0.1555, 0.1625, 0.1694, 0.1764,
                                0.1832, 0.1897, 0.1963, 0.2027, 0.2087, 0.2147, 0.2203, 0.2255, 0.2306,
                                0.2355, 0.2407, 0.2471, 0.2541, 0.2604, 0.2660, 0.2710, 0.2757, 0.2800};
constexpr TenNm kDrySaltgrass = {0.1377, 0.1417, 0.1481, 0.1549, 0.1620, 0.1695, 0.1772, 0.1848, 0.1924,
                                 0.1995, 0.2063, 0.2127, 0.2186, 0.2247, 0.2308, 0.2372, 0.2438, 0.2493,
                                 0.2560, 0.2630, 0.2702, 0.2778, 0.2858, 0.2940, 0.3027, 0.3114, 0.3204,
                                 0.3294, 0.3384, 0.3477, 0.3569, 0.3662, 0.3756, 0.3848, 0.3939, 0.4031};

constexpr Spectrum interpolated(const TenNm& coarse) {
  Spectrum fine{};
  for (std::size_t i = 0; i < kSamples; ++i) {
    fine[i] = i % 2 == 0 ? coarse[i / 2] : 0.5 * (coarse[i / 2] + coarse[i / 2 + 1]);
  }
  return fine;
}

constexpr std::array<MeasuredLeaf, 6> kLeaves = {{
    {"lawn grass", "green", "Lawn_Grass GDS91 green BECKa", interpolated(kLawnGrass)},
    {"aspen, green", "green", "Aspen Aspen-1 green-top ASDFRa", interpolated(kAspenGreen)},
    {"aspen, yellow-green", "turning", "Aspen Aspen-3 yellowGreenTop ASDFRa", interpolated(kAspenYellowGreen)},
    {"aspen, yellow", "turning", "Aspen Aspen-4 yellow-top ASDFRa", interpolated(kAspenYellow)},
    {"golden dry grass", "dry", "Grass_Golden_Dry GDS480 ASDFRa", interpolated(kGoldenGrass)},
    {"dry saltgrass", "dry", "D.spicata DWV6-0511 dryNPV.a ASDFRa", interpolated(kDrySaltgrass)},
}};

}  // namespace

std::span<const MeasuredLeaf> measuredLeaves() {
  return kLeaves;
}

}  // namespace sward::leaf
