#include "harness/bench/shown.h"

#include <gtest/gtest.h>

#include "harness/bench/accuracy.h"
#include "harness/bench/dynamic.h"
#include "harness/bench/sensitivity.h"
#include "harness/bench/stages.h"
#include "harness/io/input_error.h"

namespace aisle {
namespace {

/// Eight small frames of somebody who walks past.
BenchView Walker() {
  return {.text = "smoke/bits",
          .path = AISLE_SOURCE_DIR "/scenes/smoke/bits.yaml",
          .scene = "smoke/bits",
          .assets_dir = AISLE_SOURCE_DIR "/assets"};
}

SystemSpec OnWheels() {
  SystemSpec system = BuiltIn("plain");
  system.options[kOdometryOption] = "true";
  return system;
}

DynamicOfView Rejected(const SystemSpec& system) {
  DynamicBenchOptions options;
  options.system = system;
  return MeasureDynamic(Walker(), options);
}

TEST(ToldSystemsTest, WhoIsToldWhatMovesMissesNothingOfIt) {
  for (const char* name : {"oracle", "semantic"}) {
    const DynamicOfView seen = Rejected(BuiltIn(name));
    EXPECT_GT(seen.masks.true_positives, 0) << name;
    EXPECT_EQ(seen.masks.false_negatives, 0) << name;
    EXPECT_EQ(seen.masks.objects_missed, 0) << name;
  }
}

TEST(ToldSystemsTest, TruthItselfHasTheBestFigures) {
  SensitivityOptions options;
  options.system = BuiltIn("oracle");
  options.prefix = "feature.features";
  const Sensitivity sensitivity = MeasureSensitivity({Walker()}, options);
  EXPECT_EQ(sensitivity.base.object_f1, 1);
  EXPECT_EQ(sensitivity.base.pixel_iou, 1);
  EXPECT_EQ(sensitivity.base.static_loss, 0);
}

/// Features of a system's last frame that lie on what moves.
int FeaturesOnMovers(const std::string& system) {
  const auto sequence = OpenSource(Walker(), {});
  const cv::Mat1b moves = sequence->At(sequence->Schedule().back()).truth->dynamic;
  int count = 0;
  StageBenchOptions options;
  options.source.twin = "live";
  options.system = BuiltIn(system);
  MeasureStages(Walker(), options, {}, [&](const BenchLap& lap) {
    EXPECT_FALSE(lap.last.keypoints.empty());
    for (const cv::Point2f& at : lap.last.keypoints) count += moves(cv::Point(at)) > 0 ? 1 : 0;
  });
  return count;
}

TEST(ToldSystemsTest, TimesAreOfTheSystemThatIsTold) {
  EXPECT_GT(FeaturesOnMovers("plain"), 0);
  EXPECT_EQ(FeaturesOnMovers("oracle"), 0);
}

TEST(ToldSystemsTest, WhereNobodyKnowsWhatMovesTheyAreRefused) {
  SequenceFrame recorded;
  recorded.images.left = cv::Mat1b(4, 4, static_cast<unsigned char>(0));
  for (const bool posed : {false, true}) {
    if (posed) recorded.truth.emplace();  // as of a recording with a trajectory alone
    for (const char* name : {"oracle", "semantic"}) {
      EXPECT_THROW(MasksFor(BuiltIn(name), Walker(), {})(recorded), InputError) << name;
    }
    EXPECT_TRUE(MasksFor(BuiltIn("robust"), Walker(), {})(recorded).left.empty());
  }
}

TEST(ToldSystemsTest, TheirMasksErrAsAsked) {
  SystemSpec blind = BuiltIn("oracle");
  blind.mask_errors.miss_share = 1;
  EXPECT_EQ(Rejected(blind).masks.true_positives, 0);
}

/// Frames of which each was measured to follow the one before.
class Measured : public Sequence {
 public:
  std::string name() const override { return "measured"; }
  StereoCalibration calibration() const override { return {}; }
  double rate_hz() const override { return 10; }
  std::vector<FrameRequest> Schedule() const override {
    std::vector<FrameRequest> frames(5);
    for (int i = 0; i < 5; ++i) frames[static_cast<std::size_t>(i)].id = i;
    return frames;
  }
  SequenceFrame At(const FrameRequest& request) const override {
    SequenceFrame frame;
    frame.images.id = request.id;
    frame.images.motion.emplace();
    return frame;
  }
};

TEST(ExcerptTest, HasTheFramesThatThereAreAndNoMotionBeforeTheFirst) {
  const Measured whole;
  const Excerpt middle(whole, 2, 4);
  ASSERT_EQ(middle.Schedule().size(), 2u);
  EXPECT_EQ(middle.Schedule().front().id, 2);
  EXPECT_FALSE(middle.At(middle.Schedule()[0]).images.motion);
  EXPECT_TRUE(middle.At(middle.Schedule()[1]).images.motion);
  EXPECT_EQ(Excerpt(whole, 3, 100).Schedule().size(), 2u);
  EXPECT_TRUE(Excerpt(whole, 7, 9).Schedule().empty());
}

TEST(WheelsTest, AreMeasuredForWhomAsksForThem) {
  for (const auto& [system, asks] : {std::pair(BuiltIn("plain"), false), {OnWheels(), true}}) {
    const auto sequence = OpenSourceFor(system, Walker(), {});
    EXPECT_EQ(sequence->At(sequence->Schedule()[1]).images.motion.has_value(), asks);
  }
}

TEST(WheelsTest, SensitivityLooksAtTheOptionsOfASystemThatHasThem) {
  SensitivityOptions options;
  options.system = OnWheels();
  options.prefix = "feature.features";
  EXPECT_EQ(MeasureSensitivity({Walker()}, options).options.size(), 1u);
}

TEST(LapsTest, OfASingleFrameAreRefused) {
  BenchView one = Walker();
  one.to = 1;
  StageBenchOptions options;
  options.laps = 2;
  EXPECT_THROW(MeasureStages(one, options), InputError);
  options.laps = 1;
  EXPECT_EQ(MeasureStages(one, options).at("frame").ms.size(), 1u);
}

}  // namespace
}  // namespace aisle
