#include "slam/stereo_slam.h"

#include <fmt/format.h>

#include <stdexcept>

#include "slam/base/tracking_policy.h"
#include "slam/common/parallel.h"
#include "slam/common/seconds.h"
#include "slam/common/stopwatch.h"
#include "slam/dynamic/dynamic_detector.h"
#include "slam/front_end/see_frame.h"
#include "slam/map/map_file.h"
#include "slam/mapping/map_keeper.h"
#include "slam/mapping/orbslam2_mapping.h"
#include "slam/track/continuity.h"
#include "slam/track/predict_motion.h"
#include "slam/track/prior_map.h"
#include "slam/track/track_record.h"

namespace aisle::slam {
namespace {

/// The options. Throws where they or the camera break a rule.
SlamOptions Checked(const StereoCamera& camera, const SlamOptions& options) {
  for (const std::string& error : {Validate(camera), Validate(options)}) {
    if (!error.empty()) throw std::invalid_argument("StereoSlam: " + error);
  }
  return options;
}

std::optional<Vocabulary> LoadWords(const SlamOptions& options) {
  if (options.vocabulary_file.empty()) return std::nullopt;
  return Vocabulary::Load(options.vocabulary_file);
}

MappingPolicy MappingOf(const SlamOptions& options) {
  const int frames = options.schedule.mapping_frames;
  if (options.base == Base::kOrbSlam2) return OrbSlam2Mapping(options.orbslam2_mapping, frames);
  return PlainMapping(frames);
}

/// The map of a file, which must have been made by a rig and with features like these.
SavedMap LoadMapFor(const StereoCamera& camera, const SlamOptions& options) {
  SavedMap saved = LoadMap(options.map_file);
  if (saved.camera != camera) {
    throw std::runtime_error(options.map_file +
                             ": was made with another camera; a map can only be used with the rig "
                             "that made it, calibrated as it was then");
  }
  for (const auto& [id, keyframe] : saved.map.keyframes()) {
    if (keyframe->frame->scale != options.feature.scale) {
      throw std::runtime_error(fmt::format("{}: was made with feature.scale = {}, not {}",
                                           options.map_file, keyframe->frame->scale,
                                           options.feature.scale));
    }
  }
  return saved;
}

/// What a frame shows, whether or not it finds its place.
void NoteObservations(const Frame& frame, TrackedFrame& result) {
  result.features = frame.size();
  result.keypoint_is_inlier.assign(static_cast<std::size_t>(frame.size()), false);
  for (int i = 0; i < frame.size(); ++i) {
    const auto feature = static_cast<std::size_t>(i);
    result.keypoints.push_back(frame.features.keypoints[feature].pixel);
    result.stereo_points += frame.measurements[feature].has_depth();
  }
}

void NotePose(const FramePose& pose, TrackedFrame& result) {
  result.matched_points = static_cast<int>(pose.matches.size() + pose.right_matches.size());
  result.inliers = pose.pose.inliers;
  for (std::size_t i = 0; i < pose.matches.size(); ++i) {
    result.keypoint_is_inlier[static_cast<std::size_t>(pose.matches[i].feature)] =
        pose.pose.inlier[i];
  }
}

/// What not to look at, and how the rig has moved since the last frame, if the search for movers
/// has told.
struct Rejection {
  ExternalMask mask;
  std::optional<MeasuredMotion> rig_motion = {};
};

/// What a frame shows outside movers, and the same motion.
struct Sight {
  StereoSight seen;
  cv::Mat1b rejected;  // of the left image
  std::optional<MeasuredMotion> rig_motion;
};

}  // namespace

/// Finds frames in the map that `keeper` keeps, and gives it keyframes.
struct StereoSlam::Impl {
  Impl(const StereoCamera& camera_in, const SlamOptions& options_in);

