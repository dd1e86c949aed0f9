#pragma once

#include "slam/dynamic/common/stereo_pair.h"
#include "slam/dynamic/robust/dense_frame.h"
#include "slam/dynamic/robust/floor_plane.h"
#include "slam/dynamic/robust/label_field.h"
#include "slam/dynamic/robust/motion_evidence.h"
#include "slam/flow/flow_pyramid.h"

namespace aisle::slam::dynamic {

/// What the current pair shows, whatever it is compared with.
struct View {
  DenseFrame frame;
  Texture texture;
  FlowPyramid pyramid;
  Surroundings around;
  std::vector<cv::Point> held;  ///< its points that can be followed, see WellHeld
};
View LookAt(const StereoPair& images, std::int64_t stamp_ns, const RobustOptions& options);

/// How the pixels of a view hang together, whatever moves.
struct Layout {
  std::optional<FloorPlane> floor;
  cv::Mat1b floor_mask;
  Links links;
  cv::Mat1f farthest;  ///< how far a label may grow, half-size pixels
};
Layout LayOut(const DenseFrame& frame, const StereoCamera& camera,
              const DisparityTolerance& tolerance, const RobustOptions& options);

}  // namespace aisle::slam::dynamic
