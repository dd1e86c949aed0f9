#include "simulator/shade/lanes/wide.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "simulator/shade/lanes/frame8.h"
#include "simulator/shade/lanes/hemisphere.h"
#include "simulator/shade/lanes/ray_packets.h"

namespace aisle::sim {
namespace {

/// Numbers of every size and sign, with the awkward ones among them.
class Numbers {
 public:
  explicit Numbers(unsigned seed) : random_(seed) {}
  float Any() {
    constexpr std::array<float, 8> kAwkward = {0.0f, -0.0f, 1, -1, 0.5f, -2.5f, 8388607.5f, 3e38f};
    const auto draw = random_() % 16;
    if (draw < kAwkward.size()) return kAwkward[draw];
    return std::ldexp(std::uniform_real_distribution<float>(-1, 1)(random_),
                      static_cast<int>(random_() % 40) - 20);
  }
  float In(float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(random_);
  }
  F8 Lanes() {
    F8 lanes;
    for (int k = 0; k < 8; ++k) lanes[k] = Any();
    return lanes;
  }
  std::uint32_t Bits() { return static_cast<std::uint32_t>(random_()); }

 private:
  std::mt19937 random_;
};

bool SameBits(float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

/// Each lane gives what the scalar operation gives, to the bit.
template <class Wide8, class Scalar>
void ExpectSame(const Wide8& wide, const Scalar& scalar, const char* what) {
  Numbers numbers(7);
  for (int i = 0; i < 2000; ++i) {
    const F8 a = numbers.Lanes(), b = numbers.Lanes();
    const F8 got = wide(a, b);
    for (int k = 0; k < 8; ++k) {
      ASSERT_TRUE(SameBits(got[k], scalar(a[k], b[k])))
          << what << " of " << a[k] << " and " << b[k] << " is " << got[k];
    }
  }
}

TEST(Lanes, ComputeWhatOneLaneComputesToTheBit) {
  ExpectSame([](F8 a, F8 b) { return a + b; }, [](float a, float b) { return a + b; }, "sum");
  ExpectSame([](F8 a, F8 b) { return a * b; }, [](float a, float b) { return a * b; }, "product");
  ExpectSame([](F8 a, F8 b) { return a / (b * b + 1); },
             [](float a, float b) { return a / (b * b + 1); }, "quotient");
  ExpectSame([](F8 a, F8 b) { return Min(a, b); }, [](float a, float b) { return a < b ? a : b; },
             "least");
  ExpectSame([](F8 a, F8 b) { return Max(a, b); }, [](float a, float b) { return a > b ? a : b; },
             "most");
  ExpectSame([](F8 a, F8) { return Sqrt(Max(a, Wide(0))); },
             [](float a, float) { return std::sqrt(a > 0 ? a : 0); }, "root");
  ExpectSame([](F8 a, F8) { return Floor(a); }, [](float a, float) { return std::floor(a); },
             "floor");
  ExpectSame([](F8 a, F8) { return Ceil(a); }, [](float a, float) { return std::ceil(a); }, "ceil");
  ExpectSame([](F8 a, F8 b) { return Select(a < b, a, b + 1); },
             [](float a, float b) { return a < b ? a : b + 1; }, "choice");
  ExpectSame([](F8 a, F8) { return ToFloat(ToInt(Min(Max(a, Wide(-1e6f)), Wide(1e6f)))); },
             [](float a, float) {
               const float held = std::min(std::max(a, -1e6f), 1e6f);
               return static_cast<float>(static_cast<int>(held));
             },
             "whole number");
}

TEST(Lanes, AbsNeverGivesASign) {
  Numbers numbers(3);
  for (int i = 0; i < 500; ++i) {
    const F8 a = numbers.Lanes(), magnitude = Abs(a);
    for (int k = 0; k < 8; ++k) EXPECT_EQ(magnitude[k], std::abs(a[k]));
  }
}

TEST(Lanes, MasksAndTheirBitsAreTheSameThing) {
  for (unsigned bits = 0; bits < 256; ++bits) {
    const I8 mask = LanesOf(bits);
    EXPECT_EQ(Bits(mask), bits);
    EXPECT_EQ(Any(mask), bits != 0);
    for (int k = 0; k < 8; ++k) EXPECT_EQ(mask[k], bits >> k & 1u ? -1 : 0);
  }
}

TEST(Lanes, GathersReadWhatIndicesRead) {
  Numbers numbers(5);
  std::vector<float> table(100);
  std::vector<std::int32_t> whole(100);
  std::vector<std::uint8_t> bytes(103);
  for (std::size_t i = 0; i < 100; ++i) {
    table[i] = numbers.Any();
    whole[i] = static_cast<std::int32_t>(numbers.Bits());
  }
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(numbers.Bits());
  for (int round = 0; round < 200; ++round) {
    I8 index;
    for (int k = 0; k < 8; ++k) index[k] = static_cast<int>(numbers.Bits() % 100);
    const F8 floats = Gather(table.data(), index);
    const I8 ints = GatherInt(whole.data(), index), words = GatherBytes(bytes.data(), index);
    float sum = 0;
    for (int k = 0; k < 8; ++k) {
      const auto i = static_cast<std::size_t>(index[k]);
      EXPECT_TRUE(SameBits(floats[k], table[i]));
      EXPECT_EQ(ints[k], whole[i]);
      for (std::size_t byte = 0; byte < 4; ++byte) {
        EXPECT_EQ(static_cast<std::uint32_t>(words[k]) >> 8 * byte & 255u, bytes[i + byte]);
      }
      sum += floats[k];
    }
    EXPECT_TRUE(SameBits(Sum(floats), sum)) << "lane by lane from the first on";
  }
}

/// Moving bits is no arithmetic: those of small integers are denormal numbers.
TEST(Lanes, WideMovesEveryPatternOfBits) {
  Numbers numbers(11);
  const unsigned before = _mm_getcsr();
  _mm_setcsr(before | 0x8040);  // flush denormal results, take denormal inputs for zero
  for (int i = 0; i < 1000; ++i) {
    const std::uint32_t bits = numbers.Bits() >> (i % 32);
    const I8 got = reinterpret_cast<I8>(Wide(std::bit_cast<float>(bits)));
    for (int k = 0; k < 8; ++k) EXPECT_EQ(static_cast<std::uint32_t>(got[k]), bits);
  }
  _mm_setcsr(before);
}

TEST(FastLog2, IsWithinAHundredthOfTheLogarithm) {
  Numbers numbers(13);
  for (int i = 0; i < 20'000; ++i) {
    const float x = std::exp2(numbers.In(-60, 60));
    EXPECT_NEAR(FastLog2(Wide(x))[i % 8], std::log2(x), 0.0101f) << x;
  }
}

Eigen::Vector3f UnitVector(Numbers* numbers) {
  while (true) {
    const Eigen::Vector3f v(numbers->In(-1, 1), numbers->In(-1, 1), numbers->In(-1, 1));
    if (v.norm() > 0.1f && v.norm() < 1) return v.normalized();
  }
}

TEST(Frames, AreRightHandedUnitAxesAroundTheNormalInOneLaneAndInEight) {
  Numbers numbers(17);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3f n = i == 0   ? Eigen::Vector3f(0, 0, 1)
                              : i == 1 ? Eigen::Vector3f(0, 0, -1)
                                       : UnitVector(&numbers);
    const Eigen::Matrix3f basis = BasisAround(n);
    EXPECT_TRUE((basis.transpose() * basis).isIdentity(1e-5f)) << n.transpose();
    EXPECT_NEAR(basis.determinant(), 1, 1e-5);
    EXPECT_EQ(basis.col(2), n);
    const Frame8 frame({Wide(n.x()), Wide(n.y()), Wide(n.z())});
    const Eigen::Vector3f d = UnitVector(&numbers);
    const F8x3 world = frame.ToWorld({Wide(d.x()), Wide(d.y()), Wide(d.z())});
    const F8x3 back = frame.ToLocal(world);
    const int k = i % 8;
    EXPECT_LT((Eigen::Vector3f(world.x[k], world.y[k], world.z[k]) - basis * d).norm(), 1e-5f);
    EXPECT_LT((Eigen::Vector3f(back.x[k], back.y[k], back.z[k]) - d).norm(), 1e-5f);
  }
}

TEST(Rays, AreMadeOfTheirLanes) {
  Numbers numbers(19);
  const F8x3 from = {numbers.Lanes(), numbers.Lanes(), numbers.Lanes()};
  const F8x3 to = {numbers.Lanes(), numbers.Lanes(), numbers.Lanes()};
  const F8 far = numbers.Lanes();
  const Rays8 rays = MakeRays(from, to, far, LanesOf(0b10110001));
  Rays8 single{};
  for (int k = 0; k < 8; ++k) {
    SetRay({from.x[k], from.y[k], from.z[k]}, {to.x[k], to.y[k], to.z[k]}, far[k], k, &single);
    EXPECT_EQ(rays.valid[k], 0b10110001 >> k & 1 ? -1 : 0);
    EXPECT_TRUE(SameBits(rays.ox[k], single.ox[k]) && SameBits(rays.oy[k], single.oy[k]) &&
                SameBits(rays.oz[k], single.oz[k]) && SameBits(rays.dx[k], single.dx[k]) &&
                SameBits(rays.dy[k], single.dy[k]) && SameBits(rays.dz[k], single.dz[k]) &&
                SameBits(rays.t_far[k], single.t_far[k]) && rays.t_near[k] == single.t_near[k]);
  }
}

}  // namespace
}  // namespace aisle::sim
