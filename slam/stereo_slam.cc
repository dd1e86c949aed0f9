#include "slam/stereo_slam.h"

#include <fmt/format.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <stdexcept>

#include "slam/background_job.h"
#include "slam/dynamic/dynamic_detector.h"
#include "slam/dynamic/stopwatch.h"
#include "slam/feature/extract.h"
#include "slam/foresight.h"
#include "slam/local_mapping.h"
#include "slam/loop_closing.h"
#include "slam/map/map.h"
#include "slam/map/map_file.h"
#include "slam/relocalise.h"
#include "slam/stereo/match_stereo.h"
#include "slam/track/keyframe_policy.h"
#include "slam/track/track_frame.h"

namespace aisle::slam {
namespace {

using dynamic::Stopwatch;

/// The deviations grow as the confidence in the pixel falls: information times confidence.
Measurement Measure(const Keypoint& keypoint, const Disparity& disparity, double sigma_px,
                    const cv::Mat1f& confidence) {
  constexpr float kLeast = 1e-4F;  // a pixel worth nothing belongs under a mask
  const float trust = confidence.empty() ? 1.0F : confidence(cv::Point(keypoint.pixel));
  const double widen = 1 / std::sqrt(std::clamp(trust, kLeast, 1.0F));
  return {{keypoint.pixel.x, keypoint.pixel.y, disparity.value},
          widen * sigma_px,
          widen * disparity.sigma};
}

/// What one stage's options say to another's.
SlamOptions Completed(SlamOptions options) {
  options.mapping.fuse.levels = options.feature.levels;
  return options;
}

/// What either mask rejects; an empty one rejects nothing.
cv::Mat1b Union(const cv::Mat1b& a, const cv::Mat1b& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  cv::Mat1b both;
  cv::bitwise_or(a, b, both);
  return both;
}

}  // namespace

struct StereoSlam::Impl {
  Impl(const StereoCamera& camera_in, const SlamOptions& options_in)
      : camera(camera_in),
        options(Completed(options_in)),
        detector(camera, options.dynamic),
        arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic) {
    for (const std::string& error : {Validate(camera), Validate(options)}) {
      if (!error.empty()) throw std::invalid_argument("StereoSlam: " + error);
    }
    if (!options.vocabulary_file.empty()) vocabulary = Vocabulary::Load(options.vocabulary_file);
    if (!options.map_file.empty()) GoOnIn(LoadMap(options.map_file));
  }

  TrackedFrame Track(const StereoImages& images, const ExternalMask& mask);
  void CheckImages(const StereoImages& images, const ExternalMask& mask) const;
  ExternalMask RejectMovers(const StereoImages& images, const ExternalMask& mask,
                            TrackedFrame& result);
  std::shared_ptr<const Frame> SeeFrame(const StereoImages& images, const ExternalMask& mask,
                                        std::map<std::string, double>& stage_ms);
  std::optional<FramePose> FindPose(const Frame& frame);
  std::optional<FramePose> StartPart(const std::shared_ptr<const Frame>& frame);
  std::optional<FramePose> Relocalise(const Frame& frame);
  void GoOnIn(const SavedMap& saved);
  void Index(KeyframeId id);
  void ForgetMap();
  void FinishBackgroundWork();
  bool IsTimeForANewPart(std::int64_t stamp_ns) const;
  bool IsInFirstPart() const;
  void InsertKeyframe(const std::shared_ptr<const Frame>& frame, const FramePose& pose);
  void Remember(const Frame& frame, const FramePose& pose);
  void WaitForBackgroundWork() const { mapping.Wait(), closing.Wait(), adjusting.Wait(); }
  bool Busy() const { return mapping.pending() || closing.pending(); }
  bool TakeBackgroundWork(std::int64_t frame_now, std::map<std::string, double>& stage_ms);
  void TakeMapping(MappingResult result, std::int64_t frame_now);
  void TakeClosing(Map closed, std::int64_t frame_now);

  const StereoCamera camera;
  const SlamOptions options;
  DynamicDetector detector;
  tbb::task_arena arena;

  Map map;
  TrackMemory memory;
  TrackingState state = TrackingState::kInitializing;  // kTracking in any part of the map
  std::optional<std::int64_t> lost_since_ns;  // first frame that shows something but has no pose
  std::int64_t frame_count = 0;
  std::map<LandmarkId, std::pair<int, int>> counts;  // predicted and found since the last keyframe

  /// A tracked frame as the trajectory keeps it: its place relative to a keyframe.
  struct Anchored {
    std::int64_t stamp_ns;
    KeyframeId reference;
    Eigen::Isometry3d T_reference_rig;
  };
  std::vector<Anchored> trajectory;

