#include <algorithm>
#include <cmath>
#include <functional>

#include "simulator/world/fittings.h"

namespace aisle::sim {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;
using Rectangle = Eigen::AlignedBox2f;

const Vector3f kX = Vector3f::UnitX(), kY = Vector3f::UnitY(), kZ = Vector3f::UnitZ();

float Between(Dice* dice, double low, double high) {
  return static_cast<float>(dice->Between(low, high));
}

/// Drawers one over another, with a grip and a label each.
void AddDrawers(const Maker& make, const Vector3f& low, const Vector3f& size, int count) {
  const float tall = size.z() / static_cast<float>(count);
  const float x = low.x() + size.x();
  make.Block(low + size / 2, size, make.f.enamel, 0.008f);
  for (int i = 0; i < count; ++i) {
    const float z = low.z() + tall * (static_cast<float>(i) + 0.5f), y = low.y() + size.y() / 2;
    make.Block({x + 0.006f, y, z}, {0.014f, size.y() - 0.03f, tall - 0.012f}, make.f.enamel, 0.005f,
               0.7f);
    make.Block({x + 0.02f, y, z + tall * 0.28f}, {0.02f, size.y() * 0.72f, 0.014f}, make.f.chrome,
               0.004f);
    make.Block({x + 0.014f, y - size.y() * 0.2f, z}, {0.003f, 0.08f, 0.025f}, make.f.white, 0.001f);
  }
}

/// A spanner, a hammer or a screwdriver in the plane across `x`, hanging from `at` down.
void AddHandTool(const Maker& make, const Vector3f& at, float length, int kind) {
  const Vector3f foot = at - Vector3f(0, 0, length);
  if (kind == 0) {  // ring and open spanner
    make.Block((at + foot) / 2, {0.007f, 0.018f, length - 0.03f}, make.f.chrome, 0.003f);
    make.Ring(at - Vector3f(0, 0, 0.01f), kX, 0.015f, 0.007f, make.f.chrome, 14);
    for (const float side : {-0.014f, 0.014f}) {
      make.Block(foot + Vector3f(0, side, 0), {0.008f, 0.012f, 0.035f}, make.f.chrome, 0.003f);
    }
  } else if (kind == 1) {  // hammer
    make.Pipe({at, foot}, 0.014f, make.p.wood, 10);
    make.Turn(at + Vector3f(0, -0.055f, 0), kY,
              {{0, 0},
               {0.014f, 0.002f},
               {0.02f, 0.012f},
               {0.02f, 0.04f},
               {0.014f, 0.06f},
               {0.012f, 0.1f},
               {0, 0.11f}},
              make.f.dark, 12);
  } else {  // screwdriver
    make.Turn(at, -kZ, {{0, 0}, {0.013f, 0.004f}, {0.016f, 0.03f}, {0.013f, 0.08f}, {0.007f, 0.1f}},
              make.f.brass, 12);
    make.Pipe({at - Vector3f(0, 0, 0.09f), foot}, 0.004f, make.f.chrome, 8);
  }
}

/// A thing that may lie about: how far it reaches from its middle, and how it is drawn there.
struct Oddment {
  Vector2f reach;
  std::function<void(const Vector3f& at)> draw;
};

Oddment SomeBox(const Maker& make, Dice* dice) {
  const float tall = Between(dice, 0.05, 0.16), wide = Between(dice, 0.1, 0.28);
  const Vector3f box(Between(dice, 0.08, 0.2), wide, tall);
  const std::uint16_t material = dice->Chance(0.5) ? make.f.card : make.p.tote;
  return {box.head<2>() / 2, [=, &make](const Vector3f& at) {
            make.Block(at + Vector3f(0, 0, box.z() / 2), box, material, 0.006f, 0.3f);
          }};
}

Oddment SomeTin(const Maker& make, Dice* dice) {
  constexpr float kRim_m = 0.043f;
  const float tall = Between(dice, 0.09, 0.2);
  const std::uint16_t material = dice->Chance(0.5) ? make.f.dark : make.f.white;
  return {{kRim_m, kRim_m}, [=, &make](const Vector3f& at) {
            make.Turn(at, kZ,
                      {{0, 0},
                       {0.04f, 0},
                       {kRim_m, 0.006f},
                       {0.041f, 0.012f},
                       {0.041f, tall - 0.01f},
                       {kRim_m, tall},
                       {0.034f, tall},
                       {0.03f, tall - 0.012f},
                       {0, tall - 0.012f}},
                      material, 18);
          }};
}

Oddment SomeBar(const Maker& make, Dice* dice) {
  constexpr float kRadius_m = 0.011f;
  const float length = Between(dice, 0.14, 0.3), turn = Between(dice, 0, 3.1);
  const Vector3f half = length / 2 * Vector3f(std::cos(turn), std::sin(turn), 0);
  return {half.head<2>().cwiseAbs() + Vector2f::Constant(kRadius_m),
          [=, &make](const Vector3f& at) {
            const Vector3f middle = at + Vector3f(0, 0, 0.012f);
            make.Pipe({middle - half, middle + half}, kRadius_m, make.f.chrome, 10);
          }};
}

/// A sheet crumpled by waves.
Oddment SomeRag(const Maker& make, Dice* dice) {
  const float phase = Between(dice, 0, 6);
  const std::uint16_t material = dice->Chance(0.5) ? make.f.white : make.f.dust;
  return {{0.15f, 0.15f}, [=, &make](const Vector3f& at) {
            std::vector<Vector3f> points;
            for (int k = 0; k < 49; ++k) {
              const float u = static_cast<float>(k % 7) / 6 - 0.5f,
                          v = static_cast<float>(k / 7) / 6 - 0.5f;
              const float up = 0.016f + 0.013f * std::sin(9 * u + phase) * std::cos(8 * v - phase) +
                               0.02f * std::max(0.0f, 0.5f - std::hypot(u, v));
              points.push_back(make.pose() * (at + Vector3f(0.26f * u + 0.04f * v, 0.3f * v, up)));
            }
            AddSheet(make.mesh(), points, 7, material);
          }};
}

Oddment SomeOddment(const Maker& make, Dice* dice) {
  const double kind = dice->Unit();
  if (kind < 0.3) return SomeBox(make, dice);
  if (kind < 0.5) return SomeTin(make, dice);
  return kind < 0.75 ? SomeBar(make, dice) : SomeRag(make, dice);
}

/// What lies on a worktop at height `z`: boxes, tins, rags, parts, each within it and beside the
/// others and what is `taken`; what finds no place is left out.
void AddOddments(const Maker& make, const Rectangle& top, float z, std::vector<Rectangle> taken,
                 Dice* dice) {
  constexpr int kTries = 12;
  const int count = 5 + dice->Pick(5);
  for (int i = 0; i < count; ++i) {
    const Oddment thing = SomeOddment(make, dice);
    const Vector2f low = top.min() + thing.reach, high = top.max() - thing.reach;
    if ((high - low).minCoeff() < 0) continue;
    for (int k = 0; k < kTries; ++k) {
      const float y = Between(dice, low.y(), high.y()), x = Between(dice, low.x(), high.x());
      const Rectangle place(Vector2f(x, y) - thing.reach, Vector2f(x, y) + thing.reach);
      if (std::ranges::any_of(taken, [&](const Rectangle& r) { return r.intersects(place); })) {
        continue;
      }
      taken.push_back(place);
      thing.draw({x, y, z});
      break;
    }
  }
}

void AddVice(const Maker& make, const Vector3f& at) {
  make.Block(at + Vector3f(-0.06f, 0, 0.03f), {0.2f, 0.16f, 0.06f}, make.f.dark, 0.015f);
  make.Block(at + Vector3f(-0.08f, 0, 0.11f), {0.1f, 0.14f, 0.12f}, make.f.dark, 0.02f);
  make.Block(at + Vector3f(0.06f, 0, 0.11f), {0.07f, 0.14f, 0.12f}, make.f.dark, 0.02f);
  for (const float x : {-0.025f, 0.02f}) {
    make.Block(at + Vector3f(x, 0, 0.155f), {0.014f, 0.15f, 0.035f}, make.f.chrome, 0.003f);
  }
  make.Pipe({at + Vector3f(0.05f, 0, 0.09f), at + Vector3f(0.2f, 0, 0.09f)}, 0.016f, make.f.chrome);
  make.Pipe({at + Vector3f(0.19f, -0.02f, -0.02f), at + Vector3f(0.19f, 0.01f, 0.2f)}, 0.008f,
            make.f.chrome, 8);
}

}  // namespace

