#pragma once

#include <optional>

#include "harness/bag/mcap_writer.h"
#include "harness/contract/estimate.h"
#include "harness/contract/sequence.h"
#include "harness/contract/wheel_track.h"
#include "harness/ros/geometry.h"

namespace aisle {

/// Frames of reference of a bag. map is truth's world. Each body has one parent: truth's is
/// base_link (map -> odom -> base_link -> the cameras; odom stands on map, and with odometry is
/// where the wheels' drift has carried it, as REP 105 has it), each system's is SYSTEM/base_link
/// below SYSTEM/map, its own world, which is laid onto map by its first pose.
inline constexpr const char* kMapFrame = "map";
inline constexpr const char* kLeftFrame = "camera_left_optical_frame";

/// A name as ROS takes one in topics and frames: letters, digits and '_', a letter first.
std::string RosName(const std::string& name);

/// Each system of a bag has topics that are its alone. Throws InputError that names a system whose
/// RosName is another's (a-b, a_b) or the bag's own: left, right, truth.
void RequireOwnTopics(const std::vector<std::string>& systems);

/// Added to the stamps of a scene, which begin at 0: tf takes 0 for "the latest", Rerun early
/// stamps for durations.
inline constexpr std::int64_t kBagEpochNs = 1'600'000'000'000'000'000;

struct DriveBagOptions {
  std::int64_t epoch_ns = kBagEpochNs;  ///< added to every stamp; 0 for a recording's
  /// T_base_rig: base_link has x ahead, y to the left, z up; rig is the left camera. By default
  /// base_link is at the camera.
  Eigen::Isometry3d T_base_rig = CameraAhead();
  McapOptions mcap = {};
};

/// Writes a drive as one bag for `ros2 bag play`, Foxglove, Rerun and evo. Log time and header
/// stamps are equal: the frames' own plus epoch_ns.
///
///   /left/image_rect, /left/camera_info, /right/…    sensor_msgs, the rectified pair, mono8
///   /left/image_rect_color, /right/…                 rgb8, where the frames have colour
///   /left/depth      16UC1 millimetres, 0 unknown    /left/moving    mono8, 255: it moves now
///   /left/boxes      visualization_msgs/ImageMarker  /truth/boxes    MarkerArray, in map
///   /odom            nav_msgs/Odometry: what wheels measured, where frames have it
///   /truth/pose      PoseStamped of the left camera  /truth/path     Path
///   /SYSTEM/pose     PoseStamped of the left camera in SYSTEM/map, live; /SYSTEM/path, and
///   /SYSTEM/final_path, what it says in the end      /SYSTEM/state   std_msgs/String
///   /left/rejected_SYSTEM   mono8, 255: rejected     /SYSTEM/events  rcl_interfaces/Log
///   /SYSTEM/worst_1, _2, …  mono8, stills of the frames in which it was farthest off
///   /tf, /tf_static
///
/// Truth is written where a frame knows it. Systems are named as RequireOwnTopics allows. Not
/// thread-safe.
class DriveBag {
 public:
  /// Throws as McapWriter does.
  DriveBag(const std::filesystem::path& file, const StereoCalibration& calibration,
           const DriveBagOptions& options);

  /// The pair, its camera_info and its truth; left and right in colour (B, G, R), and what wheels
  /// say, if there are any: of all frames, or of none.
  void AddFrame(const SequenceFrame& frame, const std::array<cv::Mat3b, 2>* colour = nullptr,
                const OdometryReading* wheels = nullptr);
  /// What a system said of a frame, with its events: found and lost, keyframe, loop. `truth` lays
  /// its world onto map; null where nobody knows it.
  void AddEstimate(const std::string& system, const FrameEstimate& estimate,
                   const FrameTruth* truth);
  /// A line of /SYSTEM/events. `level` is ros::kInfo, kWarning or kError.
  void AddEvent(const std::string& system, std::int64_t stamp_ns, std::uint8_t level,
                const std::string& text);
  /// What it says in the end of where it was.
  void AddFinalTrack(const std::string& system, const Trajectory& track);

  /// A still picture that stands from the first stamp on, with a line of text in it.
  void AddStill(const std::string& topic, const cv::Mat1b& picture, const std::string& text);

  void AddMetadata(const std::string& name, const std::map<std::string, std::string>& values) {
    writer_.AddMetadata(name, values);
  }
  /// A file that goes along: the scene, say.
  void Attach(const std::string& name, const std::string& media_type, std::string_view bytes);

  /// A message of another bag of the same drive, with its stamp as it is there.
  void Copy(const BagChannel& channel, std::int64_t log_ns, std::string_view message);

  /// Writes the paths, and closes the file. The writer then says what is in it.
  const McapWriter& Finish();

 private:
  struct Track {
    ros::Path live;
    TrackingState state = TrackingState::kInitializing;
    bool placed = false;  ///< its world is laid onto map
    int map_id = 0;       ///< of that world
    std::string world;    ///< its frame
  };
  ros::Header HeaderOf(std::int64_t stamp_ns, const std::string& frame) const;
  void WriteRigFrames(std::int64_t stamp_ns, bool odom_drifts);
  void WriteTruePose(std::int64_t stamp_ns, const Eigen::Isometry3d& T_world_rig,
                     const OdometryReading* wheels);
  template <class T>
  void Write(const std::string& topic, std::int64_t stamp_ns, const T& message,
             TopicKind kind = TopicKind::kStream);
  void EnterWorld(const std::string& system, const FrameEstimate& estimate, Track* track);
  void WriteEvents(const std::string& system, const FrameEstimate& estimate, TrackingState before);

  const StereoCalibration calibration_;
  const DriveBagOptions options_;
  McapWriter writer_;
  std::optional<std::int64_t> first_ns_;  ///< stamp of the first frame or estimate
  bool has_rig_ = false;
  ros::Path truth_;
  std::map<std::string, Track> tracks_;
};

}  // namespace aisle
