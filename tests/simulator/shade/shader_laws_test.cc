#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "simulator/shade/shader.h"
#include "tests/simulator/test_world.h"

namespace aisle::sim {
namespace {

/// A hall with a figure and a truck, and one camera that sees both.
struct Stage {
  explicit Stage(WorldParts parts, const ShadeOptions& shade = Options())
      : world(std::move(parts)), tracer(world, {}), shader(world, tracer, shade) {
    camera.width = 120;
    camera.height = 90;
    camera.fx = camera.fy = 90;
    camera.cx = 59.5;
    camera.cy = 44.5;
    rays = MakePixelRays(camera);
  }

  static ShadeOptions Options() {
    ShadeOptions options{.statics = {.texel_m = 0.3f,
                                     .coarse_texel_m = 1,
                                     .volume_spacing_m = 1.5f,
                                     .directions = 16,
                                     .volume_directions = 32}};
    options.antialias = false;
    options.gloss = false;
    return options;
  }
  static WorldParts Parts() { return test::Hall({.boxes = 60, .lights = 6}); }

  CameraView At(double right_m) const {
    return {rays, test::LookAlong({3.0, 0.3 - right_m, 1.2}, -0.05)};
  }
  std::vector<cv::Mat1f> Shade(const std::vector<CameraView>& views,
                               const std::vector<float>& scale = {}) const {
    Snapshot snapshot = world.At(1'000'000'000);
    if (!scale.empty()) snapshot.light_scale = scale;
    const Instant instant = tracer.Pose(std::move(snapshot));
    std::vector<HitImage> hits;
    TraceViews(instant, views, {}, &hits);
    return shader.Shade(instant, views, hits);
  }
  cv::Mat1f Picture() const { return Shade({At(0)})[0]; }

  World world;
  Tracer tracer;
  Shader shader;
  StereoCamera camera;
  PixelRays rays;
};

TEST(Shader, LightIsNowhereNegativeNorInfinite) {
  const cv::Mat1f picture = Stage(Stage::Parts()).Picture();
  EXPECT_TRUE(cv::checkRange(picture, true, nullptr, 0, 1e6));
}

/// Radiance is linear in what the lamps send: twice the light, twice the picture, to the bit, as
/// doubling changes no float but its exponent.
TEST(Shader, TwiceTheLampsAreTwiceThePicture) {
  WorldParts bright = Stage::Parts();
  for (AreaLight& light : bright.lights) light.radiance *= 2;
  for (Material& material : bright.materials) material.emission *= 2;
  const cv::Mat1f once = Stage(Stage::Parts()).Picture();
  const cv::Mat1f twice = Stage(std::move(bright)).Picture();
  EXPECT_EQ(cv::countNonZero(twice != 2 * once), 0);
}

TEST(Shader, WithoutLampsItIsDark) {
  const Stage stage(Stage::Parts());
  const cv::Mat1f dark = stage.Shade({stage.At(0)}, std::vector<float>(6, 0.0f))[0];
  const cv::Mat1f lit = stage.Picture();
  // A lamp's own surface goes out with it.
  EXPECT_LT(cv::norm(dark, cv::NORM_INF), 1e-4 * cv::norm(lit, cv::NORM_INF));
}

/// More lamps are never less light.
TEST(Shader, ADimmedLampTakesAwayAndNeverAdds) {
  const Stage stage(Stage::Parts());
  const cv::Mat1f lit = stage.Picture();
  for (std::size_t lamp = 0; lamp < 6; ++lamp) {
    std::vector<float> scale(6, 1.0f);
    scale[lamp] = 0.25f;
    const cv::Mat1f dimmed = stage.Shade({stage.At(0)}, scale)[0];
    const double most = cv::norm(lit, cv::NORM_INF);
    // Shadows of movers weigh lamps anew, with what their sampling errs.
    cv::Mat1f gain;
    cv::subtract(dimmed, lit, gain);
    EXPECT_LT(cv::mean(cv::max(gain, 0))[0], 2e-3 * most) << lamp;
    EXPECT_LT(cv::mean(dimmed)[0], cv::mean(lit)[0]) << lamp;
  }
}

/// What lies under the floor is no place from which light is looked at.
TEST(Shader, ADeepFootingDarkensNobody) {
  WorldParts deep = Stage::Parts();
  test::MeshBuilder footing;
  footing.mesh = std::move(deep.statics.mesh);
  footing.instances = std::move(deep.statics.instances);
  footing.Box({12, -1, -9}, {14, 1, -8}, 1, 2);
  deep.statics = {std::move(footing.mesh), std::move(footing.instances)};
  EXPECT_EQ(
      cv::norm(Stage(Stage::Parts()).Picture(), Stage(std::move(deep)).Picture(), cv::NORM_INF), 0);
}

/// What shines and is no lamp's, as a sky does, lights the hall, and stays when a lamp goes out:
/// that takes as much away as without a sky.
TEST(Shader, TheSkyLightsAndStaysWhenALampGoesOut) {
  const auto hall = [](float emission) {
    WorldParts parts = test::Hall({.boxes = 60, .movers = false, .lights = 6});
    parts.materials[1].emission = emission;  // of the walls
    return Stage(std::move(parts));
  };
  const Stage dull = hall(0), open = hall(2);
  std::vector<float> scale(6, 1.0f);
  scale[1] = 0.25f;
  const cv::Mat1f lit = dull.Picture(), under_sky = open.Picture();
  const auto taken = [&](const Stage& stage, const cv::Mat1f& whole) {
    cv::Mat1f difference;
    cv::subtract(whole, stage.Shade({stage.At(0)}, scale)[0], difference);
    return difference;
  };
  EXPECT_LT(cv::norm(taken(open, under_sky), taken(dull, lit), cv::NORM_INF),
            1e-3 * cv::norm(lit, cv::NORM_INF));
  const int brighter = cv::countNonZero(under_sky > lit);
  EXPECT_GT(brighter, 0.95 * static_cast<double>(lit.total())) << "cartons and floor too";
}

TEST(Shader, TheSkyStaysWhenAllLampsGoOut) {
  const auto hall = [](float lamps) {
    WorldParts parts = test::Hall({.boxes = 60, .movers = false, .lights = 6});
    parts.materials[1].emission = 2;  // of the walls
    parts.materials[3].emission *= lamps;
    for (AreaLight& light : parts.lights) light.radiance *= lamps;
    return Stage(std::move(parts));
  };
  const Stage both = hall(1);
  const cv::Mat1f alone = hall(0).Picture();
  const double most = cv::norm(both.Picture(), cv::NORM_INF);
  for (const float dimmed : {0.0f, 0.5f}) {
    const cv::Mat1f now = both.Shade({both.At(0)}, std::vector<float>(6, dimmed))[0];
    cv::Mat1f expected;
    cv::addWeighted(alone, 1 - dimmed, both.Picture(), dimmed, 0, expected);
    EXPECT_LT(cv::norm(now, expected, cv::NORM_INF), 1e-3 * most) << dimmed;
  }
}

TEST(Shader, MoversTakeLightFromTheWorldAndNeverAdd) {
  ShadeOptions bright = Stage::Options();
  bright.mover_shadows = false;
  const cv::Mat1f shadowed = Stage(Stage::Parts()).Picture();
  const cv::Mat1f unshadowed = Stage(Stage::Parts(), bright).Picture();
  EXPECT_EQ(cv::countNonZero(shadowed > unshadowed), 0);
  EXPECT_GT(cv::countNonZero(shadowed < 0.9 * unshadowed), 20) << "there are shadows";
  // Where nobody is there are none.
  const auto empty = [] { return test::Hall({.boxes = 60, .movers = false, .lights = 6}); };
  const cv::Mat1f alone = Stage(empty()).Picture(), also = Stage(empty(), bright).Picture();
  EXPECT_EQ(cv::countNonZero(alone != also), 0);
}

/// What a camera shows is its own affair, whoever else looks.
TEST(Shader, TheFirstPictureIsTheSameAloneAndWithOthers) {
  const Stage stage(Stage::Parts());
  const cv::Mat1f alone = stage.Picture();
  const std::vector<cv::Mat1f> both = stage.Shade({stage.At(0), stage.At(0.12)});
  EXPECT_EQ(cv::countNonZero(alone != both[0]), 0);
  const cv::Mat1f again = stage.Picture();
  EXPECT_EQ(cv::countNonZero(alone != again), 0) << "what was shaded before leaves nothing behind";
}

TEST(Shader, AntialiasingChangesEdgesAlone) {
  ShadeOptions smooth = Stage::Options();
  smooth.antialias = true;
  const cv::Mat1f hard = Stage(Stage::Parts()).Picture();
  const cv::Mat1f soft = Stage(Stage::Parts(), smooth).Picture();
  int changed = 0;
  for (int y = 1; y + 1 < hard.rows; ++y) {
    for (int x = 1; x + 1 < hard.cols; ++x) {
      if (hard(y, x) == soft(y, x)) continue;
      ++changed;
      double least = 0, most = 0;
      cv::minMaxLoc(hard(cv::Rect(x - 1, y - 1, 3, 3)), &least, &most);
      EXPECT_GT(most, 1.02 * least) << "a pixel in an even place: " << x << ", " << y;
    }
  }
  EXPECT_GT(changed, 50);
  EXPECT_LT(changed, hard.rows * hard.cols / 3);
}

/// The mean of sixteen pixels in the place of one, sharp edges and all, is what a pixel of that
/// size collects.
TEST(Shader, AntialiasingComesNearTheMeanOfSixteenPixels) {
  ShadeOptions smooth = Stage::Options();
  smooth.antialias = true;
  const auto parts = [] { return test::Hall({.boxes = 2000, .lights = 6}); };
  const Stage hard_stage(parts()), soft_stage(parts(), smooth);
  StereoCamera fine = hard_stage.camera;
  fine.width *= 4, fine.height *= 4;
  fine.fx *= 4, fine.fy *= 4;
  fine.cx = 4 * (fine.cx + 0.5) - 0.5, fine.cy = 4 * (fine.cy + 0.5) - 0.5;
  const PixelRays fine_rays = MakePixelRays(fine);
  CameraView close = hard_stage.At(0);
  close.rays = &fine_rays;
  const cv::Mat1f hard = hard_stage.Picture(), soft = soft_stage.Picture();
  cv::Mat1f mean;
  cv::resize(hard_stage.Shade({close})[0], mean, hard.size(), 0, 0, cv::INTER_AREA);
  double hard_error = 0, soft_error = 0;
  for (int y = 0; y < hard.rows; ++y) {
    for (int x = 0; x < hard.cols; ++x) {
      if (hard(y, x) == soft(y, x)) continue;
      // In shares, as lamps would outweigh all else.
      const auto error = [&](float value) {
        return std::abs(value - mean(y, x)) / std::max(mean(y, x), 1e-6f);
      };
      hard_error += std::min(error(hard(y, x)), 1.0f);
      soft_error += std::min(error(soft(y, x)), 1.0f);
    }
  }
  EXPECT_GT(hard_error, 10);
  EXPECT_LT(soft_error, 0.5 * hard_error);
}

}  // namespace
}  // namespace aisle::sim