  std::optional<Vocabulary> vocabulary;
  PlaceIndex index;             // of the keyframes that mapping is done with
  std::vector<LoopEdge> loops;  // seen of late, waiting for others to agree

  // At most one of the first two is under way, on a copy of the map; neither map nor index changes
  // until its result is taken. The third runs beside them, and its result is carried over to what
  // the map has become. Declared last: they end before what they read.
  BackgroundJob<MappingResult> mapping;
  BackgroundJob<Map> closing;
  BackgroundJob<GlobalCorrection> adjusting;
};

TrackedFrame StereoSlam::Impl::Track(const StereoImages& images, const ExternalMask& mask) {
  CheckImages(images, mask);
  TrackedFrame result;
  result.id = images.id;
  result.stamp_ns = images.stamp_ns;
  const auto frame = SeeFrame(images, RejectMovers(images, mask, result), result.stage_ms);
  result.loop_closed = TakeBackgroundWork(frame_count, result.stage_ms);

  Stopwatch track_time(result.stage_ms["track"]);
  std::optional<FramePose> pose = map.empty() ? std::nullopt : FindPose(*frame);
  // One job at a time: the next keyframe waits for the appointed frame, not for a thread.
  if (pose) {
    result.is_keyframe = !options.localise_only && !Busy() &&
                         NeedsKeyframe(map, *frame, *pose, camera, options.keyframe);
    if (result.is_keyframe) InsertKeyframe(frame, *pose);
  } else if (map.empty() || IsTimeForANewPart(images.stamp_ns)) {
    pose = StartPart(frame);
    result.is_keyframe = pose.has_value();
  }

  if (pose) {
    Remember(*frame, *pose);
    lost_since_ns.reset();
  } else if (!lost_since_ns && frame->size() >= options.least_first_points) {
    lost_since_ns = images.stamp_ns;
  }
  state = pose          ? TrackingState::kTracking
          : map.empty() ? TrackingState::kInitializing
                        : TrackingState::kLost;
  ++frame_count;

  const bool apart = pose && !IsInFirstPart();
  result.state = apart ? TrackingState::kApart : state;
  result.map_keyframes = static_cast<int>(map.keyframes().size());
  result.map_landmarks = map.landmark_count();
  result.features = frame->size();
  result.keypoint_is_inlier.assign(static_cast<std::size_t>(frame->size()), false);
  for (int i = 0; i < frame->size(); ++i) {
    const auto feature = static_cast<std::size_t>(i);
    result.keypoints.push_back(frame->features.keypoints[feature].pixel);
    result.stereo_points += frame->measurements[feature].has_depth();
  }
  if (!pose) return result;
  if (!apart) result.T_world_rig = pose->pose.T_rig_world.inverse();
  result.matched_points = static_cast<int>(pose->matches.size());
  result.inliers = pose->pose.inliers;
  for (std::size_t i = 0; i < pose->matches.size(); ++i) {
    result.keypoint_is_inlier[static_cast<std::size_t>(pose->matches[i].feature)] =
        pose->pose.inlier[i];
  }
  return result;
}

void StereoSlam::Impl::CheckImages(const StereoImages& images, const ExternalMask& mask) const {
  const cv::Size size(camera.width, camera.height);
  const auto check = [&](const cv::Mat& image, const char* name, bool may_be_empty) {
    if (image.size() == size || (may_be_empty && image.empty())) return;
    throw std::invalid_argument(fmt::format("frame {}: {} is {}x{}, the camera {}x{} pixels",
                                            images.id, name, image.cols, image.rows, size.width,
                                            size.height));
  };
  check(images.left, "the left image", false);
  check(images.right, "the right image", false);
  check(mask.left, "the left mask", true);
  check(mask.right, "the right mask", true);
  check(mask.confidence, "the confidence", true);
}

/// The caller's mask and what the detector finds moving, together; the latter is noted in `result`.
ExternalMask StereoSlam::Impl::RejectMovers(const StereoImages& images, const ExternalMask& mask,
                                            TrackedFrame& result) {
  if (options.dynamic.method == DynamicMethod::kNone) return mask;
  Stopwatch time(result.stage_ms["dynamic"]);
  DynamicInput input{images.stamp_ns, images.left, images.right, std::nullopt};
  if (state == TrackingState::kTracking) {
    input.T_now_before = ForeseeMotion(memory, images.stamp_ns, options.track);
  }
  DynamicOutput found;
  arena.execute([&] { found = detector.Detect(input); });
  result.dynamic = std::move(found.regions);
  return {Union(mask.left, result.dynamic.mask), Union(mask.right, found.mask_right),
          mask.confidence};
}

