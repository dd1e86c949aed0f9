#include "slam/mapping/map_keeper.h"

#include <algorithm>

#include "slam/map/successor.h"
#include "slam/place/find_loop.h"

namespace aisle::slam {

MapKeeper::MapKeeper(const StereoCamera& camera, const MapKeeperOptions& options,
                     MappingPolicy policy, std::optional<Vocabulary> vocabulary)
    : camera_(camera),
      options_(options),
      policy_(std::move(policy)),
      vocabulary_(std::move(vocabulary)) {}

MapKeeper::Taken MapKeeper::TakeDueWork(std::int64_t frame_now,
                                        std::map<std::string, double>& stage_ms) {
  double& wait_ms = stage_ms["wait_for_mapping"];
  const bool anytime = options_.schedule.free_running;
  Taken taken;
  // Maps are moved, not copied: even their tables are long after a long drive.
  const auto replace = [&](Map next, auto go_on) {
    Map before = std::exchange(map_, std::move(next));
    go_on();
    GoOn(before, frame_now);
    if (!taken.replaced) taken.replaced = std::move(before);
  };
  while (auto result = mapping_.TakeIfDue(frame_now, wait_ms, anytime)) {
    stage_ms["mapping"] += result->milliseconds;
    replace(std::move(result->map), [&] { GoOnAfterMapping(*result, frame_now); });
  }
  // Not while a keyframe is being worked in: the result of that would undo the correction.
  if (!busy()) {
    if (auto correction = adjusting_.TakeIfDue(frame_now, wait_ms, anytime)) {
      stage_ms["global"] = correction->milliseconds;
      map_.Apply(CarryOver(map_, *correction));
      HearLoopsOfMeanwhile(frame_now);
    }
  }
  if (auto closed = closing_.TakeIfDue(frame_now, wait_ms, anytime)) {
    taken.loop_closed = true;
    replace(std::move(*closed), [&] { StartAdjusting(frame_now); });
  }
  return taken;
}

std::optional<Map> MapKeeper::FinishWork() {
  std::optional<Map> replaced;
  std::map<std::string, double> stage_ms;
  // Mapping may start the closing of a loop, and that the adjustment of the map.
  while (!at_rest()) {
    mapping_.Wait();
    closing_.Wait();
    adjusting_.Wait();
    Taken taken = TakeDueWork(
        std::max({mapping_.due_frame(), closing_.due_frame(), adjusting_.due_frame()}), stage_ms);
    if (!replaced) replaced = std::move(taken.replaced);
  }
  loops_.clear();
  return replaced;
}

void MapKeeper::GoOnAfterMapping(const MappingResult& result, std::int64_t frame_now) {
  worked_on_ = {};
  if (step_ + 1 == policy_.size()) return FinishMapping(result, frame_now);
  StartStep(step_ + 1, mapping_.due_frame());
}

/// The next keyframe that waits is worked in, if nothing else is under way; the others show.
void MapKeeper::GoOn(const Map& before, std::int64_t frame_now) {
  if (!busy() && !waiting_.empty()) {
    const MapEdit next = CarriedOver(waiting_.front(), before, map_);
    waiting_.pop_front();
    map_.Apply(next);
    worked_in_ = next.new_keyframes.front().id;
    StartStep(0, frame_now);
  }
  for (MapEdit& keyframe : waiting_) {
    keyframe = CarriedOver(keyframe, before, map_);
    map_.Apply(keyframe);
  }
}

void MapKeeper::FinishMapping(const MappingResult& result, std::int64_t frame_now) {
  if (!vocabulary_) return;
  index_.Add(result.keyframe, result.words);
  for (const KeyframeId gone : result.culled) index_.Remove(gone);
  // Nothing is closed while the map is adjusted: what is seen meanwhile waits until it is.
  if (!adjusting_.pending()) {
    std::erase_if(loops_, [&](const LoopEdge& loop) {
      return loop.current.value + options_.loop.pending_keyframes < result.keyframe.value;
    });
  }
  for (const LoopEdge& loop : result.loops) {  // a keyframe has one say
    const auto has_spoken = [&](const LoopEdge& before) { return before.current == loop.current; };
    if (std::ranges::none_of(loops_, has_spoken)) loops_.push_back(loop);
  }
  if (result.loops.empty() || adjusting_.pending()) return;
  const std::vector<LoopEdge> agreeing = AgreeingLoops(map_, loops_, options_.loop);
  if (!agreeing.empty()) StartClosing(agreeing, frame_now);
}

/// Each loop is asked as if it were the newest, the newest first.
void MapKeeper::HearLoopsOfMeanwhile(std::int64_t frame_now) {
  std::erase_if(loops_, [&](const LoopEdge& loop) { return IsOnePlace(map_, loop); });
  for (std::vector<LoopEdge> seen = loops_; !seen.empty(); seen.pop_back()) {
    const std::vector<LoopEdge> agreeing = AgreeingLoops(map_, seen, options_.loop);
    if (!agreeing.empty()) return StartClosing(agreeing, frame_now);
  }
}

/// These loops have been heard; others may be of another place, and wait for their turn.
void MapKeeper::StartClosing(const std::vector<LoopEdge>& agreeing, std::int64_t frame_now) {
  std::erase_if(loops_, [&](const LoopEdge& loop) {
    return std::ranges::any_of(
        agreeing, [&](const LoopEdge& heard) { return heard.current == loop.current; });
  });
  const ScheduleOptions& schedule = options_.schedule;
  const std::int64_t due_frame = frame_now + schedule.loop_frames +
                                 std::ssize(map_.keyframes()) / schedule.keyframes_per_loop_frame;
  closing_.Start(due_frame, schedule.background, [map = map_, agreeing, this]() mutable {
    return CloseLoop(std::move(map), agreeing, camera_, options_.levels, options_.loop.spread,
                     options_.mapping.fuse);
  });
}

/// Tracking goes on in the closed map, which is made exact meanwhile.
void MapKeeper::StartAdjusting(std::int64_t frame_now) {
  const ScheduleOptions& schedule = options_.schedule;
  const std::int64_t due_frame = frame_now + schedule.global_frames +
                                 std::ssize(map_.keyframes()) / schedule.keyframes_per_global_frame;
  adjusting_.Start(due_frame, schedule.background, [map = map_, this]() mutable {
    return CorrectGlobally(std::move(map), camera_, options_.global);
  });
}

void MapKeeper::WorkIn(const MapEdit& edit, std::int64_t frame_now) {
  map_.Apply(edit);
  if (busy()) {
    waiting_.push_back(edit);
    return;
  }
  worked_in_ = edit.new_keyframes.front().id;
  StartStep(0, frame_now);
}

void MapKeeper::Hurry(std::int64_t frame_now) {
  if (!mapping_.pending() || !policy_[step_].given_up || given_up_) return;
  given_up_ = true;
  Start(std::move(worked_on_), frame_now + 1, policy_[step_].given_up);
}

void MapKeeper::StartStep(std::size_t step, std::int64_t from_frame) {
  step_ = step;
  given_up_ = false;
  const MappingStep& now = policy_[step];
  const bool hurried = !waiting_.empty();
  if (now.given_up) worked_on_ = map_;
  Start(map_, from_frame + (hurried ? now.hurried_frames : now.frames),
        hurried ? now.hurried : now.work);
}

void MapKeeper::Start(Map map, std::int64_t due_frame, const MappingStep::Work& work) {
  mapping_.Start(due_frame, options_.schedule.background,
                 [map = std::move(map), work, id = worked_in_, this]() mutable {
                   return work(std::move(map), id,
                               {vocabulary(), index_, camera_, options_.levels, options_.mapping,
                                options_.loop});
                 });
}

void MapKeeper::AddRoot(const MapEdit& edit) {
  map_.Apply(edit);
  Index(edit.new_keyframes.front().id);
}

void MapKeeper::Adopt(const Map& map) {
  map_ = map;
  index_ = {};
  loops_.clear();
  for (const auto& [id, keyframe] : map_.keyframes()) Index(id);
}

void MapKeeper::Count(const std::vector<MapEdit::Count>& counts) {
  MapEdit edit;
  edit.counts = counts;
  map_.Apply(edit);
}

void MapKeeper::Index(KeyframeId id) {
  if (vocabulary_) index_.Add(id, vocabulary_->Describe(map_.At(id).frame->features.descriptors));
}

}  // namespace aisle::slam
