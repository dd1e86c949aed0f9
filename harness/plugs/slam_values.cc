#include "harness/plugs/slam_values.h"

#include "harness/io/input_error.h"

namespace aisle {

slam::StereoCamera CameraFrom(const StereoCalibration& calibration) {
  slam::StereoCamera camera;
  camera.width = calibration.width;
  camera.height = calibration.height;
  camera.fx = calibration.fx;
  camera.fy = calibration.fy;
  camera.cx = calibration.cx;
  camera.cy = calibration.cy;
  camera.baseline_m = calibration.baseline_m;
  return camera;
}

DynamicRegions RegionsFrom(const slam::DynamicRegions& found) {
  DynamicRegions regions;
  regions.mask = found.mask;
  for (const slam::DynamicRegion& region : found.regions) {
    regions.regions.push_back({region.id, region.box, region.evidence});
  }
  return regions;
}

std::string SetSlamOptions(const std::map<std::string, std::string>& values,
                           slam::SlamOptions* options) {
  std::string wrong;
  const auto base = values.find("base");
  if (base != values.end()) wrong = slam::SetOption(base->first, base->second, options);
  for (const auto& [path, value] : values) {
    if (wrong.empty() && path != "base") wrong = slam::SetOption(path, value, options);
  }
  return wrong;
}

slam::SlamOptions SlamOptionsFrom(const std::map<std::string, std::string>& values) {
  slam::SlamOptions options;
  if (const std::string wrong = SetSlamOptions(values, &options); !wrong.empty()) {
    throw InputError(wrong);
  }
  return options;
}

}  // namespace aisle