void AddBench(const Maker& make, const Vector3f& size, Dice dice) {
  const float half = size.y() / 2, top = size.z();
  make.Block({0, 0, top - 0.025f}, {size.x(), size.y(), 0.05f}, make.p.wood, 0.012f, 1.1f);
  for (const float y : {-half + 0.08f, half - 0.08f}) {
    for (const float x : {-size.x() / 2 + 0.06f, size.x() / 2 - 0.08f}) {
      make.Block({x, y, (top - 0.05f) / 2}, {0.06f, 0.06f, top - 0.05f}, make.p.upright, 0.006f);
      make.Disc({x, y, 0}, kZ, 0.05f, 0.014f, make.f.dark, 14);
    }
    make.Block({-0.02f, y, 0.16f}, {size.x() - 0.16f, 0.04f, 0.05f}, make.p.upright, 0.006f);
  }
  make.Block({-0.05f, 0, 0.2f}, {size.x() - 0.2f, size.y() - 0.24f, 0.03f}, make.p.steel, 0.006f);
  const bool left = dice.Chance(0.5);
  const float side = left ? 1 : -1;  // where the drawers are, the vice at the other end
  AddDrawers(make, {-0.3f, left ? half - 0.62f : -half + 0.12f, 0.24f}, {0.6f, 0.5f, top - 0.3f},
             4);
  const Vector3f vice(size.x() / 2 - 0.12f, -side * (half - 0.3f), top);
  AddVice(make, vice);
  const Rectangle of_vice(vice.head<2>() - Vector2f(0.17f, 0.09f),
                          vice.head<2>() + Vector2f(0.21f, 0.09f));
  const Vector2f within = size.head<2>() / 2 - Vector2f(0.02f, 0.02f);
  AddOddments(make, {-within, within}, top, {of_vice}, &dice);
  // Below, on what the drawers leave of the shelf.
  constexpr float kToteHalf_m = 0.2f, kTotePitch_m = 0.38f;
  float y = std::min(0.05f, half - 0.64f - kToteHalf_m);
  for (int i = 0; i < 3 && y - kToteHalf_m > -half + 0.08f; ++i, y -= kTotePitch_m) {
    const float tall = Between(&dice, 0.15, 0.3);
    const Vector3f box(0.3f, Between(&dice, 0.25, 2 * kToteHalf_m), tall);
    make.Block({-0.1f, side * y, 0.215f + tall / 2}, box, make.p.tote, 0.01f, 0.6f);
  }
}

