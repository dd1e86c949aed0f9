#include <gtest/gtest.h>

#include "simulator/shade/shader.h"
#include "tests/simulator/test_world.h"

namespace aisle::sim {
namespace {

/// Two cameras of one instant, in a hall where a truck has just passed.
class ShadowsOfTwoCameras : public testing::Test {
 protected:
  ShadowsOfTwoCameras()
      : world_(test::Hall({.boxes = 0, .lights = 8})),
        tracer_(world_, {}),
        shader_(world_, tracer_, {.statics = {}, .antialias = false, .gloss = false}),
        instant_(tracer_.Pose(world_.At(2'000'000'000))) {
    camera_.width = 200;
    camera_.height = 150;
    camera_.fx = camera_.fy = 140;
    camera_.cx = 99.5;
    camera_.cy = 74.5;
    rays_ = MakePixelRays(camera_);
  }

  CameraView At(double right_m) const {
    return {rays_, test::LookAlong({10.2f, 0.2f - static_cast<float>(right_m), 1.2f}, 0)};
  }

  std::vector<cv::Mat1f> Shade(const std::vector<CameraView>& views) {
    TraceViews(instant_, views, {}, &hits_);
    return shader_.Shade(instant_, views, hits_);
  }

  World world_;
  Tracer tracer_;
  Shader shader_;
  Instant instant_;
  StereoCamera camera_;
  PixelRays rays_;
  std::vector<HitImage> hits_;
};

TEST_F(ShadowsOfTwoCameras, FromTheSamePlaceAreTheSame) {
  const std::vector<cv::Mat1f> pair = Shade({At(0), At(0)});
  EXPECT_EQ(cv::countNonZero(pair[0] != pair[1]), 0);
}

/// What one camera takes over from the other is what it would have found, but for the noise of
/// sampling, which the mean over the shadow's blocks holds down.
TEST_F(ShadowsOfTwoCameras, DoNotDependOnWhichWasTraced) {
  const cv::Mat1f alone = Shade({At(0.12)})[0];
  const cv::Mat1f second = Shade({At(0), At(0.12)})[1];
  ShadeOptions unshadowed{.statics = {}, .antialias = false, .gloss = false};
  unshadowed.mover_shadows = false;
  const std::vector<CameraView> views = {At(0.12)};
  TraceViews(instant_, views, {}, &hits_);
  const cv::Mat1f bright = Shader(world_, tracer_, unshadowed).Shade(instant_, views, hits_)[0];

  int in_shadow = 0;
  double sum_expected = 0, sum_got = 0;
  for (int y = 0; y + 10 <= camera_.height; y += 10) {
    for (int x = 0; x + 10 <= camera_.width; x += 10) {
      const cv::Rect block(x, y, 10, 10);
      const double expected = cv::mean(alone(block))[0], got = cv::mean(second(block))[0];
      EXPECT_NEAR(got, expected, 0.05 * expected) << x << ", " << y;
      if (expected > 0.9 * cv::mean(bright(block))[0]) continue;
      ++in_shadow;
      sum_expected += expected;
      sum_got += got;
    }
  }
  EXPECT_GT(in_shadow, 3);
  EXPECT_NEAR(sum_got, sum_expected, 0.005 * sum_expected);
}

}  // namespace
}  // namespace aisle::sim
