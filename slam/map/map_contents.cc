#include <algorithm>
#include <stdexcept>

#include "slam/map/map.h"

namespace aisle::slam {
namespace {

void Demand(bool holds, const char* rule) {
  if (!holds) throw std::invalid_argument(rule);
}

void CheckSlots(const MapContents& contents) {
  std::vector<int> uses(contents.generations.size(), 0);
  const auto use = [&](std::int32_t slot) {
    Demand(slot >= 0 && slot < std::ssize(uses), "a landmark's slot does not exist");
    ++uses[static_cast<std::size_t>(slot)];
  };
  for (const Landmark& landmark : contents.landmarks) {
    use(landmark.id.slot);
    const std::int32_t next = contents.generations[static_cast<std::size_t>(landmark.id.slot)];
    Demand(next > 0 && landmark.id.generation == next - 1, "a landmark is of another generation");
  }
  for (const std::int32_t slot : contents.vacant) use(slot);
  Demand(std::all_of(uses.begin(), uses.end(), [](int count) { return count == 1; }),
         "a slot is neither vacant nor used once");
}

void CheckAncestry(const MapContents& contents) {
  std::map<KeyframeId, KeyframeId> known;  // of every keyframe: parent or heir
  for (const RetiredKeyframe& one : contents.retired) {
    Demand(one.heir < one.id && one.heir.valid(), "a retired keyframe has no older heir");
    known[one.id] = one.heir;
  }
  KeyframeId last;
  for (const Keyframe& keyframe : contents.keyframes) {
    Demand(keyframe.frame != nullptr, "a keyframe has no frame");
    Demand(last < keyframe.id && keyframe.id.value < contents.next_keyframe,
           "keyframes are not numbered by rising id");
    last = keyframe.id;
    Demand(known.emplace(keyframe.id, keyframe.parent).second, "a keyframe is retired too");
  }
  // Numbers are given one by one, and tables of that length are made for every frame.
  Demand(std::ssize(known) == contents.next_keyframe &&
             (known.empty() || known.rbegin()->first.value < contents.next_keyframe),
         "the next keyframe's number is not that of those which are or were there");
  for (const auto& [id, ancestor] : known) {
    Demand(!ancestor.valid() || (ancestor < id && known.contains(ancestor)),
           "a keyframe's parent does not exist");
  }
}

void CheckObservations(const Map& map) {
  std::ptrdiff_t named = 0, observed = 0;
  for (const auto& [id, keyframe] : map.keyframes()) {
    Demand(std::ssize(keyframe->landmarks) == keyframe->frame->size(),
           "a keyframe's landmarks are not as many as its features");
    for (const LandmarkId landmark : keyframe->landmarks) named += landmark.valid();
  }
  for (const Landmark* landmark : map.Landmarks()) {
    Demand(!landmark->observations.empty(), "a landmark is not observed");
    Demand(std::is_sorted(landmark->observations.begin(), landmark->observations.end()),
           "a landmark's observations are out of order");
    for (const Observation& observation : landmark->observations) {
      const Keyframe* keyframe = map.Find(observation.keyframe);
      Demand(keyframe && observation.feature >= 0 &&
                 observation.feature < std::ssize(keyframe->landmarks) &&
                 keyframe->landmarks[static_cast<std::size_t>(observation.feature)] == landmark->id,
             "a landmark and a keyframe disagree on who sees whom");
      ++observed;
    }
  }
  Demand(named == observed, "a keyframe names a landmark that does not know of it");
}

}  // namespace

MapContents Map::Contents() const {
  MapContents contents;
  for (const auto& [id, keyframe] : keyframes_) contents.keyframes.push_back(*keyframe);
  for (const Landmark* landmark : Landmarks()) contents.landmarks.push_back(*landmark);
  contents.generations = generations_;
  contents.vacant = vacant_;
  for (const auto& [id, gone] : retired()) contents.retired.push_back(gone);
  contents.closed_loops.assign(closed_loops_.begin(), closed_loops_.end());
  contents.next_keyframe = next_keyframe_;
  return contents;
}

Map::Map(const MapContents& contents) {
  CheckSlots(contents);
  CheckAncestry(contents);
  for (const Keyframe& keyframe : contents.keyframes) {
    keyframes_.emplace(keyframe.id, std::make_shared<Keyframe>(keyframe));
    part_count_ += !keyframe.parent.valid();
  }
  landmarks_.resize(contents.generations.size());
  for (const Landmark& landmark : contents.landmarks) {
    landmarks_[static_cast<std::size_t>(landmark.id.slot)] = std::make_shared<Landmark>(landmark);
  }
  generations_ = contents.generations;
  vacant_ = contents.vacant;
  for (const RetiredKeyframe& one : contents.retired) Retire(one);
  for (const ClosedLoop& loop : contents.closed_loops) {
    Demand(loop.current != loop.matched && Find(loop.current) && Find(loop.matched) &&
               closed_loops_.insert(loop).second,
           "a closed loop is not between two keyframes, or twice there");
  }
  landmark_count_ = static_cast<int>(contents.landmarks.size());
  next_keyframe_ = contents.next_keyframe;
  CheckObservations(*this);
}

}  // namespace aisle::slam
