#include "simulator/shade/surface/gloss.h"

#include <gtest/gtest.h>

#include <numbers>
#include <opencv2/imgproc.hpp>

#include "simulator/shade/reference/path_random.h"
#include "simulator/shade/reference/reference.h"
#include "simulator/shade/shader.h"
#include "tests/simulator/test_world.h"

namespace aisle::sim {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

Triple<float> Direction(float cosine, float phi) {
  const float sine = std::sqrt(1 - cosine * cosine);
  return {sine * std::cos(phi), sine * std::sin(phi), cosine};
}

/// The lobe's reflected light and density, integrated over the hemisphere on a grid.
LobeValue Integral(const Finish& finish, const Triple<float>& out) {
  constexpr int kSteps = 1500;
  double reflected = 0, density = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const float cosine = (static_cast<float>(i) + 0.5f) / kSteps;
      const float phi = 2 * kPi * (static_cast<float>(j) + 0.5f) / kSteps;
      const LobeValue value = EvaluateLobe(finish, out, Direction(cosine, phi));
      reflected += value.reflected;
      density += value.density;
    }
  }
  const double cell = 2 * std::numbers::pi / (static_cast<double>(kSteps) * kSteps);
  return {static_cast<float>(reflected * cell), static_cast<float>(density * cell)};
}

TEST(Gloss, SamplesHaveTheDensityThatIsStated) {
  for (const float roughness : {0.2f, 0.4f}) {
    const Finish finish{0.05f, roughness};
    const Triple<float> out = Direction(0.5f, 0.3f);
    const LobeValue expected = Integral(finish, out);
    constexpr int kCount = 65536;
    double sum = 0;
    int above = 0;
    for (int i = 0; i < kCount; ++i) {
      PathRandom random(1, 0, static_cast<std::uint64_t>(i));
      const float radius = std::sqrt(random.Next()), phi = 2 * kPi * random.Next();
      const Triple<float> facet =
          SampleFacet(out, roughness * roughness, radius, std::cos(phi), std::sin(phi));
      const float twice = 2 * Dot(out, facet);
      const LobeValue value = EvaluateLobe(
          finish, out, {twice * facet.x - out.x, twice * facet.y - out.y, twice * facet.z - out.z});
      if (value.density <= 0) continue;
      sum += value.reflected / value.density;
      ++above;
    }
    EXPECT_NEAR(sum / kCount, expected.reflected, 0.01 * expected.reflected) << roughness;
    EXPECT_NEAR(above / static_cast<double>(kCount), expected.density, 0.01) << roughness;
  }
}

TEST(Gloss, TheLobeIsReciprocal) {
  const Finish finish{0.04f, 0.3f};
  const Triple<float> a = Direction(0.8f, 0.1f), b = Direction(0.35f, 2.8f);
  EXPECT_NEAR(EvaluateLobe(finish, a, b).reflected / b.z,
              EvaluateLobe(finish, b, a).reflected / a.z, 1e-5);
}

TEST(Gloss, NoMoreLightLeavesThanArrives) {
  for (const float roughness : {0.12f, 0.25f, 0.4f}) {
    for (const float cosine : {0.15f, 0.3f, 0.6f, 0.95f}) {
      const Finish finish{0.05f, roughness};
      const float base = 1 - GlossShare(finish.f0, finish.roughness, cosine);
      // GlossShare is a fit: at grazing angles it is a little short.
      EXPECT_LE(base + Integral(finish, Direction(cosine, 0)).reflected, 1.05f)
          << "roughness " << roughness << ", cosine " << cosine;
    }
  }
}

TEST(Gloss, EightLanesAndOneAgree) {
  for (const float cosine : {0.05f, 0.5f, 1.0f}) {
    const Triple<float> out = Direction(cosine, 0.7f);
    const Triple<float> one = SampleFacet(out, 0.1f, 0.6f, std::cos(2.0f), std::sin(2.0f));
    const Triple<F8> eight =
        SampleFacet(Triple<F8>{Wide(out.x), Wide(out.y), Wide(out.z)}, Wide(0.1f), Wide(0.6f),
                    Wide(std::cos(2.0f)), Wide(std::sin(2.0f)));
    EXPECT_EQ(eight.x[3], one.x);
    EXPECT_EQ(eight.y[3], one.y);
    EXPECT_EQ(eight.z[3], one.z);
  }
}

TEST(PathRandom, NumbersOfAPixelSpreadEvenlyAndEachIsUniform) {
  constexpr int kSamples = 64;
  for (int dimension = 0; dimension < 20; ++dimension) {
    double total = 0;
    for (std::uint64_t pixel = 0; pixel < 200; ++pixel) {
      for (std::uint64_t sample = 0; sample < kSamples; ++sample) {
        PathRandom random(3, pixel, sample);
        for (int skip = 0; skip < dimension; ++skip) random.Next();
        const float value = random.Next();
        ASSERT_GE(value, 0.0f);
        ASSERT_LT(value, 1.0f);
        total += value;
      }
    }
    EXPECT_NEAR(total / (200 * kSamples), 0.5, dimension < 16 ? 0.002 : 0.01) << dimension;
  }
}

