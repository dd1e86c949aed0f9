#include "harness/bag/drive_bag.h"

#include <opencv2/imgproc.hpp>

#include "harness/bag/frame_messages.h"
#include "harness/contract/map_id.h"
#include "harness/contract/state_name.h"
#include "harness/io/input_error.h"
#include "harness/io/truth_files.h"

namespace aisle {
namespace {

constexpr const char *kOdomFrame = "odom", *kBaseFrame = "base_link";
constexpr double kMillimetres = 1000;  ///< a metre, as REP 118 has depth in 16 bits
constexpr const char* kRightFrame = "camera_right_optical_frame";

int CountOf(const FrameEstimate& estimate, const char* name) {
  const auto found = estimate.counts.find(name);
  return found == estimate.counts.end() ? 0 : found->second;
}

ros::TransformStamped Child(const ros::Header& header, const std::string& child,
                            const Eigen::Isometry3d& T_parent_child) {
  ros::TransformStamped transform;
  transform.header = header;
  transform.child_frame_id = child;
  transform.transform = ros::TransformOf(T_parent_child);
  return transform;
}

ros::PoseStamped Stamped(const ros::Header& header, const Eigen::Isometry3d& T_frame_rig) {
  ros::PoseStamped pose;
  pose.header = header;
  pose.pose = ros::PoseOf(T_frame_rig);
  return pose;
}

}  // namespace

std::string RosName(const std::string& name) {
  std::string plain;
  for (const char c : name) {
    plain += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  }
  const bool good = !plain.empty() && std::isalpha(static_cast<unsigned char>(plain.front()));
  return good ? plain : "s_" + plain;
}

void RequireOwnTopics(const std::vector<std::string>& systems) {
  std::map<std::string, std::string> owners;  // by what topics are named with
  for (const char* ours : {"left", "right", "truth"}) owners[ours] = "";
  for (const std::string& system : systems) {
    const auto [owner, is_new] = owners.try_emplace(RosName(system), system);
    if (is_new || owner->second == system) continue;
    throw InputError(
        owner->second.empty()
            ? fmt::format("a bag keeps the scene's topics at /{}: choose another name than '{}' "
                          "for the system",
                          owner->first, system)
            : fmt::format("the systems '{}' and '{}' would share the topics /{}/… of a bag: "
                          "rename one",
                          owner->second, system, owner->first));
  }
}

DriveBag::DriveBag(const std::filesystem::path& file, const StereoCalibration& calibration,
                   const DriveBagOptions& options)
    : calibration_(calibration), options_(options), writer_(file, options.mcap) {}

ros::Header DriveBag::HeaderOf(std::int64_t stamp_ns, const std::string& frame) const {
  ros::Header header;
  header.stamp = ros::TimeOf(stamp_ns + options_.epoch_ns);
  header.frame_id = frame;
  return header;
}

template <class T>
void DriveBag::Write(const std::string& topic, std::int64_t stamp_ns, const T& message,
                     TopicKind kind) {
  writer_.Write(writer_.AddChannel<T>(topic, kind), stamp_ns + options_.epoch_ns, message);
}

void DriveBag::WriteRigFrames(std::int64_t stamp_ns, bool odom_drifts) {
  if (!first_ns_) first_ns_ = stamp_ns;
  if (has_rig_) return;
  has_rig_ = true;
  Eigen::Isometry3d T_left_right = Eigen::Isometry3d::Identity();
  T_left_right.translation().x() = calibration_.baseline_m;
  ros::TFMessage rig;
  rig.transforms = {Child(HeaderOf(stamp_ns, kBaseFrame), kLeftFrame, options_.T_base_rig),
                    Child(HeaderOf(stamp_ns, kLeftFrame), kRightFrame, T_left_right)};
  if (!odom_drifts) {
    rig.transforms.push_back(
        Child(HeaderOf(stamp_ns, kMapFrame), kOdomFrame, Eigen::Isometry3d::Identity()));
  }
  Write("/tf_static", stamp_ns, rig, TopicKind::kLatched);
}

void DriveBag::WriteTruePose(std::int64_t stamp_ns, const Eigen::Isometry3d& T_world_rig,
                             const OdometryReading* wheels) {
  const ros::Header map = HeaderOf(stamp_ns, kMapFrame), odom = HeaderOf(stamp_ns, kOdomFrame);
  const Eigen::Isometry3d T_map_base = T_world_rig * options_.T_base_rig.inverse();
  ros::TFMessage tf;
  if (wheels == nullptr) {
    tf.transforms = {Child(odom, kBaseFrame, T_map_base)};
  } else {
    tf.transforms = {Child(map, kOdomFrame, T_map_base * wheels->T_odom_base.inverse()),
                     Child(odom, kBaseFrame, wheels->T_odom_base)};
  }
  Write("/tf", stamp_ns, tf);
  truth_.poses.push_back(Stamped(map, T_world_rig));
  Write("/truth/pose", stamp_ns, truth_.poses.back());
}

void DriveBag::AddFrame(const SequenceFrame& frame, const std::array<cv::Mat3b, 2>* colour,
                        const OdometryReading* wheels) {
  const std::int64_t stamp_ns = frame.images.stamp_ns;
  WriteRigFrames(stamp_ns, wheels != nullptr);
  const ros::Header left = HeaderOf(stamp_ns, kLeftFrame), right = HeaderOf(stamp_ns, kRightFrame);
  if (wheels != nullptr) {
    Write("/odom", stamp_ns, OdometryMessage(HeaderOf(stamp_ns, kOdomFrame), kBaseFrame, *wheels));
  }
  if (frame.truth) WriteTruePose(stamp_ns, frame.truth->T_world_rig, wheels);
  Write("/left/camera_info", stamp_ns, CameraInfoMessage(left, calibration_, 0));
  Write("/right/camera_info", stamp_ns, CameraInfoMessage(right, calibration_, 1));
  Write("/left/image_rect", stamp_ns, ImageMessage(left, frame.images.left));
  Write("/right/image_rect", stamp_ns, ImageMessage(right, frame.images.right));
  if (colour != nullptr) {
    Write("/left/image_rect_color", stamp_ns, ColourMessage(left, (*colour)[0]));
    Write("/right/image_rect_color", stamp_ns, ColourMessage(right, (*colour)[1]));
  }
  if (!frame.truth) return;
  const FrameTruth& truth = *frame.truth;
  if (!truth.depth.empty()) {
    Write("/left/depth", stamp_ns, ImageMessage(left, DepthInSteps(truth.depth, kMillimetres)));
  }
  if (truth.dynamic.empty()) return;  // nothing is known of what moves
  Write("/left/moving", stamp_ns, ImageMessage(left, truth.dynamic));
  Write("/left/boxes", stamp_ns, ImageBoxes(left, truth.objects));
  Write("/truth/boxes", stamp_ns, BoxMarkers(HeaderOf(stamp_ns, kMapFrame), truth.objects));
}

void DriveBag::AddEvent(const std::string& system, std::int64_t stamp_ns, std::uint8_t level,
                        const std::string& text) {
  ros::Log log;
  log.stamp = ros::TimeOf(stamp_ns + options_.epoch_ns);
  log.level = level;
  log.name = system;
  log.msg = text;
  Write(fmt::format("/{}/events", RosName(system)), stamp_ns, log);
}

void DriveBag::WriteEvents(const std::string& system, const FrameEstimate& estimate,
                           TrackingState before) {
  const std::int64_t at_ns = estimate.stamp_ns;
  if (estimate.state != before) {
    const bool lost = estimate.state == TrackingState::kLost;
    AddEvent(system, at_ns, lost ? ros::kError : ros::kInfo,
             fmt::format("{}, frame {}", StateName(estimate.state), estimate.id));
  }
  if (CountOf(estimate, "keyframe") > 0) {
    AddEvent(system, at_ns, ros::kInfo, fmt::format("keyframe, frame {}", estimate.id));
  }
  if (CountOf(estimate, "loop_closed") > 0) {
    AddEvent(system, at_ns, ros::kWarning, fmt::format("loop closed, frame {}", estimate.id));
  }
}

/// Poses of one frame of reference must be of one world: each has a frame of its own.
void DriveBag::EnterWorld(const std::string& system, const FrameEstimate& estimate, Track* track) {
  if (!track->world.empty()) {
    AddEvent(system, estimate.stamp_ns, ros::kError,
             fmt::format("map given up, another begun, frame {}", estimate.id));
  }
  track->map_id = MapIdOf(estimate);
  track->world = RosName(system) + "/map";
  if (track->map_id != 0) track->world += fmt::format("_{}", track->map_id);
  track->placed = false;
  track->live.poses.clear();
}

void DriveBag::AddEstimate(const std::string& system, const FrameEstimate& estimate,
                           const FrameTruth* truth) {
  const std::int64_t stamp_ns = estimate.stamp_ns;
  if (!first_ns_) first_ns_ = stamp_ns;
  const std::string name = RosName(system), topic = fmt::format("/{}", name);
  Track& track = tracks_[system];
  if (track.world.empty() || track.map_id != MapIdOf(estimate))
    EnterWorld(system, estimate, &track);
  const std::string& world = track.world;
  ros::String state;
  state.data = StateName(estimate.state);
  Write(topic + "/state", stamp_ns, state);
  WriteEvents(system, estimate, track.state);
  track.state = estimate.state;
  if (!estimate.regions.mask.empty()) {
    Write("/left/rejected_" + name, stamp_ns,
          ImageMessage(HeaderOf(stamp_ns, kLeftFrame), estimate.regions.mask));
  }
  if (!estimate.T_world_rig) return;
  const Eigen::Isometry3d& T_world_rig = *estimate.T_world_rig;
  if (!track.placed) {
    track.placed = true;
    const Eigen::Isometry3d T_map_world = truth == nullptr
                                              ? Eigen::Isometry3d::Identity()
                                              : truth->T_world_rig * T_world_rig.inverse();
    ros::TFMessage placed;
    placed.transforms = {Child(HeaderOf(stamp_ns, kMapFrame), world, T_map_world)};
    Write("/tf_static", stamp_ns, placed, TopicKind::kLatched);
  }
  const ros::Header header = HeaderOf(stamp_ns, world);
  ros::TFMessage tf;
  tf.transforms = {Child(header, name + "/base_link", T_world_rig * options_.T_base_rig.inverse())};
  Write("/tf", stamp_ns, tf);
  track.live.poses.push_back(Stamped(header, T_world_rig));
  Write(topic + "/pose", stamp_ns, track.live.poses.back());
}

void DriveBag::AddFinalTrack(const std::string& system, const Trajectory& trajectory) {
  if (trajectory.empty() || !first_ns_) return;
  const std::string& world = tracks_[system].world;
  ros::Path path;
  path.header = HeaderOf(*first_ns_, world);
  for (const StampedPose& pose : trajectory) {
    path.poses.push_back(Stamped(HeaderOf(pose.stamp_ns, world), pose.T_world_rig));
  }
  Write(fmt::format("/{}/final_path", RosName(system)), *first_ns_, path, TopicKind::kLatched);
}

void DriveBag::AddStill(const std::string& topic, const cv::Mat1b& picture,
                        const std::string& text) {
  constexpr int kMargin = 6;
  const double size = std::clamp(picture.cols / 900.0, 0.3, 1.5);
  cv::Mat1b still = picture.clone();
  const cv::Point at(kMargin, still.rows - kMargin);
  for (const auto& [grey, width] : {std::pair{0.0, 4}, std::pair{255.0, 1}}) {
    cv::putText(still, text, at, cv::FONT_HERSHEY_SIMPLEX, size, cv::Scalar(grey), width,
                cv::LINE_AA);
  }
  const std::int64_t stamp_ns = first_ns_.value_or(0);
  Write(topic, stamp_ns, ImageMessage(HeaderOf(stamp_ns, kLeftFrame), still), TopicKind::kLatched);
}

void DriveBag::Attach(const std::string& name, const std::string& media_type,
                      std::string_view bytes) {
  writer_.Attach(name, media_type, first_ns_.value_or(0) + options_.epoch_ns, bytes);
}

void DriveBag::Copy(const BagChannel& channel, std::int64_t log_ns, std::string_view message) {
  writer_.Write(writer_.AddChannel(channel), log_ns, message);
}

/// Paths stand at the first stamp, so that viewers show them from the beginning.
const McapWriter& DriveBag::Finish() {
  if (!truth_.poses.empty()) {
    truth_.header = HeaderOf(*first_ns_, kMapFrame);
    Write("/truth/path", *first_ns_, truth_, TopicKind::kLatched);
  }
  for (auto& [system, track] : tracks_) {
    if (track.live.poses.empty()) continue;
    track.live.header = HeaderOf(*first_ns_, track.world);
    Write(fmt::format("/{}/path", RosName(system)), *first_ns_, track.live, TopicKind::kLatched);
  }
  writer_.Finish();
  return writer_;
}

}  // namespace aisle