std::shared_ptr<const Frame> StereoSlam::Impl::SeeFrame(const StereoImages& images,
                                                        const ExternalMask& mask,
                                                        std::map<std::string, double>& stage_ms) {
  EyeFeatures left, right;
  {
    Stopwatch time(stage_ms["extract"]);
    arena.execute([&] {
      tbb::parallel_invoke(
          [&] { left = ExtractFeatures(images.left, mask.left, options.feature); },
          [&] { right = ExtractFeatures(images.right, mask.right, options.feature); });
    });
  }
  Stopwatch time(stage_ms["stereo"]);
  const std::vector<Disparity> disparities = MatchStereo(left, right, camera, options.stereo);
  auto frame = std::make_shared<Frame>();
  frame->id = images.id;
  frame->stamp_ns = images.stamp_ns;
  frame->scale = options.feature.scale;
  for (std::size_t i = 0; i < disparities.size(); ++i) {
    const Keypoint& keypoint = left.features.keypoints[i];
    const double scale = left.pyramid.scales[static_cast<std::size_t>(keypoint.level)];
    frame->measurements.push_back(
        Measure(keypoint, disparities[i], scale * options.keypoint_noise_px, mask.confidence));
  }
  frame->grid = FeatureGrid(left.features.keypoints, images.left.size());
  frame->features = std::move(left.features);
  return frame;
}

/// Takes what is due; true where a loop has been closed.
bool StereoSlam::Impl::TakeBackgroundWork(std::int64_t frame_now,
                                          std::map<std::string, double>& stage_ms) {
  double& wait_ms = stage_ms["wait_for_mapping"];
  const bool anytime = options.schedule.free_running;
  if (auto result = mapping.TakeIfDue(frame_now, wait_ms, anytime)) {
    stage_ms["mapping"] = result->milliseconds;
    TakeMapping(std::move(*result), frame_now);
  }
  // Not while a keyframe is being worked in: the result of that would undo the correction.
  if (!Busy()) {
    if (auto correction = adjusting.TakeIfDue(frame_now, wait_ms, anytime)) {
      stage_ms["global"] = correction->milliseconds;
      map.Apply(CarryOver(map, *correction));
    }
  }
  auto closed = closing.TakeIfDue(frame_now, wait_ms, anytime);
  if (closed) TakeClosing(std::move(*closed), frame_now);
  return closed.has_value();
}

/// Takes everything that is under way, due or not. Mapping may start the closing of a loop, and
/// that the adjustment of the map, which are waited for as well.
void StereoSlam::Impl::FinishBackgroundWork() {
  std::map<std::string, double> stage_ms;
  while (Busy() || adjusting.pending()) {
    WaitForBackgroundWork();
    TakeBackgroundWork(std::max({mapping.due_frame(), closing.due_frame(), adjusting.due_frame()}),
                       stage_ms);
  }
}

void StereoSlam::Impl::TakeMapping(MappingResult result, std::int64_t frame_now) {
  map = std::move(result.map);
  if (!vocabulary) return;
  index.Add(result.keyframe, result.words);
  for (const KeyframeId gone : result.culled) index.Remove(gone);
  std::erase_if(loops, [&](const LoopEdge& loop) {
    return loop.current.value + options.loop.remembered < result.keyframe.value;
  });
  if (!result.loop || adjusting.pending()) return;
  loops.push_back(*result.loop);
  const std::vector<LoopEdge> agreeing = AgreeingLoops(map, loops, options.loop);
  if (agreeing.empty()) return;
  loops.clear();
  const auto keyframes = static_cast<std::int64_t>(map.keyframes().size());
  closing.Start(frame_now + options.schedule.loop_frames +
                    keyframes / options.schedule.keyframes_per_loop_frame,
                options.schedule.background,
                [map = map, agreeing, this] { return CloseLoop(map, agreeing, camera, options); });
}

/// Tracking goes on in the closed map, which is made exact meanwhile.
void StereoSlam::Impl::TakeClosing(Map closed, std::int64_t frame_now) {
  map = std::move(closed);
  const auto keyframes = static_cast<std::int64_t>(map.keyframes().size());
  adjusting.Start(frame_now + options.schedule.global_frames +
                      keyframes / options.schedule.keyframes_per_global_frame,
                  options.schedule.background,
                  [map = map, this] { return CorrectGlobally(map, camera, options); });
}