class GlossyHall : public testing::Test {
 protected:
  GlossyHall() {
    camera.width = 188;
    camera.height = 120;
    camera.fx = camera.fy = 108.8;
    camera.cx = 91.4;
    camera.cy = 62.7;
  }
  cv::Mat1f Nightly(const World& world, bool gloss) const {
    const Tracer tracer(world, {});
    const PixelRays rays = MakePixelRays(camera);
    const std::array views = {CameraView(rays, pose)};
    const Instant instant = tracer.Pose(world.At(2'000'000'000));
    std::vector<HitImage> hits;
    TraceViews(instant, views, {}, &hits);
    const Shader shader(world, tracer, {.statics = {.directions = 128}, .gloss = gloss});
    return shader.Shade(instant, views, hits)[0];
  }
  cv::Mat1f Traced(const World& world, int samples) const {
    const Tracer tracer(world, {});
    const TexturePool textures(world.textures());
    const PixelRays rays = MakePixelRays(camera);
    return Reference(world, textures)
        .Render(tracer.Pose(world.At(2'000'000'000)), CameraView(rays, pose), {.samples = samples});
  }
  static WorldParts Polished(WorldParts parts) {
    parts.materials[0].specular_f0 = 0.06f;
    parts.materials[0].roughness = 0.2f;
    return parts;
  }

  StereoCamera camera;
  Eigen::Isometry3d pose = test::LookAlong({2, 0, 1.4}, 0.05);
};

TEST_F(GlossyHall, DullWorldsAreLeftAloneToTheBit) {
  const World world(test::Hall({.boxes = 60, .lights = 8}));
  EXPECT_EQ(cv::norm(Nightly(world, true), Nightly(world, false), cv::NORM_INF), 0);
}

TEST_F(GlossyHall, NightlyMirrorsWhatTheReferenceMirrors) {
  const World world(Polished(test::Hall({.boxes = 60, .lights = 8})));
  const cv::Mat1f reference = Traced(world, 64);
  const auto median_error = [&](const cv::Mat1f& nightly) {
    // Of the floor before the camera, in means over 4 × 4 pixels.
    const cv::Rect floor(20, 80, 148, 40);
    cv::Mat1f ours, theirs;
    cv::resize(nightly(floor), ours, {}, 0.25, 0.25, cv::INTER_AREA);
    cv::resize(reference(floor), theirs, {}, 0.25, 0.25, cv::INTER_AREA);
    std::vector<float> errors;
    for (int y = 0; y < theirs.rows; ++y) {
      for (int x = 0; x < theirs.cols; ++x) {
        errors.push_back(std::abs(ours(y, x) / theirs(y, x) - 1));
      }
    }
    std::ranges::sort(errors);
    return errors[errors.size() / 2];
  };
  const float with = median_error(Nightly(world, true));
  EXPECT_LE(with, 0.05f);
  EXPECT_LT(with, median_error(Nightly(world, false)));
}

/// A hall with a mirror at its end, and a camera that sees the truck behind it in that alone.
class MirrorHall : public testing::Test {
 protected:
  static constexpr std::int64_t kStamp = 0;  // the truck ends at x = 17

  MirrorHall() : world_(Mirrored()), tracer_(world_, {}) {
    camera_.width = camera_.height = 96;
    camera_.fx = camera_.fy = 300;
    camera_.cx = camera_.cy = 47.5;
    rays_ = MakePixelRays(camera_);
  }
  static WorldParts Mirrored() {
    WorldParts parts = test::Hall({.boxes = 60, .lights = 8});
    parts.materials.push_back(
        {.name = "mirror", .albedo = 0.05f, .specular_f0 = 0.9f, .roughness = 0.04f});
    test::MeshBuilder statics;
    statics.mesh = std::move(parts.statics.mesh);
    statics.instances = std::move(parts.statics.instances);
    statics.Quad({29.9f, -3, 0}, {0, 0, 5}, {0, 6, 0}, 5, 2);
    parts.statics = {std::move(statics.mesh), std::move(statics.instances)};
    return parts;
  }
  static ShadeOptions Options() { return {.statics = {.directions = 128}}; }
  CameraView View() const { return {rays_, test::LookAlong({18, 0.4, 1.1}, 0)}; }
  cv::Mat1f Shade(const Shader& shader, std::int64_t stamp_ns) const {
    const Instant instant = tracer_.Pose(world_.At(stamp_ns));
    const std::array views = {View()};
    std::vector<HitImage> hits;
    TraceViews(instant, views, {}, &hits);
    for (const std::uint32_t geometry : hits[0].geometry) {
      EXPECT_TRUE(geometry == 0 || geometry == kNoGeometry) << geometry << " shows by itself";
    }
    return shader.Shade(instant, views, hits)[0];
  }

  World world_;
  Tracer tracer_;
  StereoCamera camera_;
  PixelRays rays_;
};

TEST_F(MirrorHall, WhatOnlyAMirrorShowsIsLitAsThePathsLightIt) {
  const Shader shader(world_, tracer_, Options());
  const cv::Mat1f picture = Shade(shader, kStamp);
  const TexturePool textures(world_.textures());
  const cv::Mat1f paths =
      Reference(world_, textures).Render(tracer_.Pose(world_.At(kStamp)), View(), {.samples = 256});
  // The truck's front, 25 m off on the mirrored way, 1 × 1.8 m.
  const cv::Rect front(43, 39, 10, 18);
  const double ours = cv::mean(picture(front))[0], theirs = cv::mean(paths(front))[0];
  ASSERT_GT(theirs, 0.01);
  EXPECT_NEAR(ours / theirs, 1, 0.1);
}

TEST_F(MirrorHall, APictureDoesNotKnowWhatWasPicturedBefore) {
  const Shader used(world_, tracer_, Options()), fresh(world_, tracer_, Options());
  Shade(used, kStamp + 2'000'000'000);
  EXPECT_EQ(cv::norm(Shade(used, kStamp), Shade(fresh, kStamp), cv::NORM_INF), 0);
}

}  // namespace
}  // namespace aisle::sim
