#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/contract/sequence.h"
#include "harness/contract/wheel_track.h"
#include "harness/io/trajectory.h"

namespace aisle {

enum class DatasetFormat {
  kEuroc,  ///< ASL: mav0/{cam0, cam1, imu0, state_groundtruth_estimate0}
  kKitti,  ///< odometry: sequences/00/{image_0, image_1}, poses/00.txt
  kTum,    ///< RGB-D folder with the right camera beside: rgb, right, depth
};
/// "euroc", "kitti", "tum"; throws InputError naming the choices.
DatasetFormat DatasetFormatFromName(const std::string& name);

/// Which truth is written beside the images, below truth/; each kind in folders of its own, each
/// file named as the left image it belongs to. truth/README.md says it all to who finds the folder.
struct TruthSelection {
  bool depth = false;  ///< both cameras as PFM (float metres, inf where nothing was hit), and the
                       ///< left as 16-bit PNG in millimetres (0: nothing, or beyond 65.535 m)
  bool labels =
      false;  ///< both cameras: instance ids, 16-bit PNG, and classes, 8-bit PNG; labels.json
  bool dynamic = false;  ///< what moves now (both cameras) and every actor, 8-bit PNG, 255 = yes
  bool boxes = false;    ///< boxes/*.json: per object 2-D boxes, 3-D box, velocity
  bool flow = false;     ///< to the next frame, .flo; scene flow, PFM of 3 channels: x, y, z
                         ///< (metres, world)
  bool stereo = false;   ///< disparity, PFM; pixels hidden from the right camera, 8-bit PNG
  bool shadows = false;  ///< pixels in moving shadows, 8-bit PNG

  bool NeedsMotion() const { return flow || stereo || shadows; }
};
/// Names as above in any order, or "all"; throws InputError.
TruthSelection TruthSelectionFromNames(const std::vector<std::string>& names);

/// One entry of labels.json.
struct LabelInfo {
  std::string name, object_class;
  std::uint8_t class_id = 0;
  bool moving = false;  ///< may move at some time
};

/// Truth that joins a frame to its right camera and to the next frame, and its moving shadows.
struct FrameMotion {
  cv::Mat1f disparity;      ///< of the rectified pair, pixels; 0 where nothing was hit
  cv::Mat1b occluded;       ///< 255 where the right camera does not see the point
  cv::Mat2f flow;           ///< pixels; NaN where unknown
  cv::Mat3f scene_flow;     ///< metres, world
  cv::Mat1b moving_shadow;  ///< 255 = yes
};

/// Left and right picture in colour: B, G, R.
using ColourPair = std::array<cv::Mat3b, 2>;

/// How the lenses of both cameras bend the image, as EuRoC's sensor.yaml says it: "none",
/// "radial-tangential" (k1 k2 p1 p2) or "equidistant" (k1 k2 k3 k4).
struct LensCalibration {
  std::string model = "none";
  std::array<double, 4> coefficients = {0, 0, 0, 0};
};

struct ExportOptions {
  DatasetFormat format = DatasetFormat::kEuroc;
  TruthSelection truth = {};
  /// The true trajectory goes along (EuRoC's state_groundtruth_estimate0, KITTI's poses, TUM's
  /// groundtruth.txt); not to a system under test.
  bool true_trajectory = true;
  /// Added to every stamp of EuRoC and TUM: readers treat 0 as missing. 2020-09-13T12:26:40Z.
  std::int64_t epoch_ns = 1'600'000'000'000'000'000;
  double imu_rate_hz = 200;
  LensCalibration lens = {};
  bool colour =
      false;  ///< colour pictures go along: cam0_rgb, image_2, rgb_colour and their rights
  std::vector<LabelInfo> labels = {};  ///< by instance id
  /// What the frames were made of, for aisle.json; a folder with another is not continued.
  std::map<std::string, std::string> provenance = {};
};

/// Pose of the rig between frames, for the ideal IMU: T_world_rig at a time from the start.
using PathOfRig = std::function<Eigen::Isometry3d(std::int64_t stamp_ns)>;

/// Writes frames as they come; every image is whole or absent, and one that is there already is
/// kept. The index files are written by Finish, last: without them the folder is no dataset yet.
///
/// A dataset begins wherever in its source its first frame lies, and is numbered by itself: KITTI's
/// images from 000000, its poses relative to the first, its times from 0, since its readers know
/// frames by their row alone. EuRoC's and TUM's are named by the source's time plus epoch_ns.
/// aisle.json says where in the source it begins.
class DatasetWriter {
 public:
  /// `frames` are all frames of the dataset in order, those already there included. Throws
  /// InputError for a lens that the format cannot state: KITTI and TUM hold rectified images.
  /// Throws std::invalid_argument without a frame.
  DatasetWriter(std::filesystem::path folder, const StereoCalibration& calibration, double rate_hz,
                std::vector<FrameRequest> frames, const ExportOptions& options);

