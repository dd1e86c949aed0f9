#include <gtest/gtest.h>

#include <random>
#include <set>

#include "simulator/shade/pass/pattern_filter.h"

namespace aisle::sim {
namespace {

TEST(PatternIndex, EveryBlockOfFourByFourHasEachSampleOnce) {
  for (int y0 = 0; y0 < 8; ++y0) {
    for (int x0 = 0; x0 < 8; ++x0) {
      std::set<int> seen;
      for (int k = 0; k < 16; ++k) seen.insert(PatternIndex(x0 + k % 4, y0 + k / 4));
      EXPECT_EQ(seen.size(), 16u) << x0 << ", " << y0;
      EXPECT_EQ(*seen.begin(), 0);
      EXPECT_EQ(*seen.rbegin(), 15);
    }
  }
}

struct Picture {
  HitImage image;
  std::vector<SurfaceRecord> statics;
  std::vector<float> raw;
};

constexpr int kWidth = 53, kHeight = 17;  // no multiple of a packet

/// Three planes of several triangles, a mover in front, and nothing in a corner.
Picture Seen(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0, 1);
  Picture p;
  p.image.Resize(kWidth, kHeight);
  p.statics.resize(9);
  for (std::size_t i = 0; i < 9; ++i) {
    const Eigen::Vector3f normal = Eigen::Vector3f(i < 3, i >= 3 && i < 6, i >= 6) +
                                   Eigen::Vector3f::Constant(0.1f * unit(random));
    Eigen::Map<Eigen::Vector3f>(p.statics[i].normal) = normal.normalized();
  }
  p.raw.assign(p.image.t.size(), 0);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const std::size_t i = p.image.Index(x, y);
      p.raw[i] = 2 * unit(random) - 0.3f;
      if (x + y < 4) continue;  // it shows the void
      const bool mover = (x - 30) * (x - 30) + (y - 8) * (y - 8) < 20;
      p.image.geometry[i] = mover ? 1 : 0;
      p.image.primitive[i] = static_cast<std::uint32_t>(3 * (x / 18) + (x / 5 + y / 3) % 3);
      p.image.t[i] =
          (mover ? 2.0f : 4.0f + static_cast<float>(x / 26)) * (1 + 0.04f * unit(random));
    }
  }
  return p;
}

/// The definition, pixel by pixel: weights 1 inside and 1/2 at the ends of five by five, of pixels
/// of the same surface.
float BruteMean(const Picture& p, int x, int y) {
  const std::size_t i = p.image.Index(x, y);
  double sum = 0, weights = 0;
  for (int dy = -2; dy <= 2; ++dy) {
    for (int dx = -2; dx <= 2; ++dx) {
      if (x + dx < 0 || x + dx >= kWidth || y + dy < 0 || y + dy >= kHeight) continue;
      const std::size_t j = p.image.Index(x + dx, y + dy);
      if (p.image.geometry[j] != p.image.geometry[i]) continue;
      if (std::abs(p.image.t[j] - p.image.t[i]) > 0.05f * p.image.t[i]) continue;
      const Eigen::Map<const Eigen::Vector3f> n(p.statics[p.image.primitive[i]].normal);
      const Eigen::Map<const Eigen::Vector3f> m(p.statics[p.image.primitive[j]].normal);
      if (p.image.geometry[i] == 0 && p.image.primitive[i] != p.image.primitive[j] &&
          n.dot(m) <= 0.9f) {
        continue;
      }
      const double w = (std::abs(dx) == 2 ? 0.5 : 1) * (std::abs(dy) == 2 ? 0.5 : 1);
      sum += w * p.raw[j];
      weights += w;
    }
  }
  return static_cast<float>(std::max(0.0, sum / weights));
}

TEST(PatternFilter, IsTheMeanOfTheSameSurfaceInEveryPacketAndAtEveryBorder) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const Picture p = Seen(seed);
    std::vector<float> means(p.image.t.size(), -7.0f);
    const PatternFilter filter(p.image, p.statics, p.raw);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; x += kLanes) {
        const I8 wanted = LoadI(&p.image.geometry[p.image.Index(x, y)]) != -1;
        filter.Packet(x, y, wanted, &means);
      }
    }
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const std::size_t i = p.image.Index(x, y);
        if (p.image.geometry[i] == kNoGeometry) {
          EXPECT_EQ(means[i], -7) << "what is not wanted is left alone";
        } else {
          EXPECT_NEAR(means[i], BruteMean(p, x, y), 1e-5) << seed << ": " << x << ", " << y;
        }
      }
    }
  }
}

/// Packets around which every sample is 1 may be left out: their means are exactly 1.
TEST(PatternFilter, WithOnesAroundGivesOnes) {
  Picture p = Seen(3);
  std::ranges::fill(p.raw, 1.0f);
  p.raw[p.image.Index(kWidth / 2, kHeight / 2)] = 0.5f;
  const PatternFilter filter(p.image, p.statics, p.raw);
  int left_out = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; x += kLanes) {
      std::vector<float> means(p.image.t.size(), 1.0f);
      filter.Packet(x, y, LoadI(&p.image.geometry[p.image.Index(x, y)]) != -1, &means);
      const bool ones = std::ranges::count(means, 1.0f) == std::ssize(means);
      if (filter.OnesAround(x, y)) {
        EXPECT_TRUE(ones) << x << ", " << y;
      }
      left_out += filter.OnesAround(x, y);
    }
  }
  EXPECT_GT(left_out, 0);
}

/// Over the pattern's sixteen samples each counts the same: a value that depends on the sample
/// alone becomes the mean of all, wherever the pixel lies in its block.
TEST(PatternFilter, OnOnePlaneEverySampleCountsTheSame) {
  Picture p = Seen(1);
  std::array<float, 16> samples;
  float sum = 0;
  for (std::size_t k = 0; k < 16; ++k) sum += samples[k] = static_cast<float>(k * k % 11);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const std::size_t i = p.image.Index(x, y);
      p.image.geometry[i] = 0;
      p.image.primitive[i] = 0;
      p.image.t[i] = 3;
      p.raw[i] = samples[static_cast<std::size_t>(PatternIndex(x, y))];
    }
  }
  std::vector<float> means(p.image.t.size());
  const PatternFilter filter(p.image, p.statics, p.raw);
  for (int y = 2; y < kHeight - 2; ++y) {
    for (int x = 0; x < kWidth; x += kLanes) filter.Packet(x, y, WideInt(-1), &means);
    for (int x = 2; x < kWidth - 2; ++x) {
      EXPECT_NEAR(means[p.image.Index(x, y)], sum / 16, 1e-4f) << x << ", " << y;
    }
  }
}

}  // namespace
}  // namespace aisle::sim
