#include "slam/base/tracking_policy.h"

#include "slam/base/orbslam2_tracking.h"
#include "slam/base/plain_tracking.h"

namespace aisle::slam {

std::unique_ptr<TrackingPolicy> MakeTrackingPolicy(const StereoCamera& camera,
                                                   const SlamOptions& options) {
  if (options.base == Base::kOrbSlam2) return std::make_unique<OrbSlam2Tracking>(camera, options);
  return std::make_unique<PlainTracking>(camera, options);
}

}  // namespace aisle::slam
