// One hash for a frame, however it is made: any number of threads, tiles in any order, alone or in
// sequence, in this process or in a fresh one. Embree's instruction set is pinned, because the last
// bits of a depth differ between sets.
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <unistd.h>
#include <xxhash.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "simulator/camera/pixel_rays.h"
#include "simulator/pipeline.h"
#include "tests/simulator/test_world.h"

namespace aisle::sim {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr int kFrame = 3;
constexpr const char* kIsa = "avx2";
constexpr const char* kProbe = "AISLE_DETERMINISM_PROBE";

/// Everything on that could remember, race or depend on the order.
PipelineOptions Everything() {
  PipelineOptions options;
  options.tracer.isa = options.shade.statics.isa = kIsa;
  options.shade.statics.texel_m = 0.15f;
  options.shade.statics.coarse_texel_m = 1.0f;
  options.shade.statics.directions = 32;
  options.sensor.exposure = 5.0f;
  options.shutter = {.motion_blur = true, .readout_ms = 10};
  options.auto_exposure.on = true;
  return options;
}

/// A mover that stays where its mesh is.
MoverState Standing(const TriangleMesh& mesh, std::uint16_t instance) {
  MoverState state;
  state.instance = instance;
  state.positions = mesh.positions;
  state.normals = mesh.normals;
  state.velocities.assign(mesh.positions.size(), Eigen::Vector3f::Zero());
  return state;
}

/// A pane across half the aisle, through which much else is seen.
void AddPane(WorldParts* parts) {
  const auto instance = static_cast<std::uint16_t>(parts->instances.size());
  const auto material = static_cast<std::uint16_t>(parts->materials.size());
  parts->instances.push_back({"pane", ObjectClass::kFurniture, true});
  parts->materials.push_back({.name = "pane", .albedo = 0.05f, .transmission = 0.7f});
  test::MeshBuilder pane;
  pane.Quad({5, -1, 0.4f}, {0, 1.2f, 0}, {0, 0, 1.4f}, material, instance);
  parts->mover_meshes.push_back(pane.mesh);
  parts->at = [at = parts->at, mesh = pane.mesh, instance](std::int64_t stamp_ns) {
    Snapshot snapshot = at(stamp_ns);
    snapshot.movers.push_back(Standing(mesh, instance));
    snapshot.movers.back().casts_shadow = false;
    return snapshot;
  };
}

/// A lamp under the roof that turns.
void AddBeam(WorldParts* parts) {
  parts->has_beams = true;
  parts->at = [at = parts->at](std::int64_t stamp_ns) {
    Snapshot snapshot = at(stamp_ns);
    const float turn = 2e-9f * static_cast<float>(stamp_ns);
    Beam beam{.origin = {6, 0, 4},
              .toward = Eigen::Vector3f(std::cos(turn), std::sin(turn), -1).normalized(),
              .power = 40,
              .cos_inner = 0.9f,
              .cos_outer = 0.7f};
    snapshot.beams.push_back(beam);
    return snapshot;
  };
}

/// A mirror at the hall's end, a floor that is polished, cartons with a relief.
void Finish(WorldParts* parts) {
  parts->materials[0].specular_f0 = 0.05f;
  parts->materials[0].roughness = 0.3f;
  cv::Mat3b relief(32, 32);
  cv::RNG(11).fill(relief, cv::RNG::UNIFORM, cv::Scalar(96, 96, 220), cv::Scalar(160, 160, 255));
  parts->materials[2].normal_texture = static_cast<int>(parts->textures.size());
  parts->textures.push_back({"relief", relief});
  const auto material = static_cast<std::uint16_t>(parts->materials.size());
  parts->materials.push_back(
      {.name = "mirror", .albedo = 0.05f, .specular_f0 = 0.9f, .roughness = 0.05f});
  test::MeshBuilder statics;
  statics.mesh = std::move(parts->statics.mesh);
  statics.instances = std::move(parts->statics.instances);
  statics.Quad({29.9f, -3, 0}, {0, 0, 5}, {0, 6, 0}, material, 2);
  parts->statics = {std::move(statics.mesh), std::move(statics.instances)};
}

WorldParts MovingHall() {
  WorldParts parts = test::Hall({.boxes = 200});
  Finish(&parts);
  AddPane(&parts);
  AddBeam(&parts);
  parts.rig = [](std::int64_t stamp_ns) {
    const double t = 1e-9 * static_cast<double>(stamp_ns);
    return test::LookAlong({1.5 + 0.5 * t, 0, 1.2}, 0.02 + 0.3 * t);
  };
  return parts;
}

StereoCamera SmallCamera() { return Coarser({}, 2); }

RenderedFrame Take(const Pipeline& pipeline, int frame) {
  const std::int64_t stamp = frame * kSecond / 4;
  return pipeline.Render(frame, stamp, pipeline.world().PlannedRigPose(stamp));
}

std::uint64_t HashOf(const RenderedFrame& frame) {
  XXH3_state_t* state = XXH3_createState();
  XXH3_64bits_reset(state);
  const FrameTruth& t = frame.truth;
  for (const cv::Mat& image : std::initializer_list<cv::Mat>{
           frame.left, frame.right, t.depth, t.depth_right, t.instance, t.instance_right,
           t.object_class, t.dynamic, t.dynamic_right, t.actor, t.actor_right}) {
    XXH3_64bits_update(state, image.data, image.total() * image.elemSize());
  }
  for (const ObjectTruth& object : t.objects) {
    const std::array<double, 4> values = {object.box_full.x, object.box_full.width,
                                          object.center_m.x(), object.visible_fraction};
    XXH3_64bits_update(state, values.data(), sizeof(values));
  }
  XXH3_64bits_update(state, &frame.exposure_ms, sizeof(frame.exposure_ms));
  const std::uint64_t hash = XXH3_64bits_digest(state);
  XXH3_freeState(state);
  return hash;
}

/// The frame alone, in a pipeline of its own.
std::uint64_t HashAlone(int threads, std::uint64_t shuffle) {
  PipelineOptions options = Everything();
  options.threads = threads;
  options.tile_shuffle = shuffle;
  return HashOf(Take(Pipeline(World(MovingHall()), SmallCamera(), options), kFrame));
}

TEST(Determinism, Probe) {
  if (!std::getenv(kProbe)) GTEST_SKIP() << "the fresh process of the next test";
  fmt::print("hash {:016x}\n", HashAlone(2, 99));
}

std::uint64_t HashInAFreshProcess() {
  const std::string self = std::filesystem::read_symlink("/proc/self/exe");
  const std::string command =
      fmt::format("{}=1 '{}' --gtest_filter=Determinism.Probe", kProbe, self);
  FILE* pipe = ::popen(command.c_str(), "r");
  std::uint64_t hash = 0;
  std::array<char, 256> line;
  while (pipe && std::fgets(line.data(), line.size(), pipe)) {
    const std::string text = line.data();
    if (text.starts_with("hash ")) hash = std::stoull(text.substr(5), nullptr, 16);
  }
  if (pipe) ::pclose(pipe);
  return hash;
}

/// A machine of few cores would cap every arena at them: the pool gets its threads all the same, so
/// that three workers race beside the caller.
constexpr std::size_t kThreads = 4;

TEST(Determinism, OneHashOverThreadsTileOrderProcessAndHistory) {
  RecordProperty("isa", kIsa);
  const tbb::global_control pool(tbb::global_control::max_allowed_parallelism, kThreads);
  const std::uint64_t reference = HashAlone(1, 0);
  fmt::print("isa {}: frame {} is {:016x}\n", kIsa, kFrame, reference);
  EXPECT_EQ(reference, HashAlone(2, 0));
  EXPECT_EQ(reference, HashAlone(4, 0));
  EXPECT_EQ(reference, HashAlone(1, 77));
  EXPECT_EQ(reference, HashAlone(4, 12345));
  const Pipeline sequence(World(MovingHall()), SmallCamera(), Everything());
  for (int frame = 0; frame < kFrame; ++frame) Take(sequence, frame);
  EXPECT_EQ(reference, HashOf(Take(sequence, kFrame)));
  EXPECT_EQ(reference, HashInAFreshProcess());
}

TEST(Determinism, TheDepthAloneIsTheFramesDepth) {
  const Pipeline hall(World(MovingHall()), SmallCamera(), Everything());
  const RenderedFrame frame = Take(hall, kFrame);
  const cv::Mat1f depth = hall.RenderDepth(frame.stamp_ns, frame.truth.T_world_rig);
  ASSERT_EQ(depth.size(), frame.truth.depth.size());
  EXPECT_EQ(std::memcmp(depth.data, frame.truth.depth.data, depth.total() * sizeof(float)), 0);
}

}  // namespace
}  // namespace aisle::sim
