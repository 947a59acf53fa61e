#pragma once

#include "base/job.h"
#include "report/row.h"

#include <vector>

namespace sward::report {

/// Bytes of the paper's three sizes (256^2 x 8 layers, 256^2 x 16, 512^2 x 16), PTM and LPT, 8 and 16 bits, one channel
/// (as the paper) and both (reflected and transmitted), counted on real LayerStack objects. `bytes` are the
/// coefficients, `bytesTotal` adds colour, coverage and sky; the parameters hold the bytes of textures (coefficients in
/// four-channel images, the unused ones counted) and of the saved payload. For LPT `ratio` is its coefficients over
/// those of PTM at the same size, bits and channels (below 1 is smaller).
std::vector<Row> storageRows(const JobContext& job);

}  // namespace sward::report
