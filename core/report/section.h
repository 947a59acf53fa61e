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

/// What a quick run draws in the place of the project's own ground: the project at half quality, baked in seconds where
/// nothing is in the cache. Else the project itself.
project::Project groundProject(const project::Project& project, bool quick);

/// A picture of the report: written as NAME.exr (linear) and NAME.png (display) under pictures/, shown in the page.
/// A row whose errors were measured on two of them names both in its parameters, so that others can measure again:
///   "picture": "\"NAME\"", "reference_picture": "\"NAME\"": names without endings; both have `linear`
///   "display": "\"filmic\"" or "\"standard\"": the render::ViewTransform that made `display` of `linear`
/// Its rmse, bias and max are then of the linear values, psnr_db, ssim and flip of the display values (before they are
/// rounded to 8 bits), all over the whole picture (image::compareImages).
struct Picture {
  std::string name;  ///< file name without its ending: letters, digits, _ and -; no two of a report are the same
  std::string caption;
  image::Image linear;   ///< RGB linear radiance times exposure; empty: none is written
  image::Image display;  ///< RGB in [0, 1], sRGB-encoded; never empty
};
/// Pictures side by side: a method, the reference, their difference.
struct Strip {
  std::string title;
  std::vector<Picture> pictures;
};

/// A plot of points, one series a method; axes may be logarithmic (points that are not above 0 are left out then, and
/// the page says how many). A series keeps its colour in all plots of a report, by its name.
struct Plot {
  struct Point {
    double x = 0.0, y = 0.0;
    std::string label;  ///< written beside the point; empty: the series' name stands at its only or its last point
  };
  struct Series {
    std::string name;
    std::vector<Point> points;
    bool line = false;  ///< join the points
  };
  std::string name;                   ///< file name without its ending
  std::string title, xLabel, yLabel;  ///< labels with their units
  std::string caption;                ///< how to read it, in a sentence or two
  bool logX = false, logY = false;
  bool pareto = false;  ///< draws the front of the points that no other beats in both x and y (smaller is better)
  std::vector<Series> series;
};

/// Measured values from which rows were computed, so that others can compute them again (tests/report/recompute.py
/// does): NAME.csv, or an array of 32-bit floats in NumPy's format, NAME.npy, under tables/.
/// Errors of light responses: SECTION_lights.csv has a line for every method and held-out light, with the columns
///   method, light (index), weight (sum of w), squares (sum of w e^2), sum (sum of w e), max (greatest |e|, w above 0)
/// in nine digits at least, e = method - truth and w the weights of the values. Further columns are named as
/// parameters of rows. A row is made of the lines that have its method and, in each of those columns, its parameter (or
/// where that is "all", any): rmse = sqrt(squares / weight), bias = sum / weight, max. Of some lights K the values
/// themselves stand in arrays of one shape: SECTION_weight, SECTION_truth_K, SECTION_METHOD_K; they make the first
/// line of their method and light. A parameter rmse_over_METHOD is the row's rmse over that of METHOD's row with the
/// same parameters in the columns.
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
  std::string summary;  ///< what was measured, how, and how to read it; an empty line parts paragraphs
  std::vector<Row> rows;
  std::vector<Plot> plots;
  std::vector<Strip> strips;
  std::vector<Table> tables;
  std::vector<Array> arrays;
  double seconds = 0.0;  ///< that measuring it took; set by who runs the sections
  std::string failure;   ///< why it could not be measured, for people; it has no rows then and is not in report.json
};

/// Measures one section. Progress counts its own steps, in [0, 1].
using MeasureSection = std::function<Result<Section>(const SectionInput&, const JobContext&)>;

}  // namespace sward::report
