#include <cmath>

#include "simulator/world/fittings.h"

namespace aisle::sim {
namespace {

using Eigen::Vector3f;

const Vector3f kX = Vector3f::UnitX(), kY = Vector3f::UnitY(), kZ = Vector3f::UnitZ();

/// Threaded rods from a thing at `z` to the roof.
void AddHangers(const Maker& make, float length, float out, float z, float roof, float pitch) {
  for (float y = -length / 2 + 0.4f; y < length / 2; y += pitch) {
    for (const float x : {-out, out})
      make.Pipe({{x, y, z}, {x, y, roof}}, 0.007f, make.f.chrome, 6);
  }
}

}  // namespace

void AddDuct(const Maker& make, const Vector3f& size, float roof, Dice dice) {
  const float radius = size.x() / 2, z = size.z() + radius, half = size.y() / 2;
  std::vector<Turned> outline = {{0, 0}};
  const int pieces = std::max(2, static_cast<int>(size.y() / 1.5f));
  for (int i = 0; i <= pieces; ++i) {  // spiral duct in pieces, a swaged joint between them
    const float at = size.y() * static_cast<float>(i) / static_cast<float>(pieces);
    for (const auto& [shift, more] :
         {std::pair{-0.03f, 0.0f}, {-0.025f, 0.012f}, {0.025f, 0.012f}, {0.03f, 0.0f}}) {
      const float along = std::clamp(at + shift, 0.0f, size.y());
      if (along > outline.back().along) outline.push_back({radius + more, along});
    }
  }
  outline.push_back({0, size.y() + 0.001f});
  outline.front() = {radius, 0};
  make.Turn({0, -half, z}, kY, outline, make.p.steel, 24);
  make.Disc({0, -half - 0.02f, z}, kY, radius + 0.01f, 0.03f, make.p.steel, 24);
  for (float y = -half + 1.2f; y < half; y += 3) {  // grilles that blow down
    const float side = dice.Chance(0.5) ? 1.0f : -1.0f;
    make.Block({side * radius * 0.72f, y, z - radius * 0.72f}, {0.12f, 0.6f, 0.12f}, make.f.fins,
               0.02f);
  }
  for (float y = -half + 0.6f; y < half; y += 2.5f) {
    make.Ring({0, y, z}, kY, radius + 0.012f, 0.008f, make.f.chrome, 24);
    make.Pipe({{0, y, z + radius}, {0, y, roof}}, 0.008f, make.f.chrome, 6);
  }
}

void AddCableTray(const Maker& make, const Vector3f& size, float roof, Dice dice) {
  const float half = size.x() / 2, z = size.z();
  for (const float x : {-half, half}) {
    make.Block({x, 0, z + 0.03f}, {0.012f, size.y(), 0.06f}, make.p.steel, 0.003f, 0.7f);
  }
  for (float y = -size.y() / 2 + 0.1f; y < size.y() / 2; y += 0.3f) {
    make.Block({0, y, z + 0.01f}, {size.x(), 0.03f, 0.015f}, make.p.steel, 0.003f);
  }
  const int cables = 5 + dice.Pick(4);
  for (int i = 0; i < cables; ++i) {
    std::vector<Vector3f> way;
    const auto lane = static_cast<float>(dice.Between(-0.85, 0.85)) * half;
    const auto thick = static_cast<float>(dice.Between(0.006, 0.016));
    for (float y = -size.y() / 2; y <= size.y() / 2 + 0.01f; y += size.y() / 12) {
      const float up = z + 0.022f + thick + 0.006f * static_cast<float>(dice.Unit());
      way.emplace_back(std::clamp(lane + 0.02f * static_cast<float>(dice.Signed()), -half, half), y,
                       up);
    }
    make.Pipe(Smooth(way, 3), thick, dice.Chance(0.7) ? make.f.dark : make.f.white, 7);
  }
  AddHangers(make, size.y(), half + 0.01f, z, roof, 2.4f);
  for (float y = -size.y() / 2 + 1.5f; y < size.y() / 2; y += 4) {  // a loop that leaves it
    make.Pipe(Smooth({{half, y, z + 0.04f},
                      {half + 0.06f, y + 0.05f, z - 0.05f},
                      {half + 0.1f, y + 0.3f, z - 0.22f},
                      {half + 0.08f, y + 0.7f, z - 0.05f},
                      {half, y + 0.8f, z + 0.04f}},
                     5),
              0.009f, make.f.dark, 7);
  }
}

void AddCableDrop(const Maker& make, const Vector3f& size, float roof, Dice dice) {
  const auto sway = static_cast<float>(dice.Signed()) * 0.06f;
  std::vector<Vector3f> way;
  for (int i = 0; i <= 24; ++i) {  // straight from above, coiled below
    const float t = static_cast<float>(i) / 24;
    way.emplace_back(sway * t, 0.03f * std::sin(6 * t), roof + (size.z() + 1.2f - roof) * t);
  }
  for (int i = 0; i < 90; ++i) {
    const float t = static_cast<float>(i) / 90, angle = 55 * t;
    way.emplace_back(sway + 0.045f * std::cos(angle), 0.045f * std::sin(angle),
                     size.z() + 1.2f - 1.0f * t);
  }
  make.Pipe(way, 0.009f, make.f.dark, 6);
  make.Block({sway, 0, size.z() + 0.1f}, {0.13f, 0.13f, 0.2f}, make.f.dark, 0.02f);
  for (int i = 0; i < 4; ++i) {
    const float angle = 1.571f * static_cast<float>(i);
    const Vector3f out(std::cos(angle), std::sin(angle), 0);
    make.Disc(Vector3f(sway, 0, size.z() + 0.09f) + 0.06f * out, out, 0.028f, 0.02f, make.f.white,
              14);
  }
}

void AddCrane(const Maker& make, const Vector3f& size, float roof, Dice dice) {
  // Two box girders on end carriages, a crab with its drum, a rope to the hook block.
  const float half = size.y() / 2, z = size.z(), hung = 0.6f * std::max(1.0f, roof - z);
  for (const float x : {-0.34f, 0.34f}) {
    make.Block({x, 0, z}, {0.16f, size.y(), 0.42f}, make.f.brass, 0.012f, 1.5f);
    make.Block({x, 0, z + 0.23f}, {0.06f, size.y() - 0.4f, 0.05f}, make.f.chrome, 0.006f);
  }
  for (const float y : {-half + 0.1f, half - 0.1f}) {
    make.Block({0, y, z - 0.08f}, {2.2f, 0.22f, 0.26f}, make.f.brass, 0.02f);
    for (const float x : {-0.9f, 0.9f}) {
      make.Disc({x, y - 0.06f, z - 0.18f}, kY, 0.13f, 0.12f, make.f.dark);
    }
    make.Block({0, y, z - 0.36f}, {8, 0.06f, 0.1f}, make.f.chrome, 0.01f);  // rail on its runway
    AddSection(make.mesh(), make.pose() * Vector3f(-4, y, z - 0.62f),
               make.pose() * Vector3f(4, y, z - 0.62f), kZ, 0.24f, 0.42f, 0.02f, make.p.steel);
    for (const float x : {-3.6f, 3.6f}) {  // which hangs from the roof
      AddSection(make.mesh(), make.pose() * Vector3f(x, y, z - 0.42f),
                 make.pose() * Vector3f(x, y, roof), make.pose().linear() * kX, 0.16f, 0.18f,
                 0.012f, make.p.steel);
    }
  }
  const float crab = static_cast<float>(dice.Between(-0.25, 0.25)) * size.y();
  make.Block({0, crab, z + 0.36f}, {0.95f, 0.8f, 0.14f}, make.f.dark, 0.02f);
  make.Pipe({{-0.3f, crab, z + 0.52f}, {0.3f, crab, z + 0.52f}}, 0.14f, make.p.steel, 18);
  make.Block({0, crab + 0.38f, z + 0.55f}, {0.3f, 0.34f, 0.3f}, make.f.enamel, 0.05f);
  const float hook = z - 0.7f - hung;
  for (const float y : {-0.07f, 0.07f}) {
    make.Pipe({{0, crab + y, z + 0.4f}, {0, crab + 0.6f * y, hook + 0.3f}}, 0.008f, make.f.dark, 6);
  }
  make.Block({0, crab, hook + 0.18f}, {0.14f, 0.26f, 0.34f}, make.p.stripes, 0.04f, 0.4f);
  make.Pipe(Smooth({{0, crab, hook},
                    {0, crab, hook - 0.1f},
                    {0, crab - 0.09f, hook - 0.2f},
                    {0, crab - 0.01f, hook - 0.3f},
                    {0, crab + 0.1f, hook - 0.22f},
                    {0, crab + 0.09f, hook - 0.14f}},
                   5),
            0.03f, make.f.dark, 10);
  // Festoon: the cable that follows the crab.
  for (float y = -half + 0.4f; y + 0.9f < half; y += 0.9f) {
    std::vector<Vector3f> loop =
        Hanging({0.5f, y, z + 0.12f}, {0.5f, y + 0.9f, z + 0.12f}, 0.35f, 10);
    make.Pipe(loop, 0.014f, make.f.dark, 6);
  }
  const float pendant = half - 1.2f;  // its buttons are left at the side, out of everybody's way
  make.Pipe({{0.5f, pendant, z}, {0.52f, pendant + 0.05f, 1.5f}}, 0.012f, make.f.dark, 6);
  make.Block({0.52f, pendant + 0.05f, 1.32f}, {0.07f, 0.09f, 0.34f}, make.f.brass, 0.02f);
}

void AddLeveller(const Maker& make, const Vector3f& size, Dice dice) {
  const float half = size.y() / 2, front = size.x() / 2;
  const Vector3f plate(size.x() - 0.1f, size.y() - 0.08f, 0.016f);
  AddBox(make.mesh(), make.At({0, 0, 0.012f}), plate,
         BoxPaint::Tiled(make.f.checker, plate, 0.5f, {static_cast<float>(dice.Unit()), 0.3f}));
  make.Block({-front + 0.16f, 0, 0.026f}, {0.32f, size.y() - 0.12f, 0.02f}, make.f.checker, 0.006f,
             0.5f);
  for (const float y : {-half, half}) {
    make.Block({0, y, 0.008f}, {size.x(), 0.09f, 0.016f}, make.p.stripes, 0.004f, 0.5f);
    // Guides for lorries' wheels do not stand inside; a bent rail keeps trucks on the plate.
    make.Pipe(Smooth({{front, y * 1.12f, 0.0f},
                      {front, y * 1.12f, 0.16f},
                      {front - 0.15f, y * 1.12f, 0.2f},
                      {-front + 0.3f, y * 1.12f, 0.2f},
                      {-front + 0.15f, y * 1.12f, 0.16f},
                      {-front + 0.15f, y * 1.12f, 0}},
                     4),
              0.04f, make.p.stripes, 12);
  }
  for (float y = -half + 0.3f; y < half; y += 0.35f) {
    make.Pipe({{-front + 0.34f, y, 0.022f}, {-front + 0.34f, y + 0.2f, 0.022f}}, 0.018f,
              make.f.chrome, 10);
  }
}

void AddGuideRail(const Maker& make, const Vector3f& size, Dice) {
  const float half = size.y() / 2, tall = size.z();
  make.Block({0, 0, tall / 2}, {0.014f, size.y(), tall}, make.f.chrome, 0.004f);
  make.Block({-0.035f, 0, 0.005f}, {0.07f, size.y(), 0.01f}, make.p.steel, 0.003f);
  for (float y = -half + 0.3f; y < half; y += 0.6f) {
    make.Disc({-0.04f, y, 0.008f}, kZ, 0.014f, 0.012f, make.f.dark, 8);
  }
}

}  // namespace aisle::sim
