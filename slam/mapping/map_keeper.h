#pragma once

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "slam/camera/stereo_camera.h"
#include "slam/mapping/background_job.h"
#include "slam/mapping/local_mapping.h"
#include "slam/mapping/loop_closing.h"
#include "slam/mapping/mapping_options.h"
#include "slam/mapping/mapping_policy.h"
#include "slam/place/place_index.h"
#include "slam/place/vocabulary.h"

namespace aisle::slam {

/// The map of a drive, and the work on it that runs beside tracking: keyframes are worked in, loops
/// closed, parts joined, the whole adjusted. Every result is taken at an appointed frame (see
/// ScheduleOptions), so that the map a frame sees does not depend on how threads run.
///
/// At most one of mapping and closing is under way, on a copy of the map; neither map nor index
/// changes until its result is taken. The global adjustment runs beside them, and its result is
/// carried over to what the map has become. Keyframes may wait for mapping: the map shows them, and
/// what is made of it meanwhile does not know them yet.
class MapKeeper {
 public:
  /// Without a vocabulary no loops are closed and no parts joined.
  MapKeeper(const StereoCamera& camera, const MapKeeperOptions& options, MappingPolicy policy,
            std::optional<Vocabulary> vocabulary);
  MapKeeper(const MapKeeper&) = delete;  // the work holds on to it
  MapKeeper& operator=(const MapKeeper&) = delete;

  const Map& map() const { return map_; }
  const PlaceIndex& index() const { return index_; }  ///< of keyframes that mapping is done with
  const Vocabulary* vocabulary() const { return vocabulary_ ? &*vocabulary_ : nullptr; }

  /// Whether a keyframe is being worked in or a loop closed: another would have to wait.
  bool busy() const { return mapping_.pending() || closing_.pending(); }
  bool closing() const { return closing_.pending(); }
  int waiting() const { return static_cast<int>(waiting_.size()); }
  bool at_rest() const { return !busy() && !adjusting_.pending(); }

  /// What has been taken.
  struct Taken {
    bool loop_closed = false;
    /// The map before, where another has taken its place: landmarks may have become one, and those
    /// of waiting keyframes have other ids (see Successor).
    std::optional<Map> replaced;
  };
  /// Takes results that are due at frame `frame_now` (free running: that are ready). Times go to
  /// `stage_ms`.
  Taken TakeDueWork(std::int64_t frame_now, std::map<std::string, double>& stage_ms);
  /// Waits for everything under way and for what follows from it, due or not. Loops that nothing
  /// else has confirmed yet are forgotten: a map file does not hold them. Gives the map before,
  /// where another has taken its place, as Taken does.
  std::optional<Map> FinishWork();

  /// Adds a keyframe, given whole by `edit`, and starts to work it in, or lets it wait.
  void WorkIn(const MapEdit& edit, std::int64_t frame_now);
  /// Gives up the step under way if the policy can: what is left of it is seen at the next frame.
  void Hurry(std::int64_t frame_now);
  /// Adds the first keyframe of a part of the map, with which there is nothing to do. Not while
  /// busy; an adjustment under way leaves it where it is.
  void AddRoot(const MapEdit& edit);
  /// Goes on in this map. Only at rest.
  void Adopt(const Map& map);
  /// Notes how often landmarks were found. Only at rest.
  void Count(const std::vector<MapEdit::Count>& counts);

 private:
  void GoOnAfterMapping(const MappingResult& result, std::int64_t frame_now);
  void FinishMapping(const MappingResult& result, std::int64_t frame_now);
  void StartStep(std::size_t step, std::int64_t from_frame);
  void Start(Map map, std::int64_t due_frame, const MappingStep::Work& work);
  void GoOn(const Map& before, std::int64_t frame_now);
  void HearLoopsOfMeanwhile(std::int64_t frame_now);
  void StartAdjusting(std::int64_t frame_now);
  void StartClosing(const std::vector<LoopEdge>& agreeing, std::int64_t frame_now);
  void Index(KeyframeId id);

  const StereoCamera camera_;
  const MapKeeperOptions options_;
  const MappingPolicy policy_;
  const std::optional<Vocabulary> vocabulary_;
  Map map_;
  PlaceIndex index_;
  std::vector<LoopEdge> loops_;  // seen of late, waiting for others to agree, or for adjusting_
  std::size_t step_ = 0;         // of the policy, under way or last taken
  bool given_up_ = false;        // what is left of it is under way
  KeyframeId worked_in_;         // its keyframe
  Map worked_on_;                // what the step under way began with, if it can be given up
  std::deque<MapEdit> waiting_;  // keyframes, as map_ shows them

  // Declared last: they end before what they read.
  BackgroundJob<MappingResult> mapping_;
  BackgroundJob<Map> closing_;
  BackgroundJob<GlobalCorrection> adjusting_;
};

}  // namespace aisle::slam
