#include "simulator/pipeline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <numbers>

#include "simulator/proof/truth_proof.h"
#include "tests/simulator/test_world.h"

namespace aisle::sim {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

PipelineOptions QuickOptions() {
  PipelineOptions options;
  options.shade.statics = {.texel_m = 0.15f, .coarse_texel_m = 1.0f, .directions = 32};
  options.sensor.exposure = 5.0f;
  return options;
}

Pipeline SmallHall(const PipelineOptions& options) {
  return Pipeline(World(test::Hall({.boxes = 200})), {}, options);
}

bool SameBytes(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() &&
         std::memcmp(a.data, b.data, a.total() * a.elemSize()) == 0;
}

void ExpectSame(const RenderedFrame& a, const RenderedFrame& b) {
  EXPECT_TRUE(SameBytes(a.left, b.left));
  EXPECT_TRUE(SameBytes(a.right, b.right));
  EXPECT_TRUE(SameBytes(a.truth.depth, b.truth.depth));
  EXPECT_TRUE(SameBytes(a.truth.instance, b.truth.instance));
  EXPECT_TRUE(SameBytes(a.truth.dynamic, b.truth.dynamic));
  EXPECT_TRUE(SameBytes(a.truth.dynamic_right, b.truth.dynamic_right));
  EXPECT_TRUE(SameBytes(a.truth.depth_right, b.truth.depth_right));
  EXPECT_TRUE(SameBytes(a.truth.instance_right, b.truth.instance_right));
}

const Eigen::Isometry3d kPose = test::LookAlong({1.5, 0, 1.2}, 0.02);

TEST(Pipeline, BytesDoNotDependOnThreadsOrTileOrder) {
  PipelineOptions options = QuickOptions();
  options.threads = 1;
  const RenderedFrame reference = SmallHall(options).Render(7, 2 * kSecond, kPose);
  for (const int threads : {2, 4}) {
    options.threads = threads;
    options.tile_shuffle = static_cast<std::uint64_t>(threads) * 77;
    ExpectSame(reference, SmallHall(options).Render(7, 2 * kSecond, kPose));
  }
}

TEST(Pipeline, AFrameAloneIsTheFrameInSequence) {
  const Pipeline alone = SmallHall(QuickOptions());
  const RenderedFrame reference = alone.Render(3, 3 * kSecond, kPose);
  const Pipeline sequence = SmallHall(QuickOptions());
  for (int i = 0; i < 3; ++i) sequence.Render(i, i * kSecond, kPose);
  ExpectSame(reference, sequence.Render(3, 3 * kSecond, kPose));
}

TEST(Pipeline, ShadingAndSensorOptionsNeverChangeTruth) {
  const RenderedFrame reference = SmallHall(QuickOptions()).Render(0, kSecond, kPose);
  PipelineOptions options = QuickOptions();
  options.shade.antialias = options.shade.mover_shadows = options.sensor.noise = false;
  const RenderedFrame other = SmallHall(options).Render(0, kSecond, kPose);
  EXPECT_FALSE(SameBytes(reference.left, other.left));
  EXPECT_TRUE(SameBytes(reference.truth.depth, other.truth.depth));
  EXPECT_TRUE(SameBytes(reference.truth.instance, other.truth.instance));
  EXPECT_TRUE(SameBytes(reference.truth.dynamic, other.truth.dynamic));
}

VerifyReport Prove(const Pipeline& pipeline, const Moment& now, const Moment& next) {
  return ProveTruth(pipeline.StudioAt(now), now, next);
}

TEST(Pipeline, TruthProvesItselfByRasteriserAndWarps) {
  const VerifyReport report =
      Prove(SmallHall(QuickOptions()), {2 * kSecond, kPose},
            {2 * kSecond + kSecond / 20, test::LookAlong({1.55, 0, 1.2}, 0.03)});
  EXPECT_EQ(report.failure(), "");
  EXPECT_GT(report.raster_compared, 300'000);
  EXPECT_GT(report.stereo_compared, 200'000);
  EXPECT_GT(report.flow_compared, 200'000);
}

/// As where the rig turns away from all that it sees between two frames.
TEST(Pipeline, FlowThatMeetsNothingProvesNothing) {
  const Pipeline hall = SmallHall(QuickOptions());
  const Moment now{2 * kSecond, kPose};
  const VerifyReport stands = Prove(hall, now, {2 * kSecond + kSecond / 20, kPose});
  EXPECT_EQ(stands.failure(), "");
  EXPECT_GT(stands.flow_compared, 200'000);
  const VerifyReport turned = Prove(hall, now, {3 * kSecond, test::LookAlong({1.5, 0, 1.2}, 3)});
  EXPECT_EQ(turned.flow_compared, 0);
  EXPECT_THAT(turned.failure(), testing::HasSubstr("flow could be held against the next frame on"));
}

/// The small hall with a rig that drives at 4 m/s and a camera with 20 ms of exposure.
WorldParts FastHall() {
  WorldParts parts = test::Hall({.boxes = 200});
  parts.rig = [](std::int64_t stamp_ns) {
    const double t = 1e-9 * static_cast<double>(stamp_ns);
    return test::LookAlong({1.5 + 4 * (t - 2), 0, 1.2}, 0.02 + 1.5 * (t - 2));
  };
  return parts;
}

/// A rig that nods by two degrees fifty times a second: after 20 ms it is where it was.
WorldParts NoddingHall() {
  WorldParts parts = test::Hall({.boxes = 200});
  parts.rig = [](std::int64_t stamp_ns) -> Eigen::Isometry3d {
    const double nod = std::numbers::pi / 90 *
                       std::sin(100 * std::numbers::pi * 1e-9 * static_cast<double>(stamp_ns));
    return kPose * Eigen::AngleAxisd(nod, Eigen::Vector3d::UnitX());
  };
  return parts;
}

PipelineOptions NoiselessOptions() {
  PipelineOptions options = QuickOptions();
  options.sensor.noise = options.sensor.fixed_pattern = false;
  options.exposure_ms = 20;
  return options;
}

double MeanDifference(const cv::Mat1b& a, const cv::Mat1b& b) {
  return cv::norm(a, b, cv::NORM_L1) / static_cast<double>(a.total());
}

TEST(Shutter, BlurIsTheMeanOfManyInstants) {
  PipelineOptions options = NoiselessOptions();
  options.sensor.lens.blur_px = 0;
  options.shutter.motion_blur = true;
  const Pipeline blurred(World(FastHall()), {}, options);
  const Eigen::Isometry3d pose = blurred.world().PlannedRigPose(2 * kSecond);
  const cv::Mat1b picture = blurred.Render(0, 2 * kSecond, pose).left;
  // The reference: 24 instants that know nothing of plans and weights.
  cv::Mat1f sum(picture.size(), 0.0f);
  constexpr int kInstants = 24;
  for (int i = 0; i < kInstants; ++i) {
    const std::int64_t at = 2 * kSecond + (2 * i + 1 - kInstants) * (10'000'000 / kInstants);
    sum += blurred.RenderRadiance(at, blurred.world().PlannedRigPose(at))[0];
  }
  const PixelResponse plain{VignettingMap(picture.cols, picture.rows, MakePixelRays({}).x,
                                          MakePixelRays({}).y, options.sensor.vignetting),
                            {}};
  const cv::Mat1b reference = Expose(cv::Mat1f(sum / kInstants), plain, options.sensor, {});
  options.shutter.motion_blur = false;
  const cv::Mat1b sharp =
      Pipeline(World(FastHall()), {}, options).Render(0, 2 * kSecond, pose).left;
  EXPECT_LT(MeanDifference(picture, reference), 0.15 * MeanDifference(sharp, reference));
}

TEST(Shutter, OpenItChangesNoTruth) {
  PipelineOptions options = NoiselessOptions();
  const Pipeline closed(World(FastHall()), {}, options);
  options.shutter = {.motion_blur = true, .readout_ms = 10};
  const Pipeline open(World(FastHall()), {}, options);
  const Eigen::Isometry3d pose = open.world().PlannedRigPose(2 * kSecond);
  const RenderedFrame a = closed.Render(0, 2 * kSecond, pose),
                      b = open.Render(0, 2 * kSecond, pose);
  EXPECT_FALSE(SameBytes(a.left, b.left));
  EXPECT_TRUE(SameBytes(a.truth.depth, b.truth.depth));
  EXPECT_TRUE(SameBytes(a.truth.depth_right, b.truth.depth_right));
  EXPECT_TRUE(SameBytes(a.truth.dynamic, b.truth.dynamic));
}

/// Each row is nearer to the picture of its own time than to that of the stamp.
void ExpectRowsOfTheirTimes(const WorldParts& hall) {
  PipelineOptions options = NoiselessOptions();
  const Pipeline still(World(hall), {}, options);
  options.shutter.readout_ms = 20;
  const Pipeline rolling(World(hall), {}, options);
  const Eigen::Isometry3d pose = rolling.world().PlannedRigPose(2 * kSecond);
  const cv::Mat1b picture = rolling.Render(0, 2 * kSecond, pose).left;
  for (const int row : {20, 130, 240, 350, 460}) {
    const std::int64_t at = 2 * kSecond + std::llround(20e6 * ((row + 0.5) / picture.rows - 0.5));
    const cv::Mat1b then = still.Render(0, at, still.world().PlannedRigPose(at)).left;
    const cv::Mat1b now = still.Render(0, 2 * kSecond, pose).left;
    const double own = MeanDifference(picture.row(row), then.row(row));
    if (row != 240) {
      EXPECT_LT(own, 0.4 * MeanDifference(picture.row(row), now.row(row))) << row;
    }
    EXPECT_LT(own, 2) << row;
  }
}

TEST(Shutter, ARollingShuttersRowsAreThePicturesOfTheirTimes) {
  ExpectRowsOfTheirTimes(FastHall());
}

TEST(Shutter, AlsoWhereTheRigIsBackBeforeTheLastRowCloses) {
  ExpectRowsOfTheirTimes(NoddingHall());
}

TEST(Shutter, AnExposureGathersLightUntilItIsSwitchedOff) {
  WorldParts parts = test::Hall({.boxes = 200, .movers = false});
  parts.at = [at = parts.at, lights = parts.lights.size()](std::int64_t stamp_ns) {
    Snapshot snapshot = at ? at(stamp_ns) : Snapshot{};
    snapshot.stamp_ns = stamp_ns;
    snapshot.light_scale.assign(lights, stamp_ns < 2 * kSecond ? 1.0F : 0.0F);
    return snapshot;
  };
  PipelineOptions options = NoiselessOptions();
  options.shutter.motion_blur = true;
  const Pipeline hall(World(parts), {}, options);
  const auto grey = [&](std::int64_t stamp_ns) {
    return cv::mean(hall.Render(0, stamp_ns, kPose).left)[0];
  };
  const double lit = grey(kSecond), half = grey(2 * kSecond), dark = grey(3 * kSecond);
  EXPECT_LT(dark, 0.2 * lit);
  EXPECT_GT(half, dark + 0.3 * (lit - dark));
  EXPECT_LT(half, lit - 0.1 * (lit - dark));
}

TEST(Shutter, AtRestItCostsAndChangesNothing) {
  PipelineOptions options = NoiselessOptions();
  WorldParts parts = test::Hall({.boxes = 200, .movers = false});
  const RenderedFrame closed = Pipeline(World(parts), {}, options).Render(0, 0, kPose);
  options.shutter = {.motion_blur = true, .readout_ms = 10};
  const RenderedFrame open = Pipeline(World(parts), {}, options).Render(0, 0, kPose);
  EXPECT_TRUE(SameBytes(closed.left, open.left));
}

TEST(AutoExposure, TheFramesMeanIsTheTargetWhateverTheLight) {
  for (const float exposure : {0.5f, 20.0f}) {
    PipelineOptions options = QuickOptions();
    options.sensor.exposure = exposure;
    options.auto_exposure = {.on = true, .target_grey = 110, .longest_ms = 200};
    const RenderedFrame frame = SmallHall(options).Render(0, 2 * kSecond, kPose);
    EXPECT_NEAR(cv::mean(frame.left)[0], 110, 5);
  }
}

/// What judges a picture by its radiance has to know how that was exposed.
TEST(AutoExposure, TheStudioHasTheExposureOfTheFrame) {
  PipelineOptions options = QuickOptions();
  options.auto_exposure.on = true;
  const Pipeline hall = SmallHall(options);
  const RenderedFrame frame = hall.Render(0, 2 * kSecond, kPose);
  const double chosen = frame.exposure_ms * frame.gain;
  const float expected = static_cast<float>(options.sensor.exposure * chosen /
                                            (options.exposure_ms * options.sensor.gain));
  EXPECT_NE(expected, options.sensor.exposure);
  EXPECT_FLOAT_EQ(hall.StudioAt({2 * kSecond, kPose}).exposure, expected);
}

TEST(Lens, TruthProvesItselfThroughIt) {
  StereoCamera camera;
  camera.lens = {LensModel::kRadialTangential, {-0.28, 0.074, 0.0002, 0.00002}};
  const VerifyReport report = Prove(
      Pipeline(World(test::Hall({.boxes = 200})), camera, QuickOptions()), {2 * kSecond, kPose},
      {2 * kSecond + kSecond / 20, test::LookAlong({1.55, 0, 1.2}, 0.03)});
  EXPECT_EQ(report.failure(), "");
  EXPECT_GT(report.raster_compared, 200'000);
}

}  // namespace
}  // namespace aisle::sim
