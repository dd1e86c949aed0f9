#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <vector>

#include "slam/camera/stereo_camera.h"
#include "slam/map/map.h"
#include "slam/optimize/adjust_map.h"

namespace aisle::slam {

/// What a RingWorld is like.
struct RingOptions {
  double drift = 1;      ///< factor on every step
  double turn_rad = 0;   ///< added to every turn
  int round = 40;        ///< keyframes of a round ...
  int again = 4;         ///< ... and beyond it
  int points = 4000;     ///< on both walls
  double noise_px = 0;   ///< deviation of the columns and rows that features measure
  unsigned seed = 3;     ///< of that
  int dark_before = -1;  ///< keyframe that goes on from the one before by wheels alone ...
  int through_dark = 0;  ///< ... but for so many landmarks that it sees again
};

/// A drive once round a ring-shaped aisle and a little further, as odometry that drifts would map
/// it: what is seen again after a whole round is mapped a second time, where drift has put it.
/// Every feature is known by its point, so that nothing here depends on images.
class RingWorld {
 public:
  explicit RingWorld(const RingOptions& options) : options_(options), random_(options.seed) {
    PlacePoints();
    for (int k = 0; k < options.round + options.again; ++k) truth_.push_back(TruePose(k));
    Eigen::Isometry3d T_world_rig = truth_[0];
    for (int k = 0; k < options.round + options.again; ++k) {
      if (k > 0) T_world_rig = T_world_rig * Drifted(k);
      AddKeyframe(k, T_world_rig);
    }
  }

  const Map& map() const { return map_; }
  const StereoCamera& camera() const { return camera_; }
  const std::vector<Eigen::Isometry3d>& truth() const { return truth_; }

  /// The second visits of the first places, as place recognition would measure them.
  std::vector<LoopEdge> Loops() const {
    std::vector<LoopEdge> loops;
    for (int k = 0; k < options_.again; ++k) {
      const int now = options_.round + k;
      loops.push_back({{now}, {k}, truth_[Slot(k)].inverse() * truth_[Slot(now)], 100});
    }
    return loops;
  }

  /// How far keyframes of `map` are from where they really were, at most.
  double WorstErrorM(const Map& map) const {
    double worst_m = 0;
    for (const auto& [id, keyframe] : map.keyframes()) {
      const Eigen::Isometry3d& truth = truth_[static_cast<std::size_t>(id.value)];
      worst_m =
          std::max(worst_m, (keyframe->T_world_rig.translation() - truth.translation()).norm());
    }
    return worst_m;
  }

 private:
  static constexpr double kRadiusM = 8;
  static std::size_t Slot(int k) { return static_cast<std::size_t>(k); }

  /// On the ring, looking along it. World axes are a camera's: x right, y down, z ahead.
  Eigen::Isometry3d TruePose(int k) const {
    const double angle = 2 * M_PI * k / options_.round;
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()).matrix();
    pose.translation() = kRadiusM * Eigen::Vector3d(1 - std::cos(angle), 0, std::sin(angle));
    return pose;
  }

  Eigen::Isometry3d Drifted(int k) const {
    Eigen::Isometry3d step = truth_[Slot(k - 1)].inverse() * truth_[Slot(k)];
    step.translation() *= options_.drift;
    return step * Eigen::AngleAxisd(options_.turn_rad, Eigen::Vector3d::UnitY());
  }

  /// Both walls of the aisle.
  void PlacePoints() {
    std::mt19937_64 random(7);
    const auto uniform = [&](double low, double high) {
      return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
    };
    for (int i = 0; i < options_.points; ++i) {
      const double angle = uniform(0, 2 * M_PI);
      const double radius = kRadiusM + (i % 2 == 0 ? -2.0 : 2.0) + uniform(-0.3, 0.3);
      points_.emplace_back(kRadiusM - radius * std::cos(angle), uniform(-1.5, 1.5),
                           radius * std::sin(angle));
      descriptors_.push_back({random(), random(), random(), random()});
    }
  }

  /// A level that shrinks with distance, as one corner's would.
  static int LevelAt(double distance_m) {
    return std::clamp(static_cast<int>(std::lround(std::log(7 / distance_m) / std::log(1.2))), 0,
                      7);
  }

  void AddKeyframe(int k, const Eigen::Isometry3d& T_world_rig) {
    auto frame = std::make_shared<Frame>();
    std::vector<int> seen;
    const Eigen::Isometry3d T_rig_world = truth_[Slot(k)].inverse();
    for (int i = 0; i < std::ssize(points_); ++i) {
      const Eigen::Vector3d point = T_rig_world * points_[Slot(i)];
      if (point.z() < 1 || point.norm() > 6) continue;
      const Eigen::Vector3d uvd = Project(camera_, point);
      if (!InImage(camera_, uvd.x(), uvd.y())) continue;
      seen.push_back(i);
      frame->features.keypoints.push_back(
          {cv::Point2f(static_cast<float>(uvd.x()), static_cast<float>(uvd.y())),
           LevelAt(point.norm()), 0, 50});
      frame->features.descriptors.push_back(descriptors_[Slot(i)]);
      const Eigen::Vector3d noise(normal_(random_), normal_(random_), 0.5 * normal_(random_));
      frame->measurements.push_back({uvd + options_.noise_px * noise, 1, 0.5});
    }
    frame->id = k;
    frame->grid = FeatureGrid(frame->features.keypoints, {camera_.width, camera_.height});

    Keyframe keyframe;
    keyframe.id = map_.NextKeyframeId();
    keyframe.frame = frame;
    keyframe.T_world_rig = T_world_rig;
    if (k > 0) keyframe.parent = {k - 1};
    MapEdit edit;
    last_seen_.resize(points_.size(), -100);
    landmark_of_.resize(points_.size());
    for (std::size_t f = 0; f < seen.size(); ++f) {
      const auto i = Slot(seen[f]);
      const bool followed =
          last_seen_[i] == k - 1 && (k != options_.dark_before || again_++ < options_.through_dark);
      last_seen_[i] = k;
      keyframe.landmarks.push_back(followed ? landmark_of_[i] : LandmarkId{});
      if (followed) continue;
      Landmark landmark;
      landmark.position = T_world_rig * Backproject(camera_, frame->measurements[f].uvd);
      landmark.observations = {{keyframe.id, static_cast<int>(f)}};
      landmark.created_by = keyframe.id;
      edit.new_landmarks.push_back(landmark);
    }
    edit.new_keyframes = {keyframe};
    map_.Apply(edit);
    const Keyframe& added = map_.At(keyframe.id);
    for (std::size_t f = 0; f < seen.size(); ++f) landmark_of_[Slot(seen[f])] = added.landmarks[f];
  }

  RingOptions options_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  int again_ = 0;  // landmarks that are seen through the dark
  StereoCamera camera_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<Descriptor> descriptors_;
  std::vector<Eigen::Isometry3d> truth_;
  std::vector<int> last_seen_;
  std::vector<LandmarkId> landmark_of_;
  Map map_;
};

}  // namespace aisle::slam
