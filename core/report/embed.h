#pragma once

#include "base/job.h"
#include "base/result.h"
#include "report/page.h"
#include "report/section.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace sward::report {

/// Pictures in a page are not wider than this: three stand side by side, and enlarged they fill most of a screen.
inline constexpr int kEmbeddedWidth = 720;

/// Averages blocks of factor x factor display values as light adds up: decoded, averaged, encoded. What is left over at
/// the right and the bottom is dropped; factor 1 gives the image itself.
image::Image shrunk(const image::Image& display, int factor);

/// Writes NAME.png and, where there is a linear image, NAME.exr of every picture into `folder`, which exists, and gives
/// each as the page embeds it. On the job's threads. Errors: those of writing, Error::cancelled().
Result<std::map<std::string, PagePicture>> writePictures(const std::filesystem::path& folder,
                                                         const std::vector<Section>& sections, const JobContext& job);

}  // namespace sward::report
