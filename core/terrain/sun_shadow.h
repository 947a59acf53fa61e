#pragma once

#include "base/job.h"
#include "terrain/height_field.h"

#include <vector>

namespace sward::terrain {

/// Share of the sun's disc that every sample of the field's grid sees over the terrain, 0 to 1, row by row from the
/// south-west. `toSun` is a unit vector; at or below the horizon all is 0. One sweep of lines away from the sun carries
/// the height of the shadow along (Timonen and Westerholm 2010 sweep horizons in the same way): a few nanoseconds a
/// sample. The shadow's edge is as soft as the disc makes it at its distance, and at least as a sample is wide.
std::vector<float> sunVisibility(const HeightField& field, const glm::dvec3& toSun);

}  // namespace sward::terrain
