#include <cmath>

#include "simulator/world/fittings.h"

namespace aisle::sim {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

/// One strip: bowed across, swung a little, its foot bent where loads have caught it.
void AddStrip(const Maker& make, float y, float x, float top, Dice* dice) {
  constexpr float kWide_m = 0.2f;
  constexpr int kRows = 9;
  constexpr std::size_t kAcross = 5;
  const auto swing = static_cast<float>(0.02 * dice->Signed());
  const auto turn = static_cast<float>(0.16 * dice->Signed());
  const auto curl = static_cast<float>(0.05 * dice->Signed());
  const auto foot = static_cast<float>(dice->Between(0.02, 0.07));
  std::vector<Vector3f> points;
  for (int row = 0; row < kRows; ++row) {
    const float down = static_cast<float>(row) / (kRows - 1);
    for (std::size_t k = 0; k < kAcross; ++k) {
      const float side = static_cast<float>(k) / (kAcross - 1) - 0.5f;
      const float bow = 0.012f * (1 - 4 * side * side);
      const float out = x + bow + side * kWide_m * turn * down + swing * down * down +
                        curl * std::pow(std::max(0.0f, down - 0.7f) / 0.3f, 2.0f);
      points.push_back(make.pose() * Vector3f(out, y + side * kWide_m, top + (foot - top) * down));
    }
  }
  const UvRect uv{{dice->Chance(0.5) ? 0.0f : 1.0f, static_cast<float>(0.06 * dice->Unit())},
                  {dice->Chance(0.5) ? 1.0f : -1.0f, 0.94f}};
  AddSheet(make.mesh(), points, kAcross, make.f.pvc, uv);
}

void AddFan(const Maker& make, const Vector3f& middle, float radius, Dice* dice) {
  const Vector3f ahead = Vector3f::UnitX();
  make.Turn(middle, ahead,
            {{radius + 0.035f, -0.01f},
             {radius + 0.035f, 0.03f},
             {radius, 0.09f},
             {radius - 0.02f, 0.09f},
             {radius - 0.035f, -0.03f}},
            make.f.dark, 28);
  make.Disc(middle - 0.05f * ahead, ahead, 0.075f, 0.09f, make.f.dark);
  const auto start = static_cast<float>(dice->Between(0, 6.28));
  for (int blade = 0; blade < 5; ++blade) {
    std::vector<Vector3f> points;
    for (int row = 0; row < 2; ++row) {
      for (int k = 0; k < 4; ++k) {
        const float reach = 0.06f + (radius - 0.09f) * static_cast<float>(k) / 3;
        const float angle = start + 1.2566f * static_cast<float>(blade) +
                            (row == 0 ? -0.3f : 0.38f) + 0.1f * static_cast<float>(k);
        points.push_back(make.pose() *
                         (middle + Vector3f(row == 0 ? -0.04f : 0.03f, reach * std::cos(angle),
                                            reach * std::sin(angle))));
      }
    }
    AddSheet(make.mesh(), points, 4, make.f.fins);
  }
  for (float ring = 0.08f; ring < radius; ring += 0.055f) {
    make.Ring(middle + 0.095f * ahead, ahead, ring, 0.0028f, make.f.chrome, 28);
  }
  for (int spoke = 0; spoke < 4; ++spoke) {
    const float angle = 0.785f + 1.571f * static_cast<float>(spoke);
    const Vector3f out(0, std::cos(angle), std::sin(angle));
    make.Pipe({middle + 0.095f * ahead + 0.05f * out, middle + 0.095f * ahead + radius * out},
              0.004f, make.f.chrome, 6);
  }
}

}  // namespace

void AddStripCurtain(const Maker& make, const Vector3f& size, Dice dice) {
  const float half = size.y() / 2, top = size.z();
  make.Block({0, 0, top + 0.06f}, {0.07f, size.y() + 0.1f, 0.12f}, make.p.steel, 0.008f, 0.8f);
  for (const float side : {-1.0f, 1.0f}) {  // jambs with rubbed guards
    make.Block({0, side * (half + 0.05f), top / 2 + 0.05f}, {0.16f, 0.1f, top + 0.1f}, make.f.white,
               0.015f);
    make.Block({0, side * (half + 0.055f), 0.45f}, {0.2f, 0.13f, 0.9f}, make.p.stripes, 0.02f,
               0.5f);
  }
  make.Block({0, 0, top + 0.16f}, {0.16f, size.y() + 0.2f, 0.12f}, make.f.white, 0.015f);
  int strip = 0;
  for (float y = -half + 0.1f; y < half - 0.02f; y += 0.135f, ++strip) {
    Dice own = dice.Fork();
    if (own.Chance(0.04)) continue;  // torn off
    AddStrip(make, y, strip % 2 == 0 ? 0.018f : -0.018f, top + 0.02f, &own);
    make.Disc({0.035f, y, top + 0.04f}, Vector3f::UnitX(), 0.012f, 0.012f, make.f.chrome, 8);
  }
}

