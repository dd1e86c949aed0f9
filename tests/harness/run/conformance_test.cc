#include "harness/run/conformance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace aisle {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Ten frames of noise.
class Noise : public Sequence {
 public:
  std::string name() const override { return "noise"; }
  StereoCalibration calibration() const override { return {32, 24, 20, 20, 16, 12, 0.1}; }
  double rate_hz() const override { return 20; }
  std::vector<FrameRequest> Schedule() const override {
    std::vector<FrameRequest> requests(10);
    for (std::size_t i = 0; i < requests.size(); ++i) {
      requests[i].id = static_cast<std::int64_t>(i);
      requests[i].stamp_ns = static_cast<std::int64_t>(i) * 50'000'000;
    }
    return requests;
  }
  SequenceFrame At(const FrameRequest& request) const override {
    cv::Mat1b image(24, 32);
    cv::RNG random(static_cast<std::uint64_t>(request.id) + 1);
    random.fill(image, cv::RNG::UNIFORM, 0, 256);
    return {{request.id, request.stamp_ns, image, image.clone()}, {}};
  }
};

/// Goes ahead by the mean of each image; every fault can be switched on.
struct Faults {
  bool wrong_stamp = false, pose_without_tracking = false, scaled = false, writes = false;
  bool keeps_images = false, remembers_others = false, throws_on_black = false;
  bool wrong_mask_size = false, grey_mask = false, falling_stamps = false,
       keypoints_outside = false, map_id_falls = false;
};

class MeanWalker : public Estimator {
 public:
  explicit MeanWalker(const Faults& faults) : faults_(faults) {}

  FrameEstimate Process(const StereoFrame& frame, const ExternalMask&) override {
    if (faults_.throws_on_black && cv::countNonZero(frame.left) == 0) {
      throw std::runtime_error("no features");
    }
    if (faults_.writes) const_cast<cv::Mat1b&>(frame.left)(0, 0) ^= 1;
    if (faults_.keeps_images && !last_.empty()) Step(last_);  // the caller's, painted over by now
    last_ = frame.left;
    if (!faults_.keeps_images) Step(frame.left);
    FrameEstimate estimate;
    estimate.id = frame.id;
    estimate.stamp_ns = frame.stamp_ns + (faults_.wrong_stamp ? 1 : 0);
    estimate.state =
        faults_.pose_without_tracking ? TrackingState::kLost : TrackingState::kTracking;
    estimate.T_world_rig = pose_;
    if (faults_.wrong_mask_size) estimate.regions.mask = cv::Mat1b::zeros(3, 3);
    if (faults_.grey_mask) estimate.regions.mask = cv::Mat1b(frame.left.size(), std::uint8_t{7});
    if (faults_.map_id_falls) estimate.counts["map_id"] = -static_cast<int>(frame.id);
    if (faults_.keypoints_outside) estimate.keypoints = {{40, 2}};
    track_.push_back({frame.stamp_ns, pose_});
    return estimate;
  }

  Trajectory Finish() override {
    if (faults_.falling_stamps) std::reverse(track_.begin(), track_.end());
    return track_;
  }

 private:
  void Step(const cv::Mat1b& image) {
    static int calls = 0;
    pose_.translation().x() += cv::mean(image)[0] + (faults_.remembers_others ? ++calls : 0);
    if (faults_.scaled) pose_.linear() *= 1.1;
  }

  const Faults faults_;
  cv::Mat1b last_;
  Eigen::Isometry3d pose_ = Eigen::Isometry3d::Identity();
  Trajectory track_;
};

std::vector<std::string> Check(const Faults& faults) {
  return CheckEstimator([faults] { return std::make_unique<MeanWalker>(faults); }, Noise());
}

TEST(ConformanceTest, AnEstimatorThatKeepsTheContractPasses) { EXPECT_THAT(Check({}), IsEmpty()); }

TEST(ConformanceTest, EveryFaultIsFoundAndNamed) {
  EXPECT_THAT(Check({.wrong_stamp = true}), ElementsAre(HasSubstr("id and stamp_ns")));
  EXPECT_THAT(Check({.pose_without_tracking = true}), ElementsAre(HasSubstr("kTracking")));
  EXPECT_THAT(Check({.scaled = true}),
              ElementsAre(HasSubstr("frame 0: T_world_rig"), HasSubstr("Finish: a pose")));
  EXPECT_THAT(Check({.writes = true}), ElementsAre(HasSubstr("writes to the caller's images")));
  EXPECT_THAT(Check({.keeps_images = true}), ElementsAre(HasSubstr("overwritten")));
  EXPECT_THAT(Check({.remembers_others = true}),
              ElementsAre(HasSubstr("side by side"), HasSubstr("a second drive")));
  EXPECT_THAT(Check({.throws_on_black = true}), ElementsAre(HasSubstr("no features")));
  EXPECT_THAT(Check({.wrong_mask_size = true}), ElementsAre(HasSubstr("differ in size")));
  EXPECT_THAT(Check({.grey_mask = true}), ElementsAre(HasSubstr("0 and 255")));
  EXPECT_THAT(Check({.falling_stamps = true}), ElementsAre(HasSubstr("timestamps must increase")));
  EXPECT_THAT(Check({.keypoints_outside = true}), ElementsAre(HasSubstr("outside")));
  EXPECT_THAT(Check({.map_id_falls = true}), ElementsAre(HasSubstr("frame 1: map_id falls")));
}

}  // namespace
}  // namespace aisle