std::optional<FramePose> StereoSlam::Impl::FindPose(const Frame& frame) {
  if (state == TrackingState::kLost) return Relocalise(frame);
  return TrackFrame(map, frame, memory, camera, options.feature.levels, options.track);
}

/// Looks where the rig must be by now, then asks a few keyframes a frame for their view of it.
std::optional<FramePose> StereoSlam::Impl::Relocalise(const Frame& frame) {
  if (auto pose = FindAgain(map, frame, memory, camera, options.feature.levels, options.track)) {
    return pose;
  }
  const Vocabulary* words = vocabulary ? &*vocabulary : nullptr;
  for (const KeyframeId id :
       KeyframesToAsk(map, frame, memory.reference, words, index, frame_count)) {
    auto pose = LocateByKeyframe(map, frame, id, camera, options.feature.levels, options.track);
    if (pose) return pose;
  }
  return std::nullopt;
}

void StereoSlam::Impl::GoOnIn(const SavedMap& saved) {
  if (saved.camera != camera) {
    throw std::runtime_error(options.map_file +
                             ": was made with another camera; the map of a rig serves that rig, as "
                             "it was calibrated then");
  }
  map = saved.map;
  for (const auto& [id, keyframe] : map.keyframes()) {
    if (keyframe->frame->scale != options.feature.scale) {
      throw std::runtime_error(fmt::format("{}: was made with feature.scale = {}, not {}",
                                           options.map_file, keyframe->frame->scale,
                                           options.feature.scale));
    }
    Index(id);
  }
  memory.reference = saved.reference;
  state = TrackingState::kLost;
}

void StereoSlam::Impl::Index(KeyframeId id) {
  if (vocabulary) index.Add(id, vocabulary->Describe(map.At(id).frame->features.descriptors));
}

/// What was lost so soon is not worth keeping: the world begins anew.
void StereoSlam::Impl::ForgetMap() {
  map = {};
  index = {};
  counts.clear();
  loops.clear();
  trajectory.clear();
}

/// Whether the rig has been lost with open eyes for so long that it may be somewhere new.
bool StereoSlam::Impl::IsTimeForANewPart(std::int64_t stamp_ns) const {
  if (options.localise_only || !vocabulary || !lost_since_ns) return false;
  if (Busy() || adjusting.pending()) return false;
  return static_cast<double>(stamp_ns - *lost_since_ns) * 1e-9 >= options.new_part_after_s;
}

/// The first part of the map, or the map that was loaded, is where the world is.
bool StereoSlam::Impl::IsInFirstPart() const {
  return RootOf(map, map.StandIn(memory.reference)) == map.keyframes().begin()->first;
}

/// The first frame with enough depth is where the world begins; a later one that is lost begins a
/// new part of the map where the rig would be if it had kept its motion for a while.
std::optional<FramePose> StereoSlam::Impl::StartPart(const std::shared_ptr<const Frame>& frame) {
  const bool is_mere_start =
      options.map_file.empty() && std::ssize(map.keyframes()) < options.least_keyframes;
  Keyframe keyframe;
  keyframe.id = is_mere_start ? KeyframeId{0} : map.NextKeyframeId();
  keyframe.frame = frame;
  if (!map.empty()) {
    const double gap_s = static_cast<double>(frame->stamp_ns - memory.stamp_ns) * 1e-9;
    keyframe.T_world_rig = PredictPose(map.PoseOf(memory.reference) * memory.T_reference_rig,
                                       memory.motion, std::min(gap_s, options.track.longest_gap_s));
  }
  keyframe.landmarks.resize(static_cast<std::size_t>(frame->size()));
  MapEdit edit;
  edit.new_landmarks = CreateLandmarks(keyframe, camera, options.mapping.create);
  if (std::ssize(edit.new_landmarks) < options.least_first_points) return std::nullopt;
  edit.new_keyframes = {keyframe};
  if (is_mere_start) ForgetMap();
  map.Apply(edit);
  Index(keyframe.id);

  FramePose pose;
  pose.pose.T_rig_world = keyframe.T_world_rig.inverse();
  pose.local.reference = keyframe.id;
  const std::vector<LandmarkId>& landmarks = map.At(keyframe.id).landmarks;
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    if (landmarks[i].valid()) pose.matches.push_back({landmarks[i], static_cast<int>(i), 0});
  }
  pose.pose.inliers = static_cast<int>(pose.matches.size());
  pose.pose.inlier.assign(pose.matches.size(), true);
  return pose;
}