void AddPanelWall(const Maker& make, const Vector3f& size, Dice dice) {
  BoxPaint paint = BoxPaint::Whole(make.f.panel);
  const float shift = static_cast<float>(dice.Pick(4)) * 0.25f;
  const float tall = size.z() / 4.0f;
  for (UvRect& uv : paint.uvs) uv = {{shift, 1 - tall}, {size.y() / 4.6f, tall}};
  for (const BoxFace thin : {kLeft, kRight, kTop}) {
    paint.uvs[thin] = {{0.03f, 0.3f}, {0.02f, 0.3f}};
  }
  AddBox(make.mesh(), make.At({0, 0, size.z() / 2}), size, paint);
  for (const float side : {-1.0f, 1.0f}) {  // kerb and rail keep trucks off
    const float out = side * (size.x() / 2 + 0.04f);
    make.Block({out, 0, 0.14f}, {0.09f, size.y(), 0.28f}, make.p.plinth, 0.03f);
    make.Pipe({{out * 1.5f, -size.y() / 2, 0.72f}, {out * 1.5f, size.y() / 2, 0.72f}}, 0.035f,
              make.f.chrome, 12);
    for (float y = -size.y() / 2 + 0.3f; y < size.y() / 2; y += 1.2f) {
      make.Block({out, y, 0.72f}, {0.09f, 0.06f, 0.12f}, make.p.steel, 0.006f);
    }
  }
}

void AddEvaporator(const Maker& make, const Vector3f& size, float roof, Dice dice) {
  constexpr float kTall_m = 0.72f;
  const float low = size.z(), middle = low + kTall_m / 2, front = size.x() / 2;
  make.Block({0, 0, middle}, {size.x(), size.y(), kTall_m}, make.f.white, 0.03f);
  for (int fin = 0; fin < 26; ++fin) {  // the coil shows at the back
    const float y = size.y() * (static_cast<float>(fin) / 25 - 0.5f) * 0.9f;
    make.Block({-front - 0.008f, y, middle}, {0.02f, 0.012f, kTall_m * 0.86f}, make.f.fins, 0.002f);
  }
  const int fans = std::max(1, static_cast<int>(size.y() / 0.68f));
  for (int i = 0; i < fans; ++i) {
    const float y = size.y() * ((static_cast<float>(i) + 0.5f) / static_cast<float>(fans) - 0.5f);
    AddFan(make, {front, y, middle + 0.02f}, 0.26f, &dice);
  }
  make.Block({0.02f, 0, low - 0.04f}, {size.x() + 0.06f, size.y() + 0.08f, 0.06f}, make.p.steel,
             0.02f);
  const float side = size.y() / 2 + 0.09f;
  make.Pipe(Smooth({{-0.1f, size.y() / 2, middle},
                    {-0.1f, side, middle + 0.1f},
                    {-0.1f, side, middle + 0.6f},
                    {-0.1f, side, roof}},
                   4),
            0.055f, make.f.white, 12);
  make.Pipe(Smooth({{0.1f, size.y() / 2, middle - 0.2f},
                    {0.1f, side, middle - 0.1f},
                    {0.1f, side, middle + 0.5f},
                    {0.1f, side, roof}},
                   4),
            0.03f, make.f.dark, 10);
  make.Pipe(Smooth({{0.2f, -0.3f, low - 0.06f},
                    {0.1f, -0.3f, low - 0.2f},
                    {-front - 0.2f, -0.3f, low - 0.26f},
                    {-front - 0.7f, -0.3f, low - 0.3f}},
                   4),
            0.025f, make.f.white, 8);
  for (const float y : {-0.42f, 0.42f}) {
    for (const float x : {-0.3f, 0.3f}) {
      const Vector3f foot(x, y * size.y(), low + kTall_m - 0.02f);
      make.Pipe({foot, {foot.x(), foot.y(), roof}}, 0.009f, make.f.chrome, 6);
    }
  }
}

}  // namespace aisle::sim
