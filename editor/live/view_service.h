#pragma once

#include "bake/ground_bake.h"
#include "bake/inspection.h"
#include "base/result.h"
#include "gpu/context.h"
#include "image/bytes.h"
#include "project/project.h"
#include "render/view_mode.h"
#include "scene/options.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sward::editor {

/// Two pictures of one view in one: the project's own, and another one.
struct Comparison {
  enum class Show {
    Split,             ///< the project's own left of the split, the other right of it
    Difference,        ///< gain |other - own| of the display values, channel by channel: black where they are equal
    SignedDifference,  ///< 1/2 + gain (other - own) / 2: mid-grey where they are equal
  };
  Show show = Show::Split;
  double splitAt = 0.5;           ///< of the width
  render::GroundMethod method{};  ///< of the other picture
  /// A bake of another basis for the other picture; none: the same ground drawn by the other method.
  std::shared_ptr<const bake::GroundBake> ground;
  std::shared_ptr<const bake::Inspection> inspection;  ///< of that ground, where the view mode needs one
  double differenceGain = 4.0;
  /// The other picture is not drawn but given, whatever method and ground say; macro variation, which it does not have,
  /// is left out of the project's own. Pictures that differ in no more than the comparison go on with the samples they
  /// have.
  bool given = false;
  /// As large as the request or as a moving one; shown in the size of the project's own. Null: it is not there yet, and
  /// the project's own darkens in its place.
  std::shared_ptr<const image::ByteImage> other;
};

/// A picture that the viewport wants.
struct ViewRequest {
  std::shared_ptr<const project::Project> project;
  std::shared_ptr<const bake::GroundBake> ground;
  /// Of `ground`, for the view modes that need one (ViewMode::needsInspection()); may be empty otherwise.
  std::shared_ptr<const bake::Inspection> inspection;
  scene::View view;
  int width = 1280, height = 720;
  render::ViewMode mode;
  std::optional<Comparison> comparison;
  bool moving = false;  ///< the camera or a slider moves: half resolution (rounded up), one sample
  std::uint64_t id = 0;
};

/// A finished or growing picture, sRGB with alpha 255, rows from the top.
struct ViewPicture {
  std::uint64_t id = 0;       ///< of the request
  int width = 0, height = 0;  ///< half the request's (rounded up) when it was a moving one
  std::vector<std::uint8_t> rgba;
  int samples = 0;      ///< drawn so far
  bool final = false;   ///< all samples of the project's output: shaded and alone, it is what `sward render` writes
  double drawMs = 0.0;  ///< of the last sample
  /// Of the display values of both sides of a comparison with a given picture, once this one is final and the other as
  /// large.
  std::optional<double> rmse;
};

/// Draws the viewport on a thread and a context of its own, so that no picture ever holds up the UI. A newer request
/// replaces the older one after the sample being drawn; pictures grow sample by sample up to the project's number.
/// Every request that is begun gives a picture, so that a stream of requests is never starved.
class ViewService {
 public:
  struct Options {
    gpu::Device device = gpu::Device::Auto;
    /// Called from the service's thread when there is a new picture or error; may be empty.
    std::function<void()> onPicture;
  };
  explicit ViewService(Options options);
  /// Joins; within the time of one sample.
  ~ViewService();
  ViewService(const ViewService&) = delete;
  ViewService& operator=(const ViewService&) = delete;

  void request(ViewRequest request);
  /// The newest picture not yet taken.
  std::optional<ViewPicture> tryPop();
  /// Why the newest request that was begun could not be drawn; stands until a picture is drawn again.
  std::optional<Error> error() const;
  /// What draws; empty until the context exists.
  std::optional<gpu::DeviceInfo> device() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> m_impl;
};

}  // namespace sward::editor
