#include "harness/plugs/cached_frame.h"

#include "harness/io/keep.h"
#include "harness/score/difficulty.h"

namespace aisle {

SequenceFrame MakeAndKeep(const FrameStore& store, const std::function<SequenceFrame()>& make) {
  SequenceFrame made = make();
  if (made.truth) {
    if (!made.truth->depth.empty()) made.truth->depth_grid = DepthGrid(made.truth->depth);
    for (cv::Mat* image : std::initializer_list<cv::Mat*>{
             &made.truth->depth, &made.truth->depth_right, &made.truth->instance_right}) {
      image->release();
    }
  }
  KeepWherePossible([&] { store.Write(made); });
  return made;
}

}  // namespace aisle
