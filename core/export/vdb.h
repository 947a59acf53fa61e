#pragma once

#include "base/result.h"
#include "wither/texel.h"

#include <filesystem>

namespace sward::exporting {

struct VdbOptions {
  /// 16 bits for everything but the density, whose range 16 bits may not hold; an error of 1/2048 of each value.
  bool half = false;
};

/// Writes a texel as an OpenVDB file, whole or not at all. Its grids, of the stored voxels alone:
/// - density (float): leaf area over volume, 1/m;
/// - normal, tangent (vec3): unit or zero;
/// - Cd, transmitted (vec3): reflectance and transmittance, linear RGB; Cd is what Blender and Houdini call a colour;
/// - specular (float), 0 to 1;
/// - spread_diag (xx, yy, zz) and spread_off (xy, xz, yz) (vec3) of S, 1/m.
/// World space is in metres with z up, the block from 0 to its sides: voxel (0, 0, 0) has its middle at half a voxel.
/// Programs with y up have to turn it. The grid's size is kept in the file's metadata, sward_columns and so on, and a
/// hash of all behind the last grid. Errors: an empty grid; a file that cannot be written.
Result<void> writeVdb(const wither::Texel& texel, const std::filesystem::path& path, const VdbOptions& options = {});

/// Reads what writeVdb wrote, or a file of another program that has a float grid "density" (others are optional:
/// without them normals are zero, leaves turned all around and of a plain green). Such a file's active box becomes the
/// block from its lowest corner, square and rounded up to whole bricks. Errors: not a VDB file, a file cut short or
/// damaged, no density, a grid of another type, voxels that are turned, sheared or not square in x and y, negative
/// densities, a box of over 4096 voxels a side, over 2^26 voxels or 4 GiB. Of other programs' files damage is found by
/// OpenVDB alone.
Result<wither::Texel> readVdb(const std::filesystem::path& path);

}  // namespace sward::exporting