void AddToolWall(const Maker& make, const Vector3f& size, Dice dice) {
  const float half = size.y() / 2, low = 0.95f, tall = size.z() - low;
  for (const float y : {-half + 0.05f, half - 0.05f}) {
    make.Block({0, y, size.z() / 2}, {0.05f, 0.05f, size.z()}, make.p.steel, 0.006f);
    make.Block({0, y, 0.02f}, {size.x(), 0.07f, 0.04f}, make.p.steel, 0.008f);
  }
  make.Block({0.03f, 0, low + tall / 2}, {0.02f, size.y(), tall}, make.f.peg, 0.005f, 0.608f);
  const float face = 0.05f;
  float y = half - 0.12f;
  for (int i = 0; y > -half + 0.1f; ++i, y -= 0.052f) {  // a set of spanners, falling in size
    AddHandTool(make, {face, y, size.z() - 0.08f}, 0.34f - 0.008f * static_cast<float>(i % 26), 0);
  }
  for (y = half - 0.15f; y > -half + 0.1f; y -= Between(&dice, 0.09, 0.2)) {
    if (dice.Chance(0.12)) continue;
    const int kind = dice.Chance(0.35) ? 1 : 2;
    AddHandTool(make, {face, y, size.z() - 0.52f}, Between(&dice, 0.22, 0.34), kind);
  }
  make.Block({0.1f, 0, low + 0.1f}, {0.15f, size.y() - 0.2f, 0.012f}, make.p.steel, 0.004f);
  for (y = half - 0.25f; y > -half + 0.2f; y -= 0.19f) {  // bins below
    if (dice.Chance(0.2)) continue;
    make.Block({0.1f, y, low + 0.16f}, {0.15f, 0.15f, 0.11f}, make.p.tote, 0.015f, 0.5f);
  }
  make.Ring({face + 0.03f, -half + 0.28f, low + 0.34f}, kX, 0.14f, 0.013f, make.f.rubber, 28);
  make.Ring({face + 0.05f, -half + 0.29f, low + 0.33f}, kX, 0.13f, 0.013f, make.f.rubber, 28);
}