  TrackedFrame Track(const StereoImages& images, const ExternalMask& mask,
                     const std::optional<MeasuredMotion>& motion);
  Sight See(const StereoImages& images, const ExternalMask& mask,
            const std::optional<MeasuredMotion>& motion, TrackedFrame& result);
  bool AsksPriorMap() const;
  std::optional<MeasuredMotion> AskPriorMap(const StereoImages& images, ImageCorners corners,
                                            const ExternalMask& mask, TrackedFrame& result);
  Rejection RejectMovers(const StereoImages& images, const ExternalMask& mask,
                         const std::optional<MeasuredMotion>& motion, TrackedFrame& result);
  DriveState Drive() const;
  void TakeDueWork(TrackedFrame& result);
  void CarryOver(const std::optional<Map>& replaced);
  bool TakeAsKeyframe(const std::shared_ptr<const Frame>& frame, FramePose& pose);
  std::optional<FramePose> StartPart(const std::shared_ptr<const Frame>& frame);
  bool CanCoast(const Frame& frame) const;
  bool Coast(const std::shared_ptr<const Frame>& frame);
  void NoteOutcome(const std::shared_ptr<const Frame>& frame, const std::optional<FramePose>& pose,
                   bool is_keyframe);
  bool IsTimeForANewPart(std::int64_t stamp_ns) const;
  void BeginWorldAnew();
  /// Whether it is known where the rig was at the last frame.
  bool IsFound() const {
    return state == TrackingState::kTracking || state == TrackingState::kCoasting;
  }

  const StereoCamera camera;
  const SlamOptions options;
  DynamicDetector detector;
  Arena arena;

