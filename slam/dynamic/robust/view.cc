#include "slam/dynamic/robust/view.h"

#include "slam/common/parallel.h"
#include "slam/dynamic/robust/residual_flow.h"
#include "slam/dynamic/robust/unseen_columns.h"

namespace aisle::slam::dynamic {

View LookAt(const StereoPair& images, std::int64_t stamp_ns, const RobustOptions& options) {
  cv::Mat1b left, right;
  ParallelInvoke([&] { left = QuietHalfImage(images.left, options.surface); },
                 [&] { right = QuietHalfImage(images.right, options.surface); });
  View view;
  ParallelInvoke(
      [&] {
        view.frame = MakeDenseFrame(left, right, options.disparity);
        view.frame.stamp_ns = stamp_ns;
        view.around = LookAround(view.frame, options.surface, options.evidence);
      },
      [&] {
        view.texture = MeasureTexture(left, options.surface);
        view.pyramid = MakeFlowPyramid(left, options.flow);
      });
  view.held = WellHeld(view.texture, view.frame.disparity, options.ego.cell_px);
  return view;
}

Layout LayOut(const DenseFrame& frame, const StereoCamera& camera,
              const DisparityTolerance& tolerance, const RobustOptions& options) {
  Layout layout;
  layout.floor = FindFloor(frame.disparity, HalfCamera(camera), tolerance);
  layout.floor_mask = FloorMask(frame.filled, layout.floor, tolerance);
  layout.links = LinkPixels(frame.filled, frame.image, layout.floor_mask, tolerance, options.field);
  LinkUnseen(frame.disparity, frame.unseen, options.field, &layout.links);
  frame.filled.convertTo(layout.farthest, CV_32F, options.field.grow_m / camera.baseline_m);
  return layout;
}

}  // namespace aisle::slam::dynamic
