#include "slam/mapping/map_keeper.h"

#include <algorithm>

namespace aisle::slam {

MapKeeper::MapKeeper(const StereoCamera& camera, const MapKeeperOptions& options,
                     std::optional<Vocabulary> vocabulary)
    : camera_(camera), options_(options), vocabulary_(std::move(vocabulary)) {}

bool MapKeeper::TakeDueWork(std::int64_t frame_now, std::map<std::string, double>& stage_ms) {
  double& wait_ms = stage_ms["wait_for_mapping"];
  const bool anytime = options_.schedule.free_running;
  if (auto result = mapping_.TakeIfDue(frame_now, wait_ms, anytime)) {
    stage_ms["mapping"] = result->milliseconds;
    TakeMapping(std::move(*result), frame_now);
  }
  // Not while a keyframe is being worked in: the result of that would undo the correction.
  if (!busy()) {
    if (auto correction = adjusting_.TakeIfDue(frame_now, wait_ms, anytime)) {
      stage_ms["global"] = correction->milliseconds;
      map_.Apply(CarryOver(map_, *correction));
    }
  }
  auto closed = closing_.TakeIfDue(frame_now, wait_ms, anytime);
  if (closed) TakeClosing(std::move(*closed), frame_now);
  return closed.has_value();
}

void MapKeeper::FinishWork() {
  std::map<std::string, double> stage_ms;
  // Mapping may start the closing of a loop, and that the adjustment of the map.
  while (!at_rest()) {
    mapping_.Wait();
    closing_.Wait();
    adjusting_.Wait();
    TakeDueWork(std::max({mapping_.due_frame(), closing_.due_frame(), adjusting_.due_frame()}),
                stage_ms);
  }
  loops_.clear();
}

void MapKeeper::TakeMapping(MappingResult result, std::int64_t frame_now) {
  map_ = std::move(result.map);
  if (!vocabulary_) return;
  index_.Add(result.keyframe, result.words);
  for (const KeyframeId gone : result.culled) index_.Remove(gone);
  std::erase_if(loops_, [&](const LoopEdge& loop) {
    return loop.current.value + options_.loop.pending_keyframes < result.keyframe.value;
  });
  if (result.loops.empty() || adjusting_.pending()) return;
  for (const LoopEdge& loop : result.loops) {  // a keyframe has one say
    const auto has_spoken = [&](const LoopEdge& before) { return before.current == loop.current; };
    if (std::ranges::none_of(loops_, has_spoken)) loops_.push_back(loop);
  }
  const std::vector<LoopEdge> agreeing = AgreeingLoops(map_, loops_, options_.loop);
  if (agreeing.empty()) return;
  loops_.clear();
  StartClosing(agreeing, frame_now);
}

void MapKeeper::StartClosing(const std::vector<LoopEdge>& agreeing, std::int64_t frame_now) {
  const ScheduleOptions& schedule = options_.schedule;
  const std::int64_t due_frame = frame_now + schedule.loop_frames +
                                 std::ssize(map_.keyframes()) / schedule.keyframes_per_loop_frame;
  closing_.Start(due_frame, schedule.background, [map = map_, agreeing, this] {
    return CloseLoop(map, agreeing, camera_, options_.mapping.fuse);
  });
}

/// Tracking goes on in the closed map, which is made exact meanwhile.
void MapKeeper::TakeClosing(Map closed, std::int64_t frame_now) {
  map_ = std::move(closed);
  const ScheduleOptions& schedule = options_.schedule;
  const std::int64_t due_frame = frame_now + schedule.global_frames +
                                 std::ssize(map_.keyframes()) / schedule.keyframes_per_global_frame;
  adjusting_.Start(due_frame, schedule.background,
                   [map = map_, this] { return CorrectGlobally(map, camera_, options_.global); });
}

void MapKeeper::WorkIn(const MapEdit& edit, std::int64_t frame_now) {
  map_.Apply(edit);
  const KeyframeId id = edit.new_keyframes.front().id;
  mapping_.Start(frame_now + options_.schedule.mapping_frames, options_.schedule.background,
                 [map = map_, id, this] {
                   return MapKeyframe(map, id, vocabulary(), index_, camera_, options_.mapping,
                                      options_.loop);
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
