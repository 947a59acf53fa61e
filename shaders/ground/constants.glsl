// All constants of the ground's look in one place. core/render/ground_pass.cpp repeats those marked (C++).

// What is drawn: 0 the picture, 1 and 2 a view mode (ground/finish_mode.glsl).
#ifndef SWARD_MODE
#define SWARD_MODE 0
#endif

const float kTransmittanceEnd = 0.04;  // a ray with less left is opaque
const int kLotPixels = 2;           // side of the squares of pixels that draw lots between families together
const int kMaxSteps = 160;           // planes that a ray may cross
const int kMaxBlendedBlades = 64;    // of each direction that the blended methods composite
const float kHeightSteps = 12.0;     // distant rays take at least this many steps through the shell's height
const float kStridePixels = 3.0;     // what a ray may sink in a step that skips blade slabs: plants there are thin as pixels
const float kNearestM = 0.12;        // planes nearer than this to the eye are left out
// A slice's plane lies anywhere in a middle share of its slab, another place in every sample: all of it leaves no gaps
// between the planes of solid plants; in thick slabs less of it, so that small flat things (flowers) are not drawn out
// along the view by more than their size.
const float kSlabSpreadM = 0.02;
const float kLeastSlabSpread = 0.6;
// A ray's mip level is that of a point this share of its way through the shell, at most so far into it.
const float kLevelShare = 0.3;
const float kLevelReachM = 1.0;
// Within the shell rays sink at least so steeply: no real ground is flat enough to show its tallest stems alone.
const float kLeastSlope = 0.02;
const float kLevelBias = 0.9;        // on footprints: below 1 sharper
const float kSoilLevelSlant = 0.5;   // how much of the slant a soil texel's level takes

// Half the width of the cross-fade between blades normal to x and to y, in |dx| / (|dx| + |dy|) (C++).
const float kDiagonalFade = 0.45;

const float kSunDiscRad = 0.00465;     // angular radius
const float kSunLimbRad = 0.0007;      // soft edge
const float kSunDiscGain = 60.0;       // the disc's radiance over the sun's irradiance, far under the real 14700

const float kHueVariation = 0.35;      // of the macro variation, how much tilts from green to yellow

// Sizes of the sky's textures, also in core/render/sky_map.cpp.
const float kSkyRows = 128.0;
const float kHorizonTexels = 512.0;
