#include "slam/map/map_file.h"

#include <gmock/gmock.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <limits>

#include "tests/slam/mapping/ring_world.h"

namespace aisle::slam {
namespace {

namespace fs = std::filesystem;

std::string BytesOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void Write(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary).write(bytes.data(), std::ssize(bytes));
}

std::string ErrorOf(const fs::path& file) {
  try {
    LoadMap(file);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

/// A ring with a past: keyframes and landmarks have gone, and slots are vacant.
SavedMap UsedMap() {
  const RingWorld ring({.drift = 1.01, .turn_rad = 0.003});
  SavedMap saved{ring.camera(), {42}, ring.map()};
  MapEdit edit;
  edit.removed_keyframes = {{5}, {6}, {17}};
  const auto landmarks = saved.map.Landmarks();
  for (std::size_t i = 0; i < landmarks.size(); i += 7) {
    edit.removed_landmarks.push_back(landmarks[i]->id);
  }
  edit.counts = {{landmarks[1]->id, 7, 3}};
  edit.closed_loops = {{{41}, {1}}, {{42}, {5}}};
  saved.map.Apply(edit);
  return saved;
}

class MapFile : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder); }
  void TearDown() override { fs::remove_all(folder); }

  const fs::path folder =
      fs::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
  const fs::path file = folder / "ring.map";
};

TEST_F(MapFile, GivesBackTheMapToTheLastBit) {
  const SavedMap saved = UsedMap();
  SaveMap(saved, file);
  const SavedMap loaded = LoadMap(file);
  EXPECT_EQ(loaded.camera, saved.camera);
  EXPECT_EQ(loaded.reference, saved.reference);
  ASSERT_EQ(loaded.map.keyframes().size(), saved.map.keyframes().size());
  EXPECT_EQ(loaded.map.landmark_count(), saved.map.landmark_count());
  for (const auto& [id, keyframe] : saved.map.keyframes()) {
    EXPECT_EQ(loaded.map.At(id).T_world_rig.matrix(), keyframe->T_world_rig.matrix());
    EXPECT_EQ(loaded.map.At(id).landmarks, keyframe->landmarks);
  }
  for (const Landmark* landmark : saved.map.Landmarks()) {
    const Landmark& other = loaded.map.At(landmark->id);
    EXPECT_EQ(other.position, landmark->position);
    EXPECT_EQ(other.observations, landmark->observations);
    EXPECT_EQ(other.predicted, landmark->predicted);
  }
  EXPECT_EQ(loaded.map.closed_loops(), saved.map.closed_loops());
  EXPECT_EQ(loaded.map.PoseOf({6}).matrix(), saved.map.PoseOf({6}).matrix());
  // And all the rest: what is saved of it again is the same file.
  SaveMap(loaded, folder / "again.map");
  EXPECT_EQ(BytesOf(folder / "again.map"), BytesOf(file));
}

TEST_F(MapFile, ALoadedMapGrowsOnAsTheOriginalDoes) {
  SavedMap a = UsedMap();
  SaveMap(a, file);
  SavedMap b = LoadMap(file);
  // New landmarks take the vacant slots in the same order.
  MapEdit edit;
  Keyframe keyframe = a.map.At(a.reference);
  keyframe.id = a.map.NextKeyframeId();
  keyframe.parent = a.reference;
  for (LandmarkId& id : keyframe.landmarks) id = {};
  edit.new_keyframes = {keyframe};
  for (int i = 0; i < 20; ++i) {
    Landmark landmark;
    landmark.position = {0.1 * i, 0, 3};
    landmark.observations = {{keyframe.id, i}};
    landmark.created_by = keyframe.id;
    edit.new_landmarks.push_back(landmark);
  }
  a.map.Apply(edit);
  b.map.Apply(edit);
  SaveMap(a, folder / "a.map");
  SaveMap(b, folder / "b.map");
  EXPECT_EQ(BytesOf(folder / "a.map"), BytesOf(folder / "b.map"));
}

/// What a full disk does to a writer: files of this process end at so many bytes.
class FilesEndAt {
 public:
  explicit FilesEndAt(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
  }
  ~FilesEndAt() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int) = nullptr;
};

TEST_F(MapFile, AFullDiskLeavesTheOldMapAndNothingAside) {
  SaveMap(UsedMap(), file);
  const std::string whole = BytesOf(file);
  for (const std::size_t room : {std::size_t{0}, std::size_t{100}, whole.size() - 1}) {
    const FilesEndAt full(room);
    EXPECT_THROW(SaveMap(UsedMap(), file), std::runtime_error) << room;
    EXPECT_THROW(SaveMap(UsedMap(), folder / "new.map"), std::runtime_error) << room;
  }
  EXPECT_EQ(BytesOf(file), whole);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator{}), 1);
}

TEST_F(MapFile, NoDamageGoesUnnoticed) {
  SaveMap(UsedMap(), file);
  const std::string whole = BytesOf(file);
  const fs::path broken = folder / "broken.map";
  for (const std::size_t at : {std::size_t{40}, whole.size() / 2, whole.size() - 1}) {
    for (const int bit : {0, 3, 7}) {
      std::string bytes = whole;
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << bit));
      Write(broken, bytes);
      EXPECT_THAT(ErrorOf(broken), testing::HasSubstr("broken.map: damaged"))
          << "byte " << at << " bit " << bit;
    }
  }
  for (const std::size_t length : {std::size_t{50}, whole.size() / 3, whole.size() - 1}) {
    Write(broken, whole.substr(0, length));
    EXPECT_THAT(ErrorOf(broken), testing::HasSubstr("damaged")) << length << " bytes";
  }
  Write(broken, whole + "x");
  EXPECT_THAT(ErrorOf(broken), testing::HasSubstr("damaged"));
}

