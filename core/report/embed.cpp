#include "report/embed.h"

#include "base/file.h"
#include "base/parallel.h"
#include "image/colour.h"
#include "image/io.h"
#include "report/markup.h"

#include <optional>

namespace sward::report {
namespace {

Result<PagePicture> writePicture(const std::filesystem::path& folder, const Picture& picture, const JobContext& job) {
  const image::Image& display = picture.display;
  SWARD_ASSIGN(const std::vector<std::byte> whole, image::encodePng(display));
  SWARD_TRY(base::writeFileAtomically(folder / (picture.name + ".png"), whole));
  if (job.cancelled()) return Error::cancelled();
  if (!picture.linear.empty()) SWARD_TRY(image::writeExr(folder / (picture.name + ".exr"), picture.linear));
  if (job.cancelled()) return Error::cancelled();
  const int factor = (display.width + kEmbeddedWidth - 1) / kEmbeddedWidth;
  std::string data;
  if (factor > 1 && display.height >= factor) {
    SWARD_ASSIGN(const std::vector<std::byte> small, image::encodePng(shrunk(display, factor)));
    data = base64(small);
  } else {
    data = base64(whole);
  }
  return PagePicture{"data:image/png;base64," + data, display.width, display.height};
}

}  // namespace

image::Image shrunk(const image::Image& display, int factor) {
  if (factor <= 1) return display;
  image::Image out(display.width / factor, display.height / factor, display.channels);
  const float share = 1.0f / static_cast<float>(factor * factor);
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      for (int c = 0; c < out.channels; ++c) {
        float sum = 0.0f;
        for (int i = 0; i < factor * factor; ++i) {
          sum += image::linearFromSrgb(display.at(x * factor + i % factor, y * factor + i / factor, c));
        }
        out.at(x, y, c) = image::srgbFromLinear(share * sum);
      }
    }
  }
  return out;
}

Result<std::map<std::string, PagePicture>> writePictures(const std::filesystem::path& folder,
                                                         const std::vector<Section>& sections, const JobContext& job) {
  std::vector<const Picture*> pictures;
  for (const Section& section : sections)
    for (const Strip& strip : section.strips)
      for (const Picture& picture : strip.pictures) pictures.push_back(&picture);
  std::vector<std::optional<Result<PagePicture>>> written(pictures.size());
  base::ProgressCounter progress(job, "writing pictures", pictures.size());
  base::parallelFor(job, pictures.size(), 1, [&](std::size_t begin, std::size_t) {
    written[begin] = writePicture(folder, *pictures[begin], job);
    progress.add();
  });
  if (job.cancelled()) return Error::cancelled();
  std::map<std::string, PagePicture> shown;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    SWARD_ASSIGN(PagePicture picture, std::move(*written[i]));
    shown.emplace(pictures[i]->name, std::move(picture));
  }
  return shown;
}

}  // namespace sward::report