  /// Writes aisle.json, or finds the same one there. A folder that was begun may only grow at its
  /// end: throws InputError where it begins with another frame, has more frames than these, or was
  /// made of something else.
  void Begin() const;

  /// What the frame's images and truth files are called, without ending.
  std::string NameOf(const FrameRequest& request) const;
  /// All files of this frame are already there.
  bool Has(const FrameRequest& request) const;
  /// Needs truth, and motion and colour where the options do; throws std::invalid_argument without.
  void Add(const SequenceFrame& frame, const FrameMotion* motion = nullptr,
           const ColourPair* colour = nullptr);
  /// Once all frames are there. Clears away what earlier, killed writers left half written.
  void Finish(const PathOfRig& path) const;

 private:
  /// Place of a frame in the dataset, from 0; throws std::invalid_argument for one of another.
  std::int64_t NumberOf(std::int64_t id) const;
  /// What a stamp of the dataset is more than the source's.
  std::int64_t StampOffset() const;
  std::vector<std::filesystem::path> ImagePaths(const std::string& name) const;
  std::vector<std::filesystem::path> ColourPaths(const std::string& name) const;

  const std::filesystem::path folder_;
  const StereoCalibration calibration_;
  const double rate_hz_;
  const std::vector<FrameRequest> frames_;
  const ExportOptions options_;
};

/// Where a system finds the calibration of an exported dataset.
std::filesystem::path CalibrationPath(const std::filesystem::path& folder, DatasetFormat format);

// --- Reading
// --------------------------------------------------------------------------------------

/// One camera of a recording as its calibration file states it.
struct CameraCalibration {
  int width = 0, height = 0;
  double fx = 0, fy = 0, cx = 0, cy = 0;
  std::vector<double>
      distortion;  ///< k1 k2 p1 p2 [k3], or an equidistant lens's k1 k2 k3 k4; empty: none
  bool equidistant = false;
  Eigen::Isometry3d T_body_camera = Eigen::Isometry3d::Identity();
};

/// What a recording says itself of how an eye is brought onto the common plane, as ROS's
/// camera_info does.
struct StatedRectification {
  Eigen::Matrix3d R_rectified_camera = Eigen::Matrix3d::Identity();
  /// Of the rectified camera; the right one's last column begins with -fx times the baseline.
  Eigen::Matrix<double, 3, 4> projection = Eigen::Matrix<double, 3, 4>::Zero();
};

/// Both eyes of a rig.
struct StereoCameras {
  CameraCalibration left, right;
  /// Left and right; where absent, the rectification is computed from the cameras' poses.
  std::optional<std::array<StatedRectification, 2>> stated = {};
};

struct StereoRecording {
  StereoCameras cameras;
  struct Pair {
    std::int64_t stamp_ns = 0;
    std::filesystem::path left, right;  ///< files, or what messages call the images
  };
  std::vector<Pair> pairs;
  Trajectory truth;                     ///< empty where the dataset has none
  std::vector<std::string> notes = {};  ///< what a reader should know: it ends too early, say
  /// An image of pair number `pair`, side 0 left, 1 right; from any thread. Throws InputError.
  std::function<cv::Mat1b(std::size_t pair, int side)> read_image = {};
  /// Its vehicle's wheels, of recordings that have them. Throws InputError.
  std::function<WheelTrack()> read_wheels = {};
};

/// EuRoC (the folder that holds mav0, or mav0 itself) or KITTI odometry (a sequence's folder, or
/// the one that holds sequences/NN with a single sequence). EuRoC's images are paired by stamp, 1
/// ms apart at most, KITTI's by their number; `notes` say how many find no other. Throws InputError
/// with file, line and what is missing: an image that is listed, or half of the pairs.
StereoRecording ReadRecording(const std::filesystem::path& folder, DatasetFormat format);

/// Files and folders with the truth of such a folder that do not lie below it: poses beside a
/// sequence of KITTI, and what links lead to. Only those that are there.
std::vector<std::filesystem::path> TruthAround(const std::filesystem::path& folder);

}  // namespace aisle