  TrackingState state = TrackingState::kInitializing;  // kTracking in any part of the map
  std::optional<std::int64_t> lost_since_ns;  // first frame that shows something but has no pose
  std::int64_t coasting_since_ns = 0;  // of kCoasting: the last frame that was found, or extended
  std::int64_t known_ns = 0;           // the last frame that images or measured motion have placed
  std::optional<std::int64_t> last_stamp_ns;  // of all frames
  std::int64_t frame_count = 0;
  int map_id = 0;                           // see TrackedFrame
  std::shared_ptr<const Frame> last_sight;  // the last frame that shows something
  TrackRecord track;
  KeyframeId first_of_drive{0};                // those before it are of the map from a file
  std::optional<PoseInPriorMap> in_prior_map;  // of the last frame
  MapKeeper keeper;
  std::unique_ptr<TrackingPolicy> policy;
};

StereoSlam::Impl::Impl(const StereoCamera& camera_in, const SlamOptions& options_in)
    : camera(camera_in),
      options(Checked(camera_in, options_in)),
      detector(camera, options.dynamic),
      arena(options.threads),
      keeper(camera,
             {.levels = options.feature.levels,
              .mapping = options.mapping,
              .loop = options.loop,
              .global = options.global,
              .schedule = options.schedule},
             MappingOf(options), LoadWords(options)),
      policy(MakeTrackingPolicy(camera, options)) {
  if (options.map_file.empty()) return;
  const SavedMap saved = LoadMapFor(camera, options);
  keeper.Adopt(saved.map);
  first_of_drive = saved.map.NextKeyframeId();
  track.GoOnFrom(saved.reference);
  state = TrackingState::kLost;
}

TrackedFrame StereoSlam::Impl::Track(const StereoImages& images, const ExternalMask& mask,
                                     const std::optional<MeasuredMotion>& motion) {
  CheckImages(images, mask, camera);
  if (last_stamp_ns && images.stamp_ns <= *last_stamp_ns) {
    throw std::invalid_argument(
        fmt::format("frame {}: its timestamp is {} ns, after {}: timestamps must increase",
                    images.id, images.stamp_ns, *last_stamp_ns));
  }
  last_stamp_ns = images.stamp_ns;
  TrackedFrame result;
  result.id = images.id;
  result.stamp_ns = images.stamp_ns;
  Sight sight;
  arena.Execute([&] { sight = See(images, mask, motion, result); });
  const std::shared_ptr<const Frame>& frame = sight.seen.frame;
  TakeDueWork(result);
  track.Roll(options.base == Base::kPlain ? motion : std::nullopt, images.stamp_ns,
             options.track.inertia, IsFound() ? sight.rig_motion : std::nullopt);

  Stopwatch track_time(result.stage_ms["track"]);
  const Map& map = keeper.map();
  DriveState drive = Drive();
  if (TellsOfBoth(mask)) drive.right = sight.seen.right.get();
  const MaskedArea masked(sight.rejected, options.feature);
  drive.masked = &masked;
  std::optional<FramePose> pose = map.empty() ? std::nullopt : policy->Find(frame, drive);
  if (pose) {
    result.is_keyframe = !options.localise_only && TakeAsKeyframe(frame, *pose);
  } else if (map.empty() || IsTimeForANewPart(images.stamp_ns)) {
    pose = StartPart(frame);
    result.is_keyframe = pose.has_value();
  }
  const bool coasting = !pose && !map.empty() && CanCoast(*frame);
  if (coasting) {
    result.is_keyframe = Coast(frame);
  } else {
    NoteOutcome(frame, pose, result.is_keyframe);
  }
  if (ShowsSomething(*frame)) last_sight = frame;

  const bool apart = (pose || coasting) && !IsInFirstPart(map, track.memory().reference);
  result.state = apart ? TrackingState::kApart : state;
  result.map_id = map_id;
  result.map_keyframes = static_cast<int>(map.keyframes().size());
  result.map_landmarks = map.landmark_count();
  NoteObservations(*frame, result);
  if (pose) NotePose(*pose, result);
  if (pose && !apart) result.T_world_rig = pose->pose.T_rig_world.inverse();
  if (coasting && !apart) result.T_world_rig = track.memory().PoseIn(map);
  return result;
}

/// What the frame shows outside movers. Corners depend on the images alone and are found while the
/// detector leaves threads idle: its time includes what of them it waited for. Where a prior map is
/// asked first, it is with them.
Sight StereoSlam::Impl::See(const StereoImages& images, const ExternalMask& mask,
                            const std::optional<MeasuredMotion>& motion, TrackedFrame& result) {
  StereoCorners corners;
  Beside finding([&] { corners = FindStereoCorners(images, options.feature); });
  std::optional<MeasuredMotion> known = motion;
  if (!motion && AsksPriorMap()) {
    finding.Wait();
    known = AskPriorMap(images, corners.left, mask, result);
  } else {
    in_prior_map.reset();
  }
  const Rejection rejected = RejectMovers(images, mask, known, result);
  {
    Stopwatch time(result.stage_ms["extract"]);
    finding.Wait();
  }
  return {SeeFrame(images, std::move(corners), rejected.mask, camera, options, result.stage_ms),
          rejected.mask.left, rejected.rig_motion};
}

/// Whether a map from before the drive may tell the search for movers how the rig moves.
bool StereoSlam::Impl::AsksPriorMap() const {
  return !options.map_file.empty() && options.base == Base::kPlain &&
         options.dynamic.method == DynamicMethod::kRobust && IsFound();
}

/// How the rig has moved since the last frame as that map tells it.
std::optional<MeasuredMotion> StereoSlam::Impl::AskPriorMap(const StereoImages& images,
                                                            ImageCorners corners,
                                                            const ExternalMask& mask,
                                                            TrackedFrame& result) {
  Stopwatch time(result.stage_ms["prior_map"]);
  const Frame frame = SeeLeft(images, std::move(corners), mask, options);
  const Map& map = keeper.map();
  const auto now = FindInPriorMap({map, frame, camera, options.feature.levels, options.track},
                                  track.memory(), first_of_drive);
  const auto before = std::exchange(in_prior_map, now);
  if (!before || !now) return std::nullopt;
  return MotionInPriorMap(map, *before, *now,
                          PredictMotion(track.memory(), images.stamp_ns, options.track),
                          options.track.inertia);
}

/// The caller's mask and what the detector finds moving, together; the latter is noted in `result`.
Rejection StereoSlam::Impl::RejectMovers(const StereoImages& images, const ExternalMask& mask,
                                         const std::optional<MeasuredMotion>& motion,
                                         TrackedFrame& result) {
  if (options.dynamic.method == DynamicMethod::kNone) return {mask};
  Stopwatch time(result.stage_ms["dynamic"]);
  DynamicInput input{images.stamp_ns, images.left, images.right, {}, motion};
  if (IsFound() && !motion) {
    input.expected = PredictMotion(track.memory(), images.stamp_ns, options.track);
  }
  DynamicOutput moving = detector.Detect(input);
  result.dynamic = std::move(moving.regions);
  result.dynamic_stages = std::move(moving.stages);
  return {{Union(mask.left, result.dynamic.mask), Union(mask.right, moving.mask_right),
           mask.confidence},
          moving.rig_motion};
}

DriveState StereoSlam::Impl::Drive() const {
  return {keeper.map(),
          track.memory(),
          {keeper.vocabulary(), keeper.index()},
          frame_count,
          state == TrackingState::kLost,
          in_prior_map};
}

/// What background work has made of the map by this frame.
void StereoSlam::Impl::TakeDueWork(TrackedFrame& result) {
  const MapKeeper::Taken taken = keeper.TakeDueWork(frame_count, result.stage_ms);
  result.loop_closed = taken.loop_closed;
  CarryOver(taken.replaced);
}

/// What is remembered of the landmarks of a map in whose place another is now.
void StereoSlam::Impl::CarryOver(const std::optional<Map>& replaced) {
  if (!replaced) return;
  track.CarryOver(*replaced, keeper.map());
  policy->CarryOver(*replaced, keeper.map());
}

/// Adds the frame to the map if it is to be a keyframe.
bool StereoSlam::Impl::TakeAsKeyframe(const std::shared_ptr<const Frame>& frame, FramePose& pose) {
  const MapperState mapper{!keeper.busy(), keeper.closing(), keeper.waiting()};
  const KeyframeVerdict verdict = policy->NeedsKeyframe(keeper.map(), *frame, pose, mapper);
  if (verdict.hurry) keeper.Hurry(frame_count);
  if (!verdict.taken) return false;
  MapEdit edit = policy->MakeKeyframe(keeper.map(), frame, pose);
  edit.counts = track.TakeCounts();
  keeper.WorkIn(edit, frame_count);
  pose.local.reference = edit.new_keyframes.front().id;  // with which its pose moves from here on
  return true;
}

/// Whether the rig has been lost, with images to look at, for so long that it may be somewhere new.
bool StereoSlam::Impl::IsTimeForANewPart(std::int64_t stamp_ns) const {
  if (options.localise_only || !keeper.vocabulary() || !lost_since_ns) return false;
  if (!policy->BeginsParts()) return false;
  if (keeper.busy()) return false;
  return SecondsBetween(*lost_since_ns, stamp_ns) >= options.new_part_after_s;
}

/// Gives up the map, and what has been tracked in it.
void StereoSlam::Impl::BeginWorldAnew() {
  if (!keeper.map().empty()) ++map_id;
  keeper.Adopt({});
  track.ForgetTrack();
}

std::optional<FramePose> StereoSlam::Impl::StartPart(const std::shared_ptr<const Frame>& frame) {
  const auto part = policy->Begin(frame, Drive());
  if (!part || (part->anew && !keeper.at_rest())) return std::nullopt;
  if (part->anew) BeginWorldAnew();
  keeper.AddRoot(part->edit);
  return PoseOfKeyframe(keeper.map(), part->edit.new_keyframes.front().id);
}

/// Whether the pose of a frame that is not found in the map is known all the same: by a measured
/// motion, or for a short while by the rig's inertia.
bool StereoSlam::Impl::CanCoast(const Frame& frame) const {
  const TrackMemory& memory = track.memory();
  if (memory.measured) return true;
  if (options.base != Base::kPlain || !memory.carried) return false;
  const double while_s = SecondsBetween(known_ns, frame.stamp_ns);
  if (!IsFound() || while_s > options.track.inertia.longest_s) return false;
  // After the dark it may see another place.
  return !last_sight || !IsCut(*last_sight, frame, options.feature.features);
}

/// Goes by the measured motion, or by inertia. Having done so for a while, a frame that shows
/// enough becomes a keyframe where it is known to be, so that those to come have something to be
/// found by; by inertia alone only where it has been watched all the way.
bool StereoSlam::Impl::Coast(const std::shared_ptr<const Frame>& frame) {
  if (state != TrackingState::kCoasting) coasting_since_ns = track.memory().stamp_ns;
  state = TrackingState::kCoasting;
  if (track.memory().measured) known_ns = frame->stamp_ns;
  const double while_s = SecondsBetween(coasting_since_ns, frame->stamp_ns);
  const bool is_time =
      !options.localise_only && !keeper.busy() && while_s >= options.track.measured.extend_after_s;
  const auto edit = is_time ? policy->Extend(frame, Drive()) : std::nullopt;
  policy->Note(frame, nullptr, std::nullopt, Drive());
  ++frame_count;
  if (!edit) {
    track.Coast(keeper.map(), frame->stamp_ns, options.track.inertia);
    return false;
  }
  keeper.WorkIn(*edit, frame_count - 1);
  track.CoastToKeyframe(keeper.map(), frame->stamp_ns, edit->new_keyframes.front().id,
                        options.track.inertia);
  coasting_since_ns = frame->stamp_ns;
  return true;
}

/// What the next frame has to know of this one.
void StereoSlam::Impl::NoteOutcome(const std::shared_ptr<const Frame>& frame,
                                   const std::optional<FramePose>& pose, bool is_keyframe) {
  const auto keyframe =
      is_keyframe ? std::optional(keeper.map().keyframes().rbegin()->first) : std::nullopt;
  policy->Note(frame, pose ? &*pose : nullptr, keyframe, Drive());
  ++frame_count;
  if (pose) {
    track.Note(keeper.map(), *frame, *pose, IsFound(), options.track);
    known_ns = frame->stamp_ns;
    if (!options.localise_only) {  // else the map stays as it is
      constexpr LookOptions kEveryFrame{0, 0};
      track.Count(*pose, options.base == Base::kPlain ? options.track.look : kEveryFrame);
    }
    lost_since_ns.reset();
    state = TrackingState::kTracking;
    return;
  }
  if (options.map_file.empty() && policy->GivesUp(keeper.map())) {
    keeper.FinishWork();
    BeginWorldAnew();
  }
  if (!lost_since_ns && frame->size() >= options.least_first_points)
    lost_since_ns = frame->stamp_ns;
  state = keeper.map().empty() ? TrackingState::kInitializing : TrackingState::kLost;
}

StereoSlam::StereoSlam(const StereoCamera& camera, const SlamOptions& options)
    : impl_(std::make_unique<Impl>(camera, options)) {}
StereoSlam::StereoSlam(StereoSlam&&) noexcept = default;
StereoSlam& StereoSlam::operator=(StereoSlam&&) noexcept = default;
StereoSlam::~StereoSlam() = default;

TrackedFrame StereoSlam::Track(const StereoImages& images, const ExternalMask& mask,
                               const std::optional<MeasuredMotion>& motion) {
  if (motion) CheckMotion(*motion);
  return impl_->Track(images, mask, motion);
}

void StereoSlam::SaveMap(const std::string& file) {
  MapKeeper& keeper = impl_->keeper;
  TrackRecord& track = impl_->track;
  impl_->CarryOver(keeper.FinishWork());
  if (keeper.map().empty()) throw std::runtime_error(file + ": there is no map to save yet");
  keeper.Count(track.TakeCounts());
  track.ForgetMotion();
  if (impl_->state == TrackingState::kCoasting) impl_->state = TrackingState::kLost;
  const KeyframeId reference = keeper.map().StandIn(track.memory().reference);
  slam::SaveMap({impl_->camera, reference, keeper.map()}, file);
}

std::vector<StampedPose> StereoSlam::Finish() {
  impl_->keeper.FinishWork();
  return impl_->track.Trajectory(impl_->keeper.map());
}

}  // namespace aisle::slam
