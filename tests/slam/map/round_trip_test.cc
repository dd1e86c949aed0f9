// Whatever has become of a map: it is saved and loaded to the last bit.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <unistd.h>

#include <fstream>
#include <random>

#include "slam/map/map_file.h"
#include "tests/slam/mapping/ring_world.h"
#include "tests/support/arbitrary.h"

namespace aisle::slam {
namespace {

namespace fs = std::filesystem;

std::string BytesOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Removes and moves some of what is there.
MapEdit AnyEdit(const Map& map) {
  MapEdit edit;
  std::mt19937 random(AnyWhole<unsigned>());  // thousands of landmarks are no values to shrink
  const auto one_in = [&](unsigned n) { return random() % n == 0; };
  for (const auto& [id, keyframe] : map.keyframes()) {
    if (id.value > 0 && one_in(10)) {
      edit.removed_keyframes.push_back(id);
    } else if (one_in(3)) {
      edit.poses.push_back({id, AnyPose()});
    }
  }
  for (const Landmark* landmark : map.Landmarks()) {
    if (one_in(9)) {
      edit.removed_landmarks.push_back(landmark->id);
    } else if (one_in(9)) {
      edit.counts.push_back({landmark->id, static_cast<int>(random() % 1000), 7});
    }
  }
  return edit;
}

TEST(MapRoundTrip, KeepsEveryBitOfAMapThatWasEditedAtWill) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("aisle_maps_{}", ::getpid());
  fs::create_directories(folder);
  const RingWorld ring({.drift = 1.01, .turn_rad = 0.003});
  const auto once = [&] {
    SavedMap saved{ring.camera(), {AnyOf(0, 1)}, ring.map()};
    for (int edits = AnyOf(0, 4); edits > 0; --edits) saved.map.Apply(AnyEdit(saved.map));
    saved.camera.fx = AnyNumberIn(20, 10000);
    SaveMap(saved, folder / "a.map");
    const SavedMap loaded = LoadMap(folder / "a.map");
    RC_ASSERT(loaded.camera == saved.camera);
    RC_ASSERT(loaded.reference == saved.reference);
    RC_ASSERT(loaded.map.keyframes().size() == saved.map.keyframes().size());
    for (const auto& [id, keyframe] : saved.map.keyframes()) {
      RC_ASSERT(loaded.map.At(id).T_world_rig.matrix() == keyframe->T_world_rig.matrix());
      RC_ASSERT(loaded.map.At(id).landmarks == keyframe->landmarks);
    }
    RC_ASSERT(loaded.map.landmark_count() == saved.map.landmark_count());
    for (const Landmark* landmark : saved.map.Landmarks()) {
      RC_ASSERT(loaded.map.At(landmark->id).position == landmark->position);
      RC_ASSERT(loaded.map.At(landmark->id).observations == landmark->observations);
    }
    SaveMap(loaded, folder / "b.map");
    RC_ASSERT(BytesOf(folder / "b.map") == BytesOf(folder / "a.map"));
  };
  EXPECT_TRUE(rc::check(once));
  fs::remove_all(folder);
}

}  // namespace
}  // namespace aisle::slam