void AddToolCart(const Maker& make, const Vector3f& size, Dice dice) {
  const float half = size.y() / 2;
  AddDrawers(make, {-size.x() / 2, -half, 0.16f}, {size.x() - 0.02f, size.y(), size.z() - 0.22f},
             6);
  make.Block({0, 0, size.z() - 0.03f}, {size.x(), size.y(), 0.05f}, make.f.rubber, 0.015f);
  for (const float x : {-0.18f, 0.18f}) {
    for (const float y : {-half + 0.08f, half - 0.08f}) {
      make.Disc({x, y - 0.02f, 0.06f}, kY, 0.06f, 0.04f, make.f.rubber);
      make.Block({x, y, 0.135f}, {0.07f, 0.06f, 0.05f}, make.f.chrome, 0.006f);
    }
  }
  make.Pipe({{-0.15f, half, size.z() - 0.12f},
             {-0.15f, half + 0.07f, size.z() - 0.1f},
             {0.15f, half + 0.07f, size.z() - 0.1f},
             {0.15f, half, size.z() - 0.12f}},
            0.014f, make.f.chrome);
  const Vector2f within = size.head<2>() / 2 - Vector2f(0.02f, 0.02f);
  AddOddments(make, {-within, within}, size.z() - 0.005f, {}, &dice);
}

void AddLocker(const Maker& make, const Vector3f& size, Dice dice) {
  const int doors = std::max(1, static_cast<int>(std::round(size.y() / 0.4f)));
  const float wide = size.y() / static_cast<float>(doors);
  make.Block({-0.01f, 0, size.z() / 2 + 0.04f}, {size.x(), size.y(), size.z() - 0.08f},
             make.f.enamel, 0.01f, 1.4f);
  make.Block({0, 0, 0.05f}, {size.x() - 0.06f, size.y() - 0.04f, 0.1f}, make.f.dark, 0.005f);
  for (int i = 0; i < doors; ++i) {
    const float y = (static_cast<float>(i) + 0.5f) * wide - size.y() / 2, x = size.x() / 2;
    make.Block({x, y, size.z() / 2 + 0.04f}, {0.02f, wide - 0.012f, size.z() - 0.14f},
               make.f.enamel, 0.006f, 0.9f);
    for (int k = 0; k < 5; ++k) {
      make.Block({x + 0.01f, y, size.z() - 0.3f + 0.03f * static_cast<float>(k)},
                 {0.006f, wide * 0.5f, 0.01f}, make.f.dark, 0.002f);
    }
    make.Block({x + 0.02f, y - wide * 0.36f, size.z() * 0.52f}, {0.02f, 0.025f, 0.1f},
               make.f.chrome, 0.006f);
  }
  if (dice.Chance(0.8)) {
    make.Block({0, Between(&dice, -0.2, 0.2), size.z() + 0.13f}, {0.36f, 0.5f, 0.26f}, make.f.card,
               0.006f, 0.5f);
  }
}

void AddGasBottles(const Maker& make, const Vector3f& size, Dice dice) {
  const int count = std::max(2, static_cast<int>(size.y() / 0.28f));
  for (int i = 0; i < count; ++i) {
    const float y = (static_cast<float>(i) - 0.5f * static_cast<float>(count - 1)) * 0.27f;
    make.Turn({0, y, 0}, kZ,
              {{0, 0},
               {0.1f, 0},
               {0.115f, 0.015f},
               {0.115f, 1.16f},
               {0.105f, 1.24f},
               {0.075f, 1.31f},
               {0.04f, 1.35f},
               {0.03f, 1.38f},
               {0.03f, 1.41f},
               {0.048f, 1.42f},
               {0.048f, 1.5f},
               {0.03f, 1.53f},
               {0, 1.53f}},
              i % 2 == 0 ? make.f.enamel : make.f.dark, 24);
    make.Block({0.113f, y, Between(&dice, 0.8, 1)}, {0.008f, 0.1f, 0.14f}, make.f.white, 0.003f);
  }
  const float half = size.y() / 2;
  make.Block({-0.16f, 0, 0.75f}, {0.04f, size.y(), 0.08f}, make.p.steel, 0.006f);
  make.Block({-0.16f, 0, 0.3f}, {0.04f, size.y(), 0.08f}, make.p.steel, 0.006f);
  for (const float y : {-half + 0.03f, half - 0.03f}) {
    make.Block({-0.16f, y, 0.55f}, {0.05f, 0.05f, 1.1f}, make.p.steel, 0.006f);
  }
  std::vector<Vector3f> chain = Hanging({-0.14f, -half, 0.8f}, {-0.14f, half, 0.8f}, 0.05f);
  for (std::size_t k = 1; k + 1 < chain.size(); ++k) {
    chain[k].x() = 0.13f;
  }
  make.Pipe(chain, 0.007f, make.f.chrome, 6);
}

}  // namespace aisle::sim
