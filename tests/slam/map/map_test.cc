#include "slam/map/map.h"

#include <gtest/gtest.h>

#include <random>

#include "slam/map/cull.h"
#include "slam/map/match_by_projection.h"

namespace aisle::slam {
namespace {

std::shared_ptr<const Frame> MakeFrame(int features) {
  auto frame = std::make_shared<Frame>();
  for (int i = 0; i < features; ++i) {
    frame->features.keypoints.push_back({{10.0f * static_cast<float>(i), 50}, 0, 0, 1});
    frame->features.descriptors.push_back({static_cast<std::uint64_t>(i), 0, 0, 0});
    frame->measurements.push_back({{10.0 * i, 50, 10}, 1, 0.5});
  }
  frame->grid = FeatureGrid(frame->features.keypoints, {752, 480});
  return frame;
}

Keyframe MakeKeyframe(const Map& map, int features, KeyframeId parent = {}) {
  Keyframe keyframe;
  keyframe.id = map.NextKeyframeId();
  keyframe.frame = MakeFrame(features);
  keyframe.T_world_rig.translation().x() = static_cast<double>(keyframe.id.value);
  keyframe.parent = parent;
  keyframe.landmarks.resize(static_cast<std::size_t>(features));
  return keyframe;
}

KeyframeId AddKeyframe(Map& map, int features, KeyframeId parent = {}) {
  MapEdit edit;
  edit.new_keyframes = {MakeKeyframe(map, features, parent)};
  map.Apply(edit);
  return edit.new_keyframes[0].id;
}

LandmarkId AddLandmark(Map& map, const std::vector<Observation>& observations) {
  MapEdit edit;
  Landmark landmark;
  landmark.position = {1, 2, 5};
  landmark.observations = observations;
  landmark.created_by = observations.front().keyframe;
  edit.new_landmarks = {landmark};
  map.Apply(edit);
  return map.At(observations.front().keyframe)
      .landmarks[static_cast<std::size_t>(observations.front().feature)];
}

/// The promises of Map's header.
void ExpectWhole(const Map& map) {
  std::size_t named = 0, observed = 0;
  for (const auto& [id, keyframe] : map.keyframes()) {
    EXPECT_EQ(keyframe->id, id);
    EXPECT_TRUE(!keyframe->parent.valid() || map.Find(keyframe->parent));
    for (std::size_t i = 0; i < keyframe->landmarks.size(); ++i) {
      if (!keyframe->landmarks[i].valid()) continue;
      ++named;
      const Landmark* landmark = map.Find(keyframe->landmarks[i]);
      ASSERT_TRUE(landmark);
      const Observation observation{id, static_cast<int>(i)};
      EXPECT_TRUE(
          std::count(landmark->observations.begin(), landmark->observations.end(), observation));
    }
  }
  for (const Landmark* landmark : map.Landmarks()) {
    EXPECT_FALSE(landmark->observations.empty());
    EXPECT_TRUE(std::is_sorted(landmark->observations.begin(), landmark->observations.end()));
    observed += landmark->observations.size();
  }
  EXPECT_EQ(named, observed);
  EXPECT_EQ(std::ssize(map.Landmarks()), map.landmark_count());
  int roots = 0;
  for (const auto& [id, root] : Roots(map)) roots += id == root;
  EXPECT_EQ(map.part_count(), roots);
}

TEST(Map, StaysWholeUnderAnyEdits) {
  Map map;
  std::mt19937 random(3);
  const auto pick = [&](auto count) {
    return static_cast<int>(random() % static_cast<unsigned>(count));
  };
  AddKeyframe(map, 12);
  for (int round = 0; round < 300; ++round) {
    const auto any_keyframe = [&] {
      return std::next(map.keyframes().begin(), pick(map.keyframes().size()))->first;
    };
    const auto any_landmark = [&] {
      const auto all = map.Landmarks();
      return all.empty() ? LandmarkId{} : all[static_cast<std::size_t>(pick(all.size()))]->id;
    };
    MapEdit edit;
    if (pick(3) == 0) {
      const bool apart = pick(8) == 0;  // the first of a part of its own
      edit.new_keyframes = {MakeKeyframe(map, 12, apart ? KeyframeId{} : any_keyframe())};
    }
    for (int i = 0; i < 4; ++i) {
      Landmark landmark;
      landmark.observations = {{any_keyframe(), pick(12)}, {any_keyframe(), pick(12)}};
      landmark.created_by = landmark.observations[0].keyframe;
      edit.new_landmarks.push_back(landmark);
    }
    edit.links.push_back({any_landmark(), {any_keyframe(), pick(12)}});
    edit.merges.push_back({any_landmark(), any_landmark()});
    edit.cuts.push_back({any_landmark(), {any_keyframe(), pick(12)}});
    edit.positions.push_back({any_landmark(), {1, 1, 1}});
    if (pick(4) == 0) edit.removed_landmarks.push_back(any_landmark());
    if (pick(4) == 0) edit.parents.push_back({any_keyframe(), any_keyframe()});
    if (pick(6) == 0) {
      const KeyframeId going = any_keyframe();
      if (going != map.keyframes().begin()->first) edit.removed_keyframes.push_back(going);
    }
    const Map before = map;
    map.Apply(edit);
    ExpectWhole(map);
    ExpectWhole(before);
  }
}

TEST(Map, CopiesHaveFormerKeyframesInCommon) {
  Map map;
  AddKeyframe(map, 1);
  MapEdit culling;
  for (int k = 1; k <= 1000; ++k) culling.removed_keyframes.push_back(AddKeyframe(map, 1, {k - 1}));
  map.Apply(culling);
  Map copy = map;
  ASSERT_EQ(copy.retired().size(), 1000u);
  EXPECT_EQ(&copy.retired(), &map.retired());  // not one of them is copied
  // What is added to the map, and what changes in it, parts them no more.
  const KeyframeId another = AddKeyframe(copy, 1, {0});
  AddLandmark(copy, {{another, 0}});
  EXPECT_EQ(&copy.retired(), &map.retired());
  MapEdit again;
  again.removed_keyframes = {another};
  copy.Apply(again);
  EXPECT_EQ(copy.retired().size(), 1001u);
  EXPECT_EQ(map.retired().size(), 1000u);
  EXPECT_EQ(map.StandIn({1000}), KeyframeId{0});
  EXPECT_EQ(copy.PoseOf(another).translation().x(), 1001);
}

TEST(Map, ACopyDoesNotSeeLaterEdits) {
  Map map;
  const KeyframeId keyframe = AddKeyframe(map, 3);
  const LandmarkId landmark = AddLandmark(map, {{keyframe, 1}});
  const Map before = map;
  MapEdit edit;
  edit.positions = {{landmark, {9, 9, 9}}};
  edit.poses = {{keyframe, Eigen::Isometry3d(Eigen::Translation3d(7, 7, 7))}};
  map.Apply(edit);
  EXPECT_EQ(before.At(landmark).position, Eigen::Vector3d(1, 2, 5));
  EXPECT_EQ(before.At(keyframe).T_world_rig.translation().x(), 0);
  EXPECT_EQ(map.At(landmark).position, Eigen::Vector3d(9, 9, 9));
}

TEST(Map, AnOldIdDoesNotNameTheNextTenantOfItsSlot) {
  Map map;
  const KeyframeId keyframe = AddKeyframe(map, 3);
  const LandmarkId old = AddLandmark(map, {{keyframe, 0}});
  MapEdit edit;
  edit.removed_landmarks = {old};
  map.Apply(edit);
  const LandmarkId next = AddLandmark(map, {{keyframe, 0}});
  EXPECT_EQ(next.slot, old.slot);
  EXPECT_EQ(map.Find(old), nullptr);
  EXPECT_NE(map.Find(next), nullptr);
}

TEST(Map, FreesWhatIsRemoved) {
  Map map;
  const KeyframeId first = AddKeyframe(map, 3);
  const KeyframeId second = AddKeyframe(map, 3, first);
  const std::weak_ptr<const Frame> frame = map.At(second).frame;
  MapEdit edit;
  edit.removed_keyframes = {second};
  map.Apply(edit);
  EXPECT_TRUE(frame.expired());
}

TEST(Map, CarriesTheMemoryOfARemovedKeyframeAlong) {
  Map map;
  const KeyframeId first = AddKeyframe(map, 3);
  const KeyframeId second = AddKeyframe(map, 3, first);
  const KeyframeId third = AddKeyframe(map, 3, second);
  MapEdit edit;
  edit.removed_keyframes = {third};
  map.Apply(edit);
  edit.removed_keyframes = {second};
  map.Apply(edit);
  EXPECT_NEAR(map.PoseOf(third).translation().x(), 2, 1e-12);
  MapEdit shift;
  shift.poses = {{first, Eigen::Isometry3d(Eigen::Translation3d(10, 0, 0))}};
  map.Apply(shift);
  EXPECT_NEAR(map.PoseOf(third).translation().x(), 12, 1e-12);
  EXPECT_THROW(map.PoseOf({99}), std::logic_error);
}

TEST(CullLandmarks, RemovesTheUnconfirmedAndTheHardlyFound) {
  Map map;
  const KeyframeId a = AddKeyframe(map, 5);
  const KeyframeId b = AddKeyframe(map, 5, a);
  const LandmarkId confirmed = AddLandmark(map, {{a, 0}, {b, 0}});
  const LandmarkId alone = AddLandmark(map, {{a, 1}});
  const LandmarkId shy = AddLandmark(map, {{a, 2}, {b, 2}});
  MapEdit edit;
  edit.counts = {{confirmed, 10, 9}, {alone, 10, 9}, {shy, 100, 5}};
  map.Apply(edit);
  map.Apply(CullLandmarks(map, b, {}));
  EXPECT_TRUE(map.Find(alone));  // still on probation
  EXPECT_FALSE(map.Find(shy));
  const KeyframeId c = AddKeyframe(map, 5, b);
  edit = {};
  edit.links = {{confirmed, {c, 0}}};
  map.Apply(edit);
  map.Apply(CullLandmarks(map, c, {}));
  EXPECT_TRUE(map.Find(confirmed));
  EXPECT_FALSE(map.Find(alone));
  ExpectWhole(map);
}

TEST(CullLandmarks, ProbationCountsTheKeyframesThatAreThere) {
  Map map;
  for (int k = 0; k < 6; ++k) AddKeyframe(map, 1, {k - 1});
  MapEdit edit;
  edit.removed_keyframes = {{3}};
  map.Apply(edit);
  AddLandmark(map, {{{2}, 0}, {{5}, 0}});  // since it came: keyframes 4 and 5
  CullOptions options;
  options.least_weight = 99;
  for (const int probation : {0, 1, 2, 3, 4, 5, 6, 1000}) {
    options.probation_keyframes = probation;
    EXPECT_EQ(CullLandmarks(map, {5}, options).removed_landmarks.size(), probation <= 2)
        << probation;
  }
}

TEST(CullKeyframes, RemovesOnlyWhatOthersShowAsWell) {
  Map map;
  std::vector<KeyframeId> ids;
  for (int i = 0; i < 7; ++i) {
    ids.push_back(AddKeyframe(map, 10, ids.empty() ? KeyframeId{} : ids.back()));
  }
  for (int feature = 0; feature < 10; ++feature) {
    std::vector<Observation> observations;
    for (const KeyframeId id : ids) observations.push_back({id, feature});
    AddLandmark(map, observations);
  }
  map.Apply(CullKeyframes(map, ids.back(), {}));
  ExpectWhole(map);
  EXPECT_TRUE(map.Find(ids.front()));
  EXPECT_TRUE(map.Find(ids.back()));
  EXPECT_GE(map.keyframes().size(), 3u);
  EXPECT_LT(map.keyframes().size(), 7u);
  // Every landmark is still seen from enough places.
  for (const Landmark* landmark : map.Landmarks()) EXPECT_GE(landmark->observations.size(), 3u);
}

TEST(MatchByProjection, GivesAFeatureToTheNearestDescriptionInAnyOrder) {
  const auto frame = MakeFrame(5);
  Landmark near, far;
  near.id = {0, 0};
  near.descriptor = {2, 0, 0, 0};  // is feature 2
  far.id = {1, 0};
  far.descriptor = {2 | 0xff00, 0, 0, 0};
  const Expected expected[] = {{&far, {21, 50, 10}, 0}, {&near, {19, 51, 10}, 0}};
  const Expected reversed[] = {expected[1], expected[0]};
  for (const auto& list : {expected, reversed}) {
    const auto matches = MatchByProjection(*frame, std::span(list, 2), {4, 100, 0.9});
    ASSERT_EQ(matches.size(), 1u);
    EXPECT_EQ(matches[0].landmark, near.id);
    EXPECT_EQ(matches[0].feature, 2);
  }
}

TEST(Map, ClosedLoopsGoToTheParentOfWhoGoes) {
  Map map;
  KeyframeId last;
  for (int i = 0; i < 6; ++i) last = AddKeyframe(map, 1, last);
  MapEdit edit;
  edit.closed_loops = {{{5}, {1}}, {{4}, {2}}, {{5}, {9}}, {{3}, {3}}};
  map.Apply(edit);
  const std::set<ClosedLoop> between_present = {{{4}, {2}}, {{5}, {1}}};
  EXPECT_EQ(map.closed_loops(), between_present);
  const auto remove = [&](std::int64_t id) {
    MapEdit gone;
    gone.removed_keyframes = {{id}};
    map.Apply(gone);
  };
  remove(5);
  const std::set<ClosedLoop> handed_down = {{{4}, {1}}, {{4}, {2}}};
  EXPECT_EQ(map.closed_loops(), handed_down);
  remove(2), remove(4), remove(3);  // from the end down to where the loop began
  EXPECT_TRUE(map.closed_loops().empty());
  ExpectWhole(map);
}

}  // namespace
}  // namespace aisle::slam
