#pragma once

#include <algorithm>
#include <memory>
#include <random>
#include <vector>

#include "slam/camera/stereo_camera.h"
#include "slam/map/create_landmarks.h"
#include "slam/map/map.h"
#include "slam/track/track_frame.h"

namespace aisle::slam {

/// Points around a rig with descriptors of their own, seen without images.
class PointWorld {
 public:
  PointWorld() {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> x(-5, 5), y(-2, 2), z(3, 14);
    for (int i = 0; i < 600; ++i) {
      points_.emplace_back(x(random), y(random), z(random));
      descriptors_.push_back({random(), random(), random(), random()});
    }
  }

  enum class Eye { kLeft, kRight };

  /// What a camera sees of the world right of the column `from_u` of its image; the left one with
  /// disparities.
  std::shared_ptr<const Frame> See(const Eigen::Isometry3d& T_world_rig, std::int64_t stamp_ns,
                                   Eye eye = Eye::kLeft, double from_u = 0) const {
    const StereoCamera camera;
    auto frame = std::make_shared<Frame>();
    frame->stamp_ns = stamp_ns;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Eigen::Vector3d in_rig = T_world_rig.inverse() * points_[i];
      if (in_rig.z() < 0.5) continue;
      Eigen::Vector3d uvd = Project(camera, in_rig);
      const bool right = eye == Eye::kRight;
      if (right) uvd = {uvd.x() - uvd.z(), uvd.y(), 0};
      if (!InImage(camera, uvd.x(), uvd.y()) || uvd.x() < from_u) continue;
      Keypoint keypoint;
      keypoint.pixel = {static_cast<float>(uvd.x()), static_cast<float>(uvd.y())};
      frame->features.keypoints.push_back(keypoint);
      frame->features.descriptors.push_back(descriptors_[i]);
      frame->measurements.push_back({uvd, 1, right ? 0 : 0.3, 0, right});
    }
    frame->grid = FeatureGrid(frame->features.keypoints, {camera.width, camera.height});
    return frame;
  }

  /// The number of the point that looks like this.
  std::size_t IndexOf(const Descriptor& descriptor) const {
    return static_cast<std::size_t>(
        std::find(descriptors_.begin(), descriptors_.end(), descriptor) - descriptors_.begin());
  }

  /// From here on, points `from` to `to` (not included) have gone to elsewhere, by so much.
  void Move(std::size_t from, std::size_t to, const Eigen::Vector3d& by) {
    Move(from, to, Eigen::Isometry3d(Eigen::Translation3d(by)));
  }
  void Move(std::size_t from, std::size_t to, const Eigen::Isometry3d& T_after_before) {
    for (std::size_t i = from; i < to; ++i) points_[i] = T_after_before * points_[i];
  }

 private:
  std::vector<Eigen::Vector3d> points_;
  std::vector<Descriptor> descriptors_;
};

/// A rig that stands at (x, 0, z), turned to the right.
inline Eigen::Isometry3d At(double x, double z, double yaw_deg = 0) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() << x, 0, z;
  pose.linear() = Eigen::AngleAxisd(yaw_deg * M_PI / 180, Eigen::Vector3d::UnitY()).matrix();
  return pose;
}

/// A map of one keyframe, taken of this world at its origin, and what tracking remembers of it.
inline void BeginAtOrigin(const PointWorld& world, Map* map, TrackMemory* memory) {
  Keyframe keyframe;
  keyframe.id = map->NextKeyframeId();
  keyframe.frame = world.See(At(0, 0), 0);
  keyframe.landmarks.resize(static_cast<std::size_t>(keyframe.frame->size()));
  MapEdit edit;
  edit.new_landmarks = CreateLandmarks(keyframe, {}, {});
  edit.new_keyframes = {keyframe};
  map->Apply(edit);
  memory->reference = keyframe.id;
  memory->landmarks = map->At(keyframe.id).landmarks;
}

}  // namespace aisle::slam
