#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

/// The simulator's nouns, which its rooms hand to the face: what a frame is and what truth says of
/// it.
///
/// Conventions of all that follows. T_a_b maps coordinates of frame b to frame a. Lengths are
/// metres, times whole nanoseconds from the start of the scene, angles radians. World:
/// right-handed, z up, the floor at z = 0. Camera: x right, y down, z forward along the optical
/// axis; the rig's frame is that of its left camera, and the right camera stands at (+baseline_m,
/// 0, 0) in it, turned as the left one is. Images are of the rig's size, a pixel's centre has whole
/// coordinates (u, v) = (column, row), and depth is z, not the length of the ray.
namespace aisle::sim {

/// Which version of a scene to play.
enum class Twin {
  kLive,   ///< as written
  kEmpty,  ///< actors removed
  /// Actors and beams stay as they are at time 0; what the hall does by itself (lamps that go off,
  /// clouds before its doors) goes on, as in every twin.
  kFrozen,
  // As written, but for the level of dynamics: only actors of at most that level.
  kNone,
  kLow,
  kMid,
  kHigh,
};

/// Two equal, parallel cameras.
struct RigInfo {
  int width = 0, height = 0;              ///< pixels
  double fx = 0, fy = 0, cx = 0, cy = 0;  ///< pixels; the centre of pixel (0,0) is u = v = 0
  double baseline_m = 0;
  /// "none" (the pair is rectified), "radial-tangential" (k1 k2 p1 p2, as in OpenCV) or
  /// "equidistant" (k1 k2 k3 k4, as in cv::fisheye); the same in both cameras.
  std::string distortion_model = "none";
  std::array<double, 4> distortion = {0, 0, 0, 0};
};

/// One labelled thing of the scene; its id in the label image is its index in instances().
struct InstanceInfo {
  std::string name;
  std::string object_class;  ///< "person", "forklift", "rack", …
  std::uint8_t class_id = 0;
  bool is_actor = false;
};

/// Where an actor is in its own script, and how fast it goes through it. One that waits for a
/// vehicle falls behind the scene's time.
struct ActorClock {
  std::int64_t time_ns = 0;
  double rate = 1;  ///< of its time over the scene's: 1 as written, 0 stands

  /// The clock `offset_ns` of the scene's time later, the rate unchanged.
  ActorClock After(std::int64_t offset_ns) const {
    return {time_ns + std::llround(rate * static_cast<double>(offset_ns)), rate};
  }
};

/// How a picture off the planned route is taken.
struct Shot {
  Eigen::Isometry3d T_world_rig = Eigen::Isometry3d::Identity();  ///< at the stamp
  /// The rig's velocity (m/s) and turn rate (rad/s) around the stamp, in its own axes.
  Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();
  Eigen::Vector3d turn_rate_rad_s = Eigen::Vector3d::Zero();
  /// One per actor, in the order of Ground::actors(); empty: they keep the scene's time.
  std::vector<ActorClock> clocks = {};

  /// Where the rig is a little before or after the stamp: along the chord of its arc, which is
  /// good to a thousandth of the way while it turns by less than 10 degrees.
  Eigen::Isometry3d At(double offset_s) const {
    const double rate = turn_rate_rad_s.norm();
    const Eigen::Vector3d axis =
        rate > 0 ? Eigen::Vector3d(turn_rate_rad_s / rate) : Eigen::Vector3d::UnitZ();
    const auto turned = [&](double angle) { return Eigen::AngleAxisd(angle, axis); };
    Eigen::Isometry3d T_rig_moved = Eigen::Isometry3d::Identity();
    T_rig_moved.linear() = turned(rate * offset_s).toRotationMatrix();
    T_rig_moved.translation() = turned(rate * offset_s / 2) * (velocity_mps * offset_s);
    return T_world_rig * T_rig_moved;
  }
};

/// What truth says of one actor that has at least one pixel or box in the left image.
struct ObjectTruth {
  std::uint16_t instance = 0;
  cv::Rect2d box_visible;  ///< pixels; encloses the pixels that show it (empty if none)
  cv::Rect2d box_full;     ///< pixels; as if nothing stood in front, cut at the image border
  /// The object's frame: x ahead, z up; the origin on the floor for people and vehicles, at its
  /// first moving part for a mechanism.
  Eigen::Isometry3d T_world_object = Eigen::Isometry3d::Identity();
  Eigen::Vector3d extent_m = Eigen::Vector3d::Zero();  ///< full sizes of the 3-D box along its axes
  Eigen::Vector3d center_m = Eigen::Vector3d::Zero();  ///< of the 3-D box, world
  Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();  ///< of the object's origin, world
  double visible_fraction = 0;  ///< visible pixels / pixels it would have unoccluded, in [0, 1]
  int visible_pixels = 0;
  int dynamic_pixels = 0;  ///< of them, on a surface that moves now
};

/// Exact truth of the left camera (of the right where it says so) at the stamp. With motion blur or
/// a rolling shutter on, the stamp is the middle of the middle row's exposure.
///
/// What moves "now" is asked about the exposure, since at a single instant an arm that turns back
/// is at rest: a surface moves now if its fastest speed within sensor.exposure_ms (8 ms unless the
/// scene says otherwise) around the stamp exceeds Simulator::dynamic_threshold_mps(). The time is
/// the one set, whether motion blur is on or not and whatever automatic exposure chooses: what
/// moves does not depend on the light. Depth, labels and boxes are those of the stamp itself.
struct FrameTruth {
  Eigen::Isometry3d T_world_rig = Eigen::Isometry3d::Identity();
  cv::Mat1f depth;         ///< z in metres along the optical axis, inf where nothing was hit
  cv::Mat1w instance;      ///< index into Simulator::instances(), 0 where nothing was hit
  cv::Mat1b object_class;  ///< class ids
  cv::Mat1f depth_right;   ///< z in metres along the right camera's axis, inf where nothing was hit
  cv::Mat1w instance_right;
  cv::Mat1b dynamic;        ///< 255 where the surface moves in the world now
  cv::Mat1b dynamic_right;  ///< the same for the right camera
  /// 255 on every instance that may move at some time, moving or not (left): people, vehicles and
  /// mechanisms (doors, chains, conveyors, what is pushed and carried), but not their frames.
  cv::Mat1b actor;
  cv::Mat1b actor_right;             ///< the same for the right camera
  std::vector<ObjectTruth> objects;  ///< by instance id
};

struct RenderedFrame {
  std::int64_t stamp_ns = 0;
  cv::Mat1b left, right;   ///< 8-bit grey, the same instant exactly
  double exposure_ms = 0;  ///< exposure time of both
  double smear_ms = 0;     ///< of it, the time over which motion is drawn out: 0, or all of it
  double gain = 1;         ///< analogue gain of both
  FrameTruth truth;
};

/// Where each left pixel's surface point is in the right camera and in the next frame, exactly; and
/// which pixels lie in moving shadows.
struct MotionTruth {
  cv::Mat1f disparity;   ///< left u - right u in the rectified pair, pixels; 0: nothing was hit
  cv::Mat1b occluded;    ///< 255 where the right camera does not see the point
  cv::Mat2f flow;        ///< to the next frame's left image, pixels; NaN where it is not in front,
                         ///< or so far aside that the lens would fold it back into the image, or
                         ///< the point is gone: on a belt, which begins anew at its other end
  cv::Mat3f scene_flow;  ///< the surface point's own way until then, metres, world; NaN: it is gone
  /// 255 where the surface rests but something that moves takes more than a twentieth of its direct
  /// light now (left camera).
  cv::Mat1b moving_shadow;
};

}  // namespace aisle::sim
