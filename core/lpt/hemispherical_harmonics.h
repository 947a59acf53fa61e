#pragma once

#include <vector>

#include <glm/glm.hpp>

namespace sward::lpt {

/// Hemispherical harmonics (Gautron, Krivanek, Pattanaik and Bouatouch 2004, "A Novel Hemispherical Basis for Accurate
/// and Efficient Rendering", equation 6): real spherical harmonics whose associated Legendre functions are shifted, x =
/// 2 cos(theta) - 1, so that they are orthonormal over the upper hemisphere,
///   H_l^m = K_l^|m| P_l^|m|(2 lz - 1) times sqrt(2) cos(m phi), 1 or sqrt(2) sin(|m| phi) for m > 0, = 0, < 0,
///   K_l^m = sqrt( (2 l + 1) (l - m)! / (2 pi (l + m)!) ).
/// `light` is a unit vector, z >= 0, phi its angle from +x. Returns the bands^2 functions in the order of l, then m
/// from -l up, for bands 1 to 3. The Condon-Shortley phase is left out.
std::vector<double> hemisphericalHarmonics(const glm::dvec3& light, int bands);

}  // namespace sward::lpt
