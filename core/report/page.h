#pragma once

#include "report/plot_svg.h"
#include "report/report.h"
#include "report/section.h"

#include <map>
#include <string>
#include <vector>

namespace sward::report {

/// A picture as the page holds it.
struct PagePicture {
  std::string dataUri;
  int width = 0, height = 0;  ///< of the picture it stands for, which may be larger than what is embedded
};

/// report.html: one file that needs nothing beside it (style, script, plots and pictures are in it; links to the data
/// files next to it work where they are). Every text is escaped. `pictures` by Picture::name: what is not there is left
/// out. The same report gives the same text.
std::string pageHtml(const ReportHead& head, const std::vector<Section>& sections, const SeriesLooks& looks,
                     const std::map<std::string, PagePicture>& pictures);

}  // namespace sward::report
