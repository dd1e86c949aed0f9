#include "simulator/shade/pass/pixels_around.h"

#include <gtest/gtest.h>

#include "simulator/shade/pass/edge_samples.h"
#include "tests/simulator/test_world.h"

namespace aisle::sim {
namespace {

/// A hall full of cartons, seen far too coarsely for them.
class CoarseLook : public testing::Test {
 protected:
  CoarseLook()
      : world_(test::Hall({.boxes = 3000, .movers = false})),
        tracer_(world_, {}),
        instant_(tracer_.Pose(world_.At(0))),
        rays_(MakePixelRays(Coarser(StereoCamera{}, 4))) {
    std::vector<HitImage> images;
    TraceViews(instant_, std::array{View()}, {}, &images);
    image_ = images[0];
    // Each triangle has a brightness of its own.
    radiance_.create(image_.height, image_.width);
    for (int y = 0; y < image_.height; ++y) {
      for (int x = 0; x < image_.width; ++x)
        radiance_(y, x) = ShadeOf(image_.primitive[image_.Index(x, y)]);
    }
  }
  static float ShadeOf(std::uint32_t triangle) {
    return static_cast<float>(triangle * 2654435761u % 1000) / 1000;
  }
  CameraView View() const { return {rays_, test::LookAlong({1, 0.1f, 1.3f}, 0.05)}; }

  F8x3 NormalsOf(const Hits8& hits) const {
    const TriangleMesh& mesh = world_.statics().mesh;
    F8x3 normals;
    for (int k = 0; k < kLanes; ++k) {
      const auto& [a, b, c] = mesh.triangles[hits.primitive[k]];
      const Eigen::Vector3f n = (mesh.positions[b] - mesh.positions[a])
                                    .cross(mesh.positions[c] - mesh.positions[a])
                                    .normalized();
      normals.x[k] = n.x();
      normals.y[k] = n.y();
      normals.z[k] = n.z();
    }
    return normals;
  }

  World world_;
  Tracer tracer_;
  Instant instant_;
  PixelRays rays_;
  HitImage image_;
  cv::Mat1f radiance_;
};

TEST_F(CoarseLook, WhatIsSeenAroundTellsWhatSamplesMeet) {
  const CameraView view = View();
  int samples = 0, told = 0, wrong = 0, doubted_wrong = 0;
  for (int y = 0; y < image_.height; ++y) {
    for (int x = 0; x + 1 < image_.width; x += 2) {
      const std::array<PixelAt, 2> pixels = {{{x, y}, {x + 1, y}}};
      const Rays8 rays = SampleRays(view, pixels);
      const PixelsAround around(image_, radiance_, pixels);
      ASSERT_TRUE(around.all_static());
      const Hits8 met = around.Meet(instant_, rays);
      const Eigen::Vector3f right = view.rotation.col(0) * rays_.step_x;
      const Eigen::Vector3f down = view.rotation.col(1) * rays_.step_y;
      const unsigned doubted = Bits(around.BehindSomething(rays, met, NormalsOf(met), right, down));
      Hits8 traced;
      instant_.Intersect(rays, Coherence::kCoherent, kStaticOnly, &traced);
      for (int k = 0; k < kLanes; ++k) {
        ++samples;
        if (met.geometry[k] == kNoGeometry) continue;
        ASSERT_GE(met.t[k], traced.t[k] * (1 - 1e-5f)) << "nothing is before the nearest";
        const bool differs = met.primitive[k] != traced.primitive[k];
        if (doubted >> k & 1) {
          doubted_wrong += differs;
          continue;
        }
        ++told;
        wrong += differs;
      }
    }
  }
  EXPECT_GT(told, samples / 2) << "most samples need no ray";
  EXPECT_LT(wrong, told / 100) << "those are right";
  EXPECT_GT(doubted_wrong, 3 * wrong) << "who is doubted has more reason to be";
}

TEST_F(CoarseLook, ASampleHasTheLightOfTheNearestPixelThatShowsItsTriangle) {
  const CameraView view = View();
  int known = 0;
  for (int y = 1; y + 1 < image_.height; ++y) {
    for (int x = 1; x + 2 < image_.width; x += 2) {
      const std::array<PixelAt, 2> pixels = {{{x, y}, {x + 1, y}}};
      const PixelsAround around(image_, radiance_, pixels);
      Hits8 traced;
      instant_.Intersect(SampleRays(view, pixels), Coherence::kCoherent, kStaticOnly, &traced);
      const F8 light = around.RadianceOf(traced);
      for (int k = 0; k < kLanes; ++k) {
        bool seen = false;
        for (int step = 0; step < 9; ++step) {
          const PixelAt& middle = pixels[static_cast<std::size_t>(k / kSamples)];
          const std::size_t i = image_.Index(middle.x + step % 3 - 1, middle.y + step / 3 - 1);
          seen |= image_.primitive[i] == traced.primitive[k];
        }
        ASSERT_EQ(light[k], seen ? ShadeOf(traced.primitive[k]) : -1);
        known += seen;
      }
    }
  }
  EXPECT_GT(known, 10000);
}

TEST_F(CoarseLook, AtTheBorderItsOwnPixelsStandInForThoseBeyond) {
  for (const PixelAt corner : {PixelAt{0, 0}, PixelAt{image_.width - 1, image_.height - 1}}) {
    const std::array<PixelAt, 1> one = {corner};
    const PixelsAround around(image_, radiance_, one);
    const Hits8 met = around.Meet(instant_, SampleRays(View(), one));
    const F8 light = around.RadianceOf(met);
    for (int k = 0; k < kLanes; ++k) {
      if (met.geometry[k] == kNoGeometry) continue;
      EXPECT_EQ(light[k], ShadeOf(met.primitive[k]));
    }
  }
}

}  // namespace
}  // namespace aisle::sim
