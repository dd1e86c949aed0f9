#include "simulator/scene_camera.h"

#include <stdexcept>

#include "simulator/camera/pixel_rays.h"
#include "simulator/scene/issues.h"

namespace aisle::sim {
namespace {

/// A lens as the camera room knows it, and as RigInfo names it.
struct NamedLens {
  LensModel model = LensModel::kPinhole;
  const char* name = "none";
};

NamedLens LensOf(Distortion distortion) {
  switch (distortion) {
    case Distortion::kRadialTangential:
      return {LensModel::kRadialTangential, "radial-tangential"};
    case Distortion::kEquidistant:
      return {LensModel::kEquidistant, "equidistant"};
    case Distortion::kNone:
      break;
  }
  return {};
}

}  // namespace

StereoCamera CameraOf(const CameraSpec& spec) {
  return {.width = spec.size_px[0],
          .height = spec.size_px[1],
          .fx = spec.focal_px.x(),
          .fy = spec.focal_px.y(),
          .cx = spec.center_px.x(),
          .cy = spec.center_px.y(),
          .baseline_m = spec.baseline_m,
          .lens = {LensOf(spec.distortion).model, spec.distortion_coefficients}};
}

RigInfo RigOf(const CameraSpec& spec) {
  return {.width = spec.size_px[0],
          .height = spec.size_px[1],
          .fx = spec.focal_px.x(),
          .fy = spec.focal_px.y(),
          .cx = spec.center_px.x(),
          .cy = spec.center_px.y(),
          .baseline_m = spec.baseline_m,
          .distortion_model = LensOf(spec.distortion).name,
          .distortion = spec.distortion_coefficients};
}

std::vector<std::string> LensErrors(const Scene& scene) {
  std::vector<std::string> errors;
  for (const DescribedCamera& one : DescribedCameras(scene)) {
    try {
      MakePixelRays(CameraOf(one.camera));
    } catch (const std::invalid_argument& error) {
      errors.push_back(fmt::format("{}: {}.distortion_coefficients: {}",
                                   PlaceText(scene.files, one.camera.mark), one.key, error.what()));
    }
  }
  return errors;
}

}  // namespace aisle::sim