void StereoSlam::Impl::InsertKeyframe(const std::shared_ptr<const Frame>& frame,
                                      const FramePose& pose) {
  Keyframe keyframe;
  keyframe.id = map.NextKeyframeId();
  keyframe.frame = frame;
  keyframe.T_world_rig = Normalized(pose.pose.T_rig_world.inverse());
  keyframe.parent = pose.local.reference;
  keyframe.landmarks.resize(static_cast<std::size_t>(frame->size()));
  for (std::size_t i = 0; i < pose.matches.size(); ++i) {
    if (!pose.pose.inlier[i]) continue;
    keyframe.landmarks[static_cast<std::size_t>(pose.matches[i].feature)] =
        pose.matches[i].landmark;
  }
  MapEdit edit;
  edit.new_landmarks = CreateLandmarks(keyframe, camera, options.mapping.create);
  edit.new_keyframes = {std::move(keyframe)};
  for (const auto& [landmark, count] : counts) {
    edit.counts.push_back({landmark, count.first, count.second});
  }
  const KeyframeId id = edit.new_keyframes.front().id;
  map.Apply(edit);
  counts.clear();
  mapping.Start(frame_count + options.schedule.mapping_frames, options.schedule.background,
                [map = map, id, this] {
                  return MapKeyframe(map, id, vocabulary ? &*vocabulary : nullptr, index, camera,
                                     options);
                });
}

void StereoSlam::Impl::Remember(const Frame& frame, const FramePose& pose) {
  const Eigen::Isometry3d T_world_rig = pose.pose.T_rig_world.inverse();
  const double seconds = static_cast<double>(frame.stamp_ns - memory.stamp_ns) * 1e-9;
  std::optional<Motion> motion;
  if (state == TrackingState::kTracking) {
    const Eigen::Isometry3d T_world_last = map.PoseOf(memory.reference) * memory.T_reference_rig;
    motion = EstimateMotion(T_world_last, T_world_rig, seconds);
  }
  memory.stamp_ns = frame.stamp_ns;
  memory.reference = pose.local.reference;
  memory.T_reference_rig = map.PoseOf(memory.reference).inverse() * T_world_rig;
  memory.steady_motion = motion ? std::optional(Smoothed(memory.steady_motion, *motion, seconds,
                                                         options.track.blind.half_life_s))
                                : std::nullopt;
  memory.motion = motion;
  memory.landmarks.clear();
  for (const LandmarkId id : pose.expected) ++counts[id].first;
  for (std::size_t i = 0; i < pose.matches.size(); ++i) {
    if (!pose.pose.inlier[i]) continue;
    memory.landmarks.push_back(pose.matches[i].landmark);
    ++counts[pose.matches[i].landmark].second;
  }
  if (options.localise_only) counts.clear();
  trajectory.push_back({frame.stamp_ns, memory.reference, memory.T_reference_rig});
}

StereoSlam::StereoSlam(const StereoCamera& camera, const SlamOptions& options)
    : impl_(std::make_unique<Impl>(camera, options)) {}
StereoSlam::StereoSlam(StereoSlam&&) noexcept = default;
StereoSlam& StereoSlam::operator=(StereoSlam&&) noexcept = default;
StereoSlam::~StereoSlam() = default;

TrackedFrame StereoSlam::Track(const StereoImages& images, const ExternalMask& mask) {
  return impl_->Track(images, mask);
}

void StereoSlam::SaveMap(const std::string& file) {
  impl_->FinishBackgroundWork();
  if (impl_->map.empty()) throw std::runtime_error(file + ": there is no map to save yet");
  MapEdit edit;
  for (const auto& [landmark, count] : impl_->counts) {
    edit.counts.push_back({landmark, count.first, count.second});
  }
  impl_->map.Apply(edit);
  impl_->counts.clear();
  impl_->loops.clear();
  impl_->memory.steady_motion.reset();  // as a drive that loads the map, this one goes on from it
  slam::SaveMap({impl_->camera, impl_->map.StandIn(impl_->memory.reference), impl_->map}, file);
}

std::vector<StampedPose> StereoSlam::Finish() {
  impl_->FinishBackgroundWork();
  std::vector<StampedPose> poses;
  const Map& map = impl_->map;
  if (map.empty()) return poses;
  const KeyframeId largest = LargestPart(map);
  const std::map<KeyframeId, KeyframeId> roots = Roots(map);
  for (const Impl::Anchored& anchored : impl_->trajectory) {
    if (roots.at(map.StandIn(anchored.reference)) != largest) continue;
    poses.push_back({anchored.stamp_ns, map.PoseOf(anchored.reference) * anchored.T_reference_rig});
  }
  return poses;
}

}  // namespace aisle::slam
