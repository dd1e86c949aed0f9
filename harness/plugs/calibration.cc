#include "harness/plugs/calibration.h"

#include "harness/io/input_error.h"
#include "simulator/calibration/stereo_model.h"

namespace aisle {
namespace {

CameraCalibration Convert(const sim::CameraModel& camera) {
  CameraCalibration result;
  result.width = camera.width;
  result.height = camera.height;
  result.fx = camera.fx;
  result.fy = camera.fy;
  result.cx = camera.cx;
  result.cy = camera.cy;
  result.distortion = camera.distortion;
  result.equidistant = camera.equidistant;
  return result;
}

StatedRectification Convert(const sim::StereoModel::Stated& stated) {
  return {stated.R_rectified_camera, stated.projection};
}

}  // namespace

StereoCameras ReadCalibration(const std::vector<std::string>& files) {
  try {
    const sim::StereoModel model = sim::ReadStereoModel(files);
    StereoCameras cameras;
    cameras.left = Convert(model.left);
    cameras.right = Convert(model.right);
    cameras.right.T_body_camera = model.T_right_left.inverse();
    if (model.stated) {
      const auto& [left, right] = *model.stated;
      cameras.stated = {Convert(left), Convert(right)};
    }
    return cameras;
  } catch (const std::runtime_error& error) {
    throw InputError(error.what());
  }
}

}  // namespace aisle
