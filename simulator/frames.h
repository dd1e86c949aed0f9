#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

/// The simulator's nouns, which its rooms hand to the face: what a frame is, what truth says of it,
/// and what its proofs say of both.
namespace aisle::sim {

/// Parallel stereo rig; see simulator/camera for the conventions.
struct RigInfo {
  int width = 0, height = 0;
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
  std::vector<ActorClock> clocks = {};  ///< per actor, in order; empty: they keep the scene's time

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
  Eigen::Isometry3d T_world_object = Eigen::Isometry3d::Identity();
  Eigen::Vector3d extent_m = Eigen::Vector3d::Zero();  ///< full sizes of the 3-D box along its axes
  Eigen::Vector3d center_m = Eigen::Vector3d::Zero();  ///< of the 3-D box, world
  Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();
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

/// What the proofs say of one frame; see simulator/raster and simulator/truth.
struct VerifyReport {
  double raster_agreement_left = 0;   ///< share of pixels away from silhouettes where OSMesa agrees
  double raster_agreement_right = 0;  ///< in label and in depth to 1e-3
  int raster_compared = 0, raster_pixels = 0;  ///< of both pictures; the latter all there are
  double stereo_median_px = 0;  ///< left warped to right by disparity, error of geometry
  double flow_median_px = 0;    ///< left warped to the next left by flow, as disparity
  int surface_pixels = 0;       ///< of the left picture: that show anything
  int stereo_compared = 0, flow_compared = 0;
  /// Grey against grey over three frames without noise, see simulator/proof: rms change of things
  /// at rest along their flow, flicker of movers and of moving shadows; grey levels, 0 where too
  /// little of it is seen.
  double static_change_grey = 0, mover_flicker_grey = 0, shadow_flicker_grey = 0;
  std::string picture_failure = {};  ///< of the three, or empty
  /// The sentence that says what failed its bound (0.999 agreement on at least a tenth of the
  /// pixels, 0.05 px on at least a hundredth of those that show anything), or empty.
  std::string failure() const;
};

/// The stages of a frame, in the order in which they feed each other.
inline constexpr std::array kStages = {"triangles", "points", "static light", "radiance",
                                       "pictures"};

/// A hash of what each of kStages made of a frame for both cameras: which triangle a pixel sees;
/// where on it (t, u, v); the light on the static world; the radiance before the sensor; the
/// pictures. For finding where two machines part.
using StageHashes = std::array<std::uint64_t, kStages.size()>;

/// How long rendering a frame of a drive takes, beside the bare cost of its primary rays in the
/// same process.
struct RenderBench {
  double pair_ms = 0;        ///< a stereo pair with all truth, median
  double after_jump_ms = 0;  ///< one that comes after a jump to another place of the drive, median
  double bare_primary_ms = 0;  ///< primary ray packets of the same two images alone, median
  double ratio = 0;            ///< pair_ms / bare_primary_ms
  int frames = 0;
  std::int64_t triangles = 0, moving_triangles = 0;  ///< of the world; the movers' among them
  std::map<std::string, double> stage_ms;            ///< medians by stage
};

/// The nightly light of one left image beside the path tracer's, before the sensor: linear, in
/// shares of the sensor's white.
struct LightCheck {
  cv::Mat1f nightly, reference;
  double median_relative_error = 0;  ///< over pixels
  double ssim = 0;                   ///< structural similarity, what is over white cut to white
  double mean_ratio = 0;             ///< nightly over reference
  /// The same of two references of half as many paths each, against each other: what of the error
  /// is the paths' own noise.
  double noise_median_relative = 0, noise_ssim = 0;
  std::array<cv::Mat1f, 2> halves;  ///< these two; the reference is their mean
};

/// How the light of one left image changes to the next frame's, beside how the path tracer's does.
struct LightChangeCheck {
  struct Part {
    int pixels = 0;
    double rms_nightly = 0, rms_reference = 0;  ///< of the changes, in shares of white
    double rms_between = 0;                     ///< of one change less the other
    double rms_noise = 0;                       ///< what of it is the paths' own noise
    double correlation = 0;                     ///< of the two changes
  };
  LightCheck now;
  Part everywhere, on_movers;  ///< the latter in either frame, and the pixel around them
};

}  // namespace aisle::sim
