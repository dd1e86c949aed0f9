#include "slam/map/map.h"

#include <algorithm>
#include <stdexcept>

#include "slam/map/landmark_view.h"

namespace aisle::slam {
namespace {

auto FindObservation(std::vector<Observation>& observations, KeyframeId keyframe) {
  return std::lower_bound(
      observations.begin(), observations.end(), keyframe,
      [](const Observation& observation, KeyframeId id) { return observation.keyframe < id; });
}

/// Copy on write: what only this map holds is changed in place, the rest is copied first.
template <typename Node>
Node* Own(std::shared_ptr<const Node>& node) {
  if (node.use_count() != 1) node = std::make_shared<Node>(*node);
  return const_cast<Node*>(node.get());  // made non-const above or by an earlier Own
}

}  // namespace

const std::map<KeyframeId, RetiredKeyframe>& Map::retired() const {
  static const std::map<KeyframeId, RetiredKeyframe> none;
  return retired_ ? *retired_ : none;
}

const Keyframe* Map::Find(KeyframeId id) const {
  const auto found = keyframes_.find(id);
  return found == keyframes_.end() ? nullptr : found->second.get();
}

const Landmark* Map::Find(LandmarkId id) const {
  if (id.slot < 0 || id.slot >= std::ssize(landmarks_)) return nullptr;
  const Landmark* landmark = landmarks_[static_cast<std::size_t>(id.slot)].get();
  return landmark && landmark->id == id ? landmark : nullptr;
}

const Keyframe& Map::At(KeyframeId id) const {
  const Keyframe* keyframe = Find(id);
  if (!keyframe) throw std::logic_error(fmt::format("no keyframe {} in the map", id.value));
  return *keyframe;
}

const Landmark& Map::At(LandmarkId id) const {
  const Landmark* landmark = Find(id);
  if (!landmark) throw std::logic_error(fmt::format("no landmark {} in the map", id.slot));
  return *landmark;
}

std::vector<const Landmark*> Map::Landmarks() const {
  std::vector<const Landmark*> landmarks;
  landmarks.reserve(static_cast<std::size_t>(landmark_count_));
  for (const auto& landmark : landmarks_) {
    if (landmark) landmarks.push_back(landmark.get());
  }
  return landmarks;
}

Eigen::Isometry3d Map::PoseOf(KeyframeId id) const {
  Eigen::Isometry3d T_heir_rig = Eigen::Isometry3d::Identity();
  for (;;) {
    if (const Keyframe* keyframe = Find(id)) return keyframe->T_world_rig * T_heir_rig;
    const auto gone = retired().find(id);
    if (gone == retired().end()) {
      throw std::logic_error(fmt::format("keyframe {} was never in the map", id.value));
    }
    T_heir_rig = gone->second.T_heir_rig * T_heir_rig;
    id = gone->second.heir;
  }
}

KeyframeId Map::StandIn(KeyframeId id) const {
  while (!Find(id)) {
    const auto gone = retired().find(id);
    if (gone == retired().end()) {
      throw std::logic_error(fmt::format("keyframe {} was never in the map", id.value));
    }
    id = gone->second.heir;
  }
  return id;
}

Keyframe* Map::Change(KeyframeId id) {
  const auto found = keyframes_.find(id);
  return found == keyframes_.end() ? nullptr : Own(found->second);
}

Landmark* Map::Change(LandmarkId id) {
  return Find(id) ? Own(landmarks_[static_cast<std::size_t>(id.slot)]) : nullptr;
}

void Map::Insert(const Keyframe& keyframe) {
  if (keyframe.id.value < next_keyframe_) {
    throw std::logic_error(
        fmt::format("keyframe {} comes after {}", keyframe.id.value, next_keyframe_ - 1));
  }
  next_keyframe_ = keyframe.id.value + 1;
  auto node = std::make_shared<Keyframe>(keyframe);
  if (!Find(node->parent)) node->parent = {};
  part_count_ += !node->parent.valid();
  node->landmarks.assign(keyframe.landmarks.size(), LandmarkId{});
  keyframes_.emplace(keyframe.id, std::move(node));
  for (std::size_t i = 0; i < keyframe.landmarks.size(); ++i) {
    if (keyframe.landmarks[i].valid()) {
      LinkUp(keyframe.landmarks[i], {keyframe.id, static_cast<int>(i)});
    }
  }
}

void Map::Insert(Landmark landmark) {
  if (vacant_.empty()) {
    vacant_.push_back(static_cast<std::int32_t>(landmarks_.size()));
    landmarks_.emplace_back();
    generations_.push_back(0);
  }
  const std::int32_t slot = vacant_.back();
  vacant_.pop_back();
  landmark.id = {slot, generations_[static_cast<std::size_t>(slot)]++};
  const std::vector<Observation> observations = std::exchange(landmark.observations, {});
  const LandmarkId id = landmark.id;
  landmarks_[static_cast<std::size_t>(slot)] = std::make_shared<Landmark>(std::move(landmark));
  ++landmark_count_;
  for (const Observation& observation : observations) LinkUp(id, observation);
}

void Map::LinkUp(LandmarkId id, const Observation& observation) {
  const Landmark* seen = Find(id);
  const Keyframe* by = Find(observation.keyframe);
  if (!seen || !by || by->landmarks.at(static_cast<std::size_t>(observation.feature)).valid()) {
    return;
  }
  Landmark* landmark = Change(id);
  const auto place = FindObservation(landmark->observations, observation.keyframe);
  if (place != landmark->observations.end() && place->keyframe == observation.keyframe) return;
  landmark->observations.insert(place, observation);
  Change(observation.keyframe)->landmarks[static_cast<std::size_t>(observation.feature)] = id;
}

void Map::Cut(LandmarkId id, const Observation& observation) {
  Landmark* landmark = Change(id);
  if (!landmark) return;
  const auto place = FindObservation(landmark->observations, observation.keyframe);
  if (place == landmark->observations.end() || *place != observation) return;
  landmark->observations.erase(place);
  Change(observation.keyframe)->landmarks[static_cast<std::size_t>(observation.feature)] = {};
}

void Map::MergeInto(LandmarkId gone, LandmarkId kept) {
  const Landmark* from = Find(gone);
  if (gone == kept || !from || !Find(kept)) return;
  const Landmark copy = *from;
  Remove(gone);
  for (const Observation& observation : copy.observations) LinkUp(kept, observation);
  Landmark* into = Change(kept);
  into->predicted += copy.predicted;
  into->found += copy.found;
}

void Map::Remove(LandmarkId id) {
  const Landmark* landmark = Find(id);
  if (!landmark) return;
  for (const Observation& observation : landmark->observations) {
    Change(observation.keyframe)->landmarks[static_cast<std::size_t>(observation.feature)] = {};
  }
  landmarks_[static_cast<std::size_t>(id.slot)].reset();
  vacant_.push_back(id.slot);
  --landmark_count_;
}

void Map::Remove(KeyframeId id) {
  const Keyframe* keyframe = Find(id);
  if (!keyframe) return;
  for (std::size_t i = 0; i < keyframe->landmarks.size(); ++i) {
    const LandmarkId landmark = keyframe->landmarks[i];
    if (landmark.valid()) Cut(landmark, {id, static_cast<int>(i)}), keyframe = Find(id);
  }
  const KeyframeId heir = keyframe->parent;
  if (const Keyframe* parent = Find(heir)) {
    Retire({id, heir, parent->T_world_rig.inverse() * keyframe->T_world_rig});
  }
  for (auto& [other, node] : keyframes_) {
    if (node->parent == id) SetParent(*Own(node), heir);
  }
  part_count_ -= !heir.valid();
  keyframes_.erase(id);
  HandDownLoops(id, heir);
}

void Map::HandDownLoops(KeyframeId from, KeyframeId heir) {
  std::vector<ClosedLoop> theirs;
  for (const ClosedLoop& loop : closed_loops_) {
    if (loop.current == from || loop.matched == from) theirs.push_back(loop);
  }
  for (ClosedLoop loop : theirs) {
    closed_loops_.erase(loop);
    if (loop.current == from) loop.current = heir;
    if (loop.matched == from) loop.matched = heir;
    Close(loop);
  }
}

void Map::Close(const ClosedLoop& loop) {
  if (loop.current != loop.matched && Find(loop.current) && Find(loop.matched)) {
    closed_loops_.insert(loop);
  }
}

void Map::Retire(const RetiredKeyframe& one) {
  if (!retired_) retired_ = std::make_shared<std::map<KeyframeId, RetiredKeyframe>>();
  Own(retired_)->insert_or_assign(one.id, one);
}

void Map::SetParent(Keyframe& keyframe, KeyframeId parent) {
  part_count_ += keyframe.parent.valid() - parent.valid();
  keyframe.parent = parent;
}

void Map::Apply(const MapEdit& edit) {
  std::vector<LandmarkId> touched;
  for (const Keyframe& keyframe : edit.new_keyframes) {
    Insert(keyframe);
    touched.insert(touched.end(), keyframe.landmarks.begin(), keyframe.landmarks.end());
  }
  for (const Landmark& landmark : edit.new_landmarks) {
    const std::int32_t slot =
        vacant_.empty() ? static_cast<std::int32_t>(landmarks_.size()) : vacant_.back();
    Insert(landmark);
    touched.push_back(landmarks_[static_cast<std::size_t>(slot)]->id);
  }
  for (const auto& [id, T_world_rig] : edit.poses) {
    if (Keyframe* keyframe = Change(id)) keyframe->T_world_rig = T_world_rig;
  }
  for (const auto& [id, parent] : edit.parents) {
    if (Find(parent) && parent < id && Find(id)) SetParent(*Change(id), parent);
  }
  for (const auto& [id, position] : edit.positions) {
    if (Landmark* landmark = Change(id)) landmark->position = position;
    touched.push_back(id);
  }
  for (const auto& [id, observation] : edit.links) LinkUp(id, observation), touched.push_back(id);
  for (const auto& [gone, kept] : edit.merges) MergeInto(gone, kept), touched.push_back(kept);
  for (const auto& [id, observation] : edit.cuts) Cut(id, observation), touched.push_back(id);
  for (const auto& [id, predicted, found] : edit.counts) {
    if (Landmark* landmark = Change(id)) landmark->predicted += predicted, landmark->found += found;
  }
  for (const ClosedLoop& loop : edit.closed_loops) Close(loop);
  for (const LandmarkId id : edit.removed_landmarks) Remove(id);
  for (const KeyframeId id : edit.removed_keyframes) {
    if (const Keyframe* keyframe = Find(id)) {
      touched.insert(touched.end(), keyframe->landmarks.begin(), keyframe->landmarks.end());
    }
    Remove(id);
  }

  // What follows from the observations is brought up to date here, and nowhere else.
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  for (const LandmarkId id : touched) {
    const Landmark* landmark = Find(id);
    if (!landmark) continue;
    landmark->observations.empty() ? Remove(id) : RefreshView(*this, *Change(id));
  }
}

std::vector<int> CountSeen(const Map& map, std::span<const LandmarkId> landmarks) {
  std::vector<int> seen(static_cast<std::size_t>(map.NextKeyframeId().value), 0);
  for (const LandmarkId id : landmarks) {
    const Landmark* landmark = map.Find(id);
    if (!landmark) continue;
    for (const Observation& observation : landmark->observations) {
      ++seen[static_cast<std::size_t>(observation.keyframe.value)];
    }
  }
  return seen;
}

std::vector<Covisible> CovisibleKeyframes(const Map& map, KeyframeId id, int least_shared) {
  std::vector<int> shared = CountSeen(map, map.At(id).landmarks);
  shared[static_cast<std::size_t>(id.value)] = 0;
  std::vector<Covisible> covisible;
  for (std::size_t i = 0; i < shared.size(); ++i) {
    if (shared[i] >= std::max(least_shared, 1)) {
      covisible.push_back({KeyframeId{static_cast<std::int64_t>(i)}, shared[i]});
    }
  }
  std::stable_sort(covisible.begin(), covisible.end(),
                   [](const Covisible& a, const Covisible& b) { return a.shared > b.shared; });
  return covisible;
}

KeyframeId RootOf(const Map& map, KeyframeId id) {
  while (map.At(id).parent.valid()) id = map.At(id).parent;
  return id;
}

std::map<KeyframeId, KeyframeId> Roots(const Map& map) {
  std::map<KeyframeId, KeyframeId> roots;
  for (const auto& [id, keyframe] : map.keyframes()) {
    // Parents are older than their children: theirs is known by now.
    roots[id] = keyframe->parent.valid() ? roots.at(keyframe->parent) : id;
  }
  return roots;
}

KeyframeId LargestPart(const Map& map) {
  std::map<KeyframeId, int> sizes;
  for (const auto& [id, root] : Roots(map)) ++sizes[root];
  const auto smaller = [](const auto& a, const auto& b) { return a.second < b.second; };
  return std::max_element(sizes.begin(), sizes.end(), smaller)->first;
}

int ObservationWeight(const Map& map, const Landmark& landmark) {
  int weight = 0;
  for (const Observation& observation : landmark.observations) {
    const Frame& frame = *map.At(observation.keyframe).frame;
    const auto feature = static_cast<std::size_t>(observation.feature);
    weight += frame.measurements[feature].has_depth() ? 2 : 1;
  }
  return weight;
}

}  // namespace aisle::slam