TEST_F(MapFile, NumbersThatNoMapHasAreRefusedThoughTheChecksumIsRight) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto expect_refused = [&](const char* what, auto&& spoil) {
    SavedMap saved = UsedMap();
    MapContents contents = saved.map.Contents();
    auto frame = std::make_shared<Frame>(*contents.keyframes[0].frame);
    spoil(contents, *frame, saved.camera);
    contents.keyframes[0].frame = frame;
    saved.map = Map(contents);
    SaveMap(saved, file);
    EXPECT_THAT(ErrorOf(file), testing::HasSubstr("damaged: ")) << what;
  };
  expect_refused("no pixel",
                 [&](auto&, Frame& f, auto&) { f.features.keypoints[0].pixel.x = nan; });
  expect_refused("far pixel",
                 [](auto&, Frame& f, auto&) { f.features.keypoints[0].pixel.y = 1e9f; });
  expect_refused("level", [](auto&, Frame& f, auto&) { f.features.keypoints[0].level = 1 << 30; });
  expect_refused("scale", [](auto&, Frame& f, auto&) { f.scale = 0; });
  expect_refused("measured", [&](auto&, Frame& f, auto&) { f.measurements[0].uvd.z() = nan; });
  expect_refused("image", [](auto&, auto&, StereoCamera& camera) { camera.width = 1 << 30; });
  expect_refused("pose",
                 [&](MapContents& c, auto&, auto&) { c.keyframes[0].T_world_rig.linear() *= 3; });
  expect_refused("landmark",
                 [&](MapContents& c, auto&, auto&) { c.landmarks[0].position.x() = nan; });
  expect_refused("never", [](MapContents& c, auto&, auto&) { c.landmarks[0].found = -1; });
}

TEST_F(MapFile, WhatIsNoMapIsCalledThat) {
  EXPECT_THAT(ErrorOf(folder / "absent.map"), testing::HasSubstr("absent.map: cannot open it"));
  EXPECT_THAT(ErrorOf(folder), testing::HasSubstr("cannot open it"));
  Write(file, "1403636579763555584,0,0,0,0,0,0,1, a trajectory and no map");
  EXPECT_THAT(ErrorOf(file), testing::HasSubstr("not a map; save one with"));
  Write(file, "");
  EXPECT_THAT(ErrorOf(file), testing::HasSubstr("not a map"));
  SaveMap(UsedMap(), file);
  std::string bytes = BytesOf(file);
  bytes[8] = 9;
  Write(file, bytes);
  EXPECT_THAT(ErrorOf(file), testing::HasSubstr("has version 9, but this program reads version 4"));
}

TEST_F(MapFile, AMapOfBeforeClosedLoopsWereKeptHasNone) {
  const fs::path old = fs::path(AISLE_SOURCE_DIR) / "tests/fuzz/corpus/map_file/two_keyframes.map";
  ASSERT_EQ(BytesOf(old)[8], 3);
  const SavedMap loaded = LoadMap(old);
  EXPECT_EQ(loaded.map.keyframes().size(), 2u);
  EXPECT_TRUE(loaded.map.closed_loops().empty());
}

TEST_F(MapFile, AFileThatCannotBeWrittenSaysSo) {
  EXPECT_THROW(SaveMap(UsedMap(), folder / "no" / "such.map"), std::runtime_error);
}

TEST(MapContents, ListsThatContradictEachOtherMakeNoMap) {
  const MapContents whole = UsedMap().map.Contents();
  EXPECT_NO_THROW(Map{whole});
  const auto expect_refused = [&](const char* what, auto&& spoil) {
    MapContents contents = whole;
    spoil(contents);
    EXPECT_THROW(Map{contents}, std::invalid_argument) << what;
  };
  expect_refused("slot twice", [](auto& c) { c.landmarks[1].id = c.landmarks[0].id; });
  expect_refused("slot beyond", [](auto& c) { c.vacant.push_back(1 << 30); });
  expect_refused("unseen landmark", [](auto& c) { c.landmarks[0].observations.clear(); });
  expect_refused("observation of nothing",
                 [](auto& c) { c.landmarks[0].observations[0].feature = 9999; });
  expect_refused("name of nothing", [](auto& c) { c.keyframes[0].landmarks[0] = {3, 99}; });
  expect_refused("own parent", [](auto& c) { c.keyframes[3].parent = c.keyframes[3].id; });
  expect_refused("parent unknown", [](auto& c) { c.keyframes.erase(c.keyframes.begin()); });
  expect_refused("order", [](auto& c) { std::swap(c.keyframes[0], c.keyframes[1]); });
  expect_refused("number", [](auto& c) { c.next_keyframe = 3; });
  expect_refused("one number too far", [](auto& c) { ++c.next_keyframe; });
  expect_refused("number beyond memory",
                 [](auto& c) { c.next_keyframe = std::numeric_limits<std::int64_t>::max(); });
  expect_refused("keyframe and number beyond memory", [](auto& c) {
    c.keyframes.back().id.value = std::int64_t{1} << 50;
    c.next_keyframe = (std::int64_t{1} << 50) + 1;
  });
  expect_refused("loop to nowhere", [](auto& c) { c.closed_loops[0].matched = {5}; });
  expect_refused("loop to itself", [](auto& c) { c.closed_loops[0].matched = {41}; });
  expect_refused("loop twice", [](auto& c) { c.closed_loops[1] = c.closed_loops[0]; });
  expect_refused("retired in the future",
                 [](auto& c) { c.retired.back().id.value = c.next_keyframe; });
}

}  // namespace
}  // namespace aisle::slam
