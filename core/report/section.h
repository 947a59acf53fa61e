#pragma once

#include "base/job.h"
#include "base/result.h"
#include "gpu/context.h"
#include "image/image.h"
#include "project/project.h"
#include "report/row.h"

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace sward::report {

/// What every section is measured on.
struct SectionInput {
  const project::Project& project;
  gpu::Context& context;              ///< current on this thread
  std::filesystem::path cacheFolder;  ///< of baked results; used and filled
  bool quick = false;                 ///< fewer runs and smaller sizes, for CI
};

/// A picture of the report: written as NAME.exr (linear) and NAME.png (display) under pictures/, shown in the page.
struct Picture {
  std::string name;  ///< file name without its ending: letters, digits, _ and -
  std::string caption;
  image::Image linear;   ///< RGB linear radiance times exposure; empty: none is written
  image::Image display;  ///< RGB in [0, 1], sRGB-encoded
};
/// Pictures side by side: a method, the reference, their difference.
struct Strip {
  std::string title;
  std::vector<Picture> pictures;
};

/// A plot of points, one series a method; axes may be logarithmic.
struct Plot {
  struct Point {
    double x = 0.0, y = 0.0;
    std::string label;
  };
  struct Series {
    std::string name;
    std::vector<Point> points;
    bool line = false;  ///< join the points
  };
  std::string name;  ///< file name without its ending
  std::string title, xLabel, yLabel;
  bool logX = false, logY = false;
  bool pareto = false;  ///< draws the front of the points that no other beats in both x and y (smaller is better)
  std::vector<Series> series;
};

/// Measured values from which rows were computed, so that others can compute them again: NAME.csv, or an array of
/// 32-bit floats in NumPy's format, NAME.npy, under tables/.
struct Table {
  std::string name;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};
struct Array {
  std::string name;
  std::vector<std::size_t> shape;
  std::vector<float> values;
};

struct Section {
  std::string name;  ///< as design.md lists it
  std::string title;
  std::string summary;  ///< a paragraph: what was measured, how, and how to read it
  std::vector<Row> rows;
  std::vector<Plot> plots;
  std::vector<Strip> strips;
  std::vector<Table> tables;
  std::vector<Array> arrays;
};

/// Measures one section. Progress counts its own steps, in [0, 1].
using MeasureSection = std::function<Result<Section>(const SectionInput&, const JobContext&)>;

}  // namespace sward::report
