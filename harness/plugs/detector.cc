#include "harness/plugs/detector.h"

#include "harness/common/stopwatch.h"
#include "harness/io/input_error.h"
#include "harness/plugs/slam_values.h"
#include "harness/plugs/systems.h"
#include "harness/score/masks.h"
#include "slam/moving_objects.h"

namespace aisle {
namespace {

class SlamDetector : public Detector {
 public:
  SlamDetector(const slam::StereoCamera& camera, const slam::DynamicOptions& options)
      : camera_(camera), detector_(camera, options) {}

  Found Detect(const StereoFrame& frame) override {
    const Stopwatch watch;
    slam::DynamicOutput output =
        detector_.Detect({frame.stamp_ns, frame.left, frame.right, std::nullopt});
    Found found{RegionsFrom(output.regions), std::move(output.stage_ms)};
    found.stage_ms["dynamic"] = watch.ElapsedMs();
    stages_ = std::move(output.stages);
    return found;
  }

  std::map<int, std::string> FindLosses(const FrameTruth& before,
                                        const FrameTruth& now) const override {
    std::map<int, std::string> losses;
    if (!stages_ || now.instance.empty() || now.instance.size() != now.dynamic.size()) {
      return losses;
    }
    const std::vector<MovingObject> objects = MovingObjects(now, {});
    std::vector<slam::MoverTruth> movers;
    for (const MovingObject& object : objects) {
      cv::Mat1b pixels;
      cv::compare(now.instance, object.instance, pixels, cv::CMP_EQ);
      cv::bitwise_and(pixels, now.dynamic, pixels);
      movers.push_back({std::move(pixels), object.box});
    }
    const std::vector<std::string> steps =
        slam::FindLosses(*stages_, camera_, movers, now.T_world_rig.inverse() * before.T_world_rig);
    for (std::size_t i = 0; i < steps.size(); ++i) losses[objects[i].instance] = steps[i];
    return losses;
  }

 private:
  slam::StereoCamera camera_;
  slam::DynamicDetector detector_;
  std::shared_ptr<const slam::DynamicStages> stages_;  // of the last frame
};

}  // namespace

std::unique_ptr<Detector> MakeDetector(const SystemSpec& spec, const StereoCalibration& calibration,
                                       bool keep_stages) {
  slam::SlamOptions options = SlamOptionsFrom(OptionsOfSpec(spec));
  if (const std::string wrong = slam::Validate(options); !wrong.empty()) throw InputError(wrong);
  options.dynamic.keep_stages = keep_stages;
  return std::make_unique<SlamDetector>(CameraFrom(calibration), options.dynamic);
}

}  // namespace aisle
