#include <cmath>

#include "simulator/world/fittings.h"

namespace aisle::sim {
namespace {

using Eigen::Vector3f;

const Vector3f kX = Vector3f::UnitX(), kY = Vector3f::UnitY(), kZ = Vector3f::UnitZ();

/// A rim, three spokes and a handle that stands out.
void AddHandwheel(const Maker& make, const Vector3f& hub, const Vector3f& axis, float radius,
                  float turned) {
  make.Ring(hub + 0.04f * axis, axis, radius, 0.011f, make.f.chrome);
  make.Disc(hub, axis, 0.028f, 0.06f, make.f.dark);
  const Vector3f a = axis.unitOrthogonal(), b = axis.cross(a);
  for (int i = 0; i < 3; ++i) {
    const float angle = turned + 2.0944f * static_cast<float>(i);
    const Vector3f out = std::cos(angle) * a + std::sin(angle) * b;
    make.Pipe({hub + 0.03f * axis, hub + 0.04f * axis + radius * out}, 0.009f, make.f.chrome, 8);
    if (i > 0) continue;
    const Vector3f grip = hub + 0.05f * axis + radius * out;
    make.Turn(grip, axis,
              {{0, 0}, {0.011f, 0.004f}, {0.016f, 0.045f}, {0.012f, 0.075f}, {0, 0.085f}},
              make.f.dark, 12);
  }
}

/// A tray of chips: a sheet-metal pan with curls in it.
void AddChips(const Maker& make, const Vector3f& low, const Vector3f& high, Dice* dice) {
  for (int i = 0; i < 34; ++i) {
    const auto y = static_cast<float>(dice->Between(low.y(), high.y()));
    const Vector3f at(static_cast<float>(dice->Between(low.x(), high.x())), y, low.z());
    std::vector<Vector3f> curl;
    const auto start = static_cast<float>(dice->Between(0, 6.28));
    const auto lean = static_cast<float>(dice->Between(0.004, 0.016));
    for (int k = 0; k < 14; ++k) {
      const float t = static_cast<float>(k);
      curl.push_back(at + Vector3f(0.014f * std::cos(start + 0.9f * t) + 0.3f * lean * t, lean * t,
                                   0.012f + 0.01f * std::sin(start + 0.9f * t)));
    }
    make.Pipe(curl, 0.0028f, make.f.chrome, 4);
  }
}

void AddPanelOfKnobs(const Maker& make, const Vector3f& middle, Dice* dice) {
  make.Block(middle, {0.05f, 0.34f, 0.44f}, make.f.enamel, 0.015f);
  make.Block(middle + Vector3f(0.025f, 0, 0.09f), {0.012f, 0.24f, 0.17f}, make.f.glass, 0.005f);
  for (int i = 0; i < 12; ++i) {
    const float y = -0.11f + 0.055f * static_cast<float>(i % 5);
    const float z = -0.05f - 0.05f * static_cast<float>(i / 5);
    make.Disc(middle + Vector3f(0.024f, y, z), kX, 0.014f, 0.014f,
              dice->Chance(0.3) ? make.f.white : make.f.dark, 10);
  }
  make.Disc(middle + Vector3f(0.022f, 0.11f, -0.15f), kX, 0.032f, 0.035f, make.f.brass, 16);
}

}  // namespace

void AddLathe(const Maker& make, const Vector3f& size, Dice dice) {
  const float half = size.y() / 2;
  const std::uint16_t paint = make.f.enamel;
  for (const float y : {half - 0.33f, -half + 0.3f}) {  // feet
    make.Block({0, y, 0.36f}, {0.52f, 0.5f, 0.72f}, paint, 0.03f);
    make.Block({0, y, 0.03f}, {0.6f, 0.58f, 0.06f}, make.f.dark, 0.012f);
    make.Block({0.262f, y, 0.38f}, {0.012f, 0.36f, 0.5f}, paint, 0.005f, 0.6f);
    make.Disc({0.265f, y - 0.13f, 0.4f}, kX, 0.012f, 0.014f, make.f.dark, 10);
  }
  make.Block({0.03f, -0.05f, 0.56f}, {0.66f, size.y() - 1.1f, 0.05f}, paint, 0.015f);  // pan
  AddChips(make, {-0.2f, -half + 0.7f, 0.585f}, {0.28f, half - 0.8f, 0.585f}, &dice);
  make.Block({0, 0, 0.8f}, {0.36f, size.y() - 0.06f, 0.2f}, paint, 0.02f);  // bed
  for (const float x : {-0.13f, 0.13f}) {
    make.Block({x, -0.2f, 0.91f}, {0.07f, size.y() - 0.62f, 0.035f}, make.f.chrome, 0.008f);
  }
  const float head = half - 0.36f;  // headstock at the left end
  make.Block({-0.02f, head, 1.1f}, {0.5f, 0.64f, 0.46f}, paint, 0.045f);
  make.Block({-0.02f, half - 0.02f, 1.02f}, {0.46f, 0.1f, 0.7f}, paint, 0.04f);
  make.Block({0.235f, head, 1.16f}, {0.015f, 0.5f, 0.24f}, make.f.dark, 0.005f);
  for (int i = 0; i < 3; ++i) {
    const Vector3f at(0.24f, head - 0.16f + 0.16f * static_cast<float>(i), 1.16f);
    make.Disc(at, kX, 0.035f, 0.03f, make.f.chrome, 14);
    const auto lean = static_cast<float>(dice.Between(-1, 1));
    make.Pipe({at + Vector3f(0.03f, 0, 0), at + Vector3f(0.05f, 0.07f * lean, 0.08f)}, 0.008f,
              make.f.chrome, 8);
  }
  const float spindle = 1.16f, nose = half - 0.69f;
  make.Turn({0, nose, spindle}, -kY,
            {{0, 0},
             {0.075f, 0},
             {0.13f, 0.02f},
             {0.135f, 0.03f},
             {0.135f, 0.1f},
             {0.12f, 0.112f},
             {0.03f, 0.112f},
             {0, 0.105f}},
            make.f.chrome, 32);
  for (int i = 0; i < 3; ++i) {  // jaws
    const float angle = 0.4f + 2.0944f * static_cast<float>(i);
    const Vector3f out(std::cos(angle), 0, std::sin(angle));
    make.Pipe({Vector3f(0, nose - 0.11f, spindle) + 0.045f * out,
               Vector3f(0, nose - 0.155f, spindle) + 0.06f * out},
              0.02f, make.f.chrome, 8);
  }
  make.Pipe({{0, nose - 0.11f, spindle}, {0, nose - 0.52f, spindle}}, 0.03f, make.f.chrome, 20);
  const float slide = 0.1f + static_cast<float>(dice.Between(-0.2, 0.15));  // carriage
  make.Block({0.02f, slide, 0.96f}, {0.52f, 0.36f, 0.08f}, paint, 0.015f);
  make.Block({0.22f, slide, 0.78f}, {0.12f, 0.36f, 0.3f}, paint, 0.02f);
  make.Block({0.06f, slide, 1.03f}, {0.36f, 0.15f, 0.07f}, make.f.chrome, 0.01f);
  make.Block({0.05f, slide + 0.02f, 1.1f}, {0.1f, 0.1f, 0.08f}, make.f.dark, 0.008f);
  AddHandwheel(make, {0.29f, slide + 0.07f, 0.8f}, kX, 0.1f,
               static_cast<float>(dice.Between(0, 6)));
  AddHandwheel(make, {0.27f, slide, 1.02f}, kX, 0.06f, static_cast<float>(dice.Between(0, 6)));
  for (const float z : {0.72f, 0.67f}) {  // feed screws
    make.Pipe({{0.2f, half - 0.7f, z}, {0.2f, -half + 0.1f, z}}, 0.014f, make.f.chrome, 10);
  }
  make.Block({0, -half + 0.22f, 1.03f}, {0.3f, 0.32f, 0.2f}, paint, 0.03f);  // tailstock
  make.Turn({0, -half + 0.38f, spindle}, kY,
            {{0, 0}, {0.05f, 0}, {0.05f, 0.1f}, {0.028f, 0.11f}, {0.028f, 0.18f}, {0, 0.24f}},
            make.f.chrome, 18);
  make.Block({0, -half + 0.24f, 1.14f}, {0.16f, 0.3f, 0.16f}, paint, 0.05f);
  AddHandwheel(make, {0, -half + 0.08f, spindle}, -kY, 0.09f, 0.7f);
  make.Block({-0.4f, 0, 1.12f}, {0.02f, size.y() - 0.5f, 0.74f}, paint, 0.008f);  // splash guard
  make.Pipe(Smooth({{-0.34f, slide, 1.0f},
                    {-0.3f, slide, 1.5f},
                    {-0.1f, slide, 1.62f},
                    {0.05f, slide + 0.03f, 1.5f}},
                   5),
            0.012f, make.f.dark, 8);
  make.Turn({0.05f, slide + 0.03f, 1.42f}, kZ,
            {{0.065f, 0}, {0.065f, 0.015f}, {0.035f, 0.09f}, {0, 0.1f}}, make.f.white, 18);
}

void AddMill(const Maker& make, const Vector3f& size, Dice dice) {
  const float front = size.x() / 2, half = size.y() / 2, top = size.z();
  make.Block({0, 0, 0.09f}, {size.x() - 0.1f, size.y() - 0.1f, 0.18f}, make.f.dark, 0.02f);
  make.Block({-0.08f, 0, top / 2 + 0.07f}, {size.x() - 0.16f, size.y(), top - 0.14f}, make.f.enamel,
             0.06f, 1.3f);
  make.Block({-0.3f, 0.1f, top + 0.16f}, {0.9f, 0.9f, 0.36f}, make.f.enamel, 0.05f);
  // Twin doors a little proud of the front, dark windows, long grips.
  for (const float side : {-1.0f, 1.0f}) {
    const float y = side * half * 0.36f - 0.1f;
    const float wide = half * 0.7f;
    make.Block({front - 0.12f, y, top * 0.56f}, {0.1f, wide, top * 0.66f}, make.f.white, 0.025f);
    make.Block({front - 0.073f, y, top * 0.62f}, {0.02f, wide * 0.68f, top * 0.36f}, make.f.glass,
               0.008f);
    const float grip = y - side * wide * 0.43f;
    make.Pipe({{front - 0.06f, grip, top * 0.42f},
               {front - 0.01f, grip, top * 0.44f},
               {front - 0.01f, grip, top * 0.72f},
               {front - 0.06f, grip, top * 0.74f}},
              0.014f, make.f.chrome);
  }
  make.Block({front - 0.13f, -0.1f, 0.42f}, {0.06f, half * 1.45f, 0.3f}, make.f.dark, 0.02f);
  for (int i = 0; i < 9; ++i) {  // louvres at the side
    make.Block({-0.2f, half + 0.004f, 0.55f + 0.045f * static_cast<float>(i)},
               {0.5f, 0.012f, 0.02f}, make.f.dark, 0.004f);
    make.Block({-0.2f, -half - 0.004f, 0.55f + 0.045f * static_cast<float>(i)},
               {0.5f, 0.012f, 0.02f}, make.f.dark, 0.004f);
  }
  // Control panel on its arm, signal lamp, swarf conveyor with a bin.
  make.Pipe(Smooth({{front - 0.2f, -half + 0.18f, top - 0.1f},
                    {front, -half + 0.1f, top - 0.1f},
                    {front + 0.1f, -half + 0.08f, top - 0.3f},
                    {front + 0.1f, -half + 0.08f, 1.6f}},
                   4),
            0.03f, make.f.dark, 12);
  AddPanelOfKnobs(make, {front + 0.12f, -half + 0.08f, 1.38f}, &dice);
  const Vector3f lamp(-0.1f, -half + 0.3f, top);
  make.Pipe({lamp, lamp + Vector3f(0, 0, 0.22f)}, 0.012f, make.f.chrome, 8);
  for (int i = 0; i < 3; ++i) {
    make.Disc(lamp + Vector3f(0, 0, 0.2f + 0.075f * static_cast<float>(i)), kZ, 0.035f, 0.07f,
              i == 1 ? make.f.white : make.f.brass, 14);
  }
  make.Block({-0.2f, half + 0.22f, 0.3f}, {0.42f, 0.5f, 0.24f}, make.f.enamel, 0.03f);
  make.Block({-0.2f, half + 0.5f, 0.72f}, {0.42f, 0.2f, 0.8f}, make.f.enamel, 0.04f);
  make.Pipe(Smooth({{0.2f, half, 0.24f},
                    {0.5f, half + 0.2f, 0.04f},
                    {0.3f, half + 0.6f, 0.03f},
                    {-0.6f, half + 0.5f, 0.03f},
                    {-front, half + 0.3f, 0.2f}},
                   6),
            0.022f, make.f.rubber, 8);
}

void AddDrill(const Maker& make, const Vector3f& size, Dice dice) {
  make.Block({0.05f, 0, 0.05f}, {size.x(), size.y(), 0.1f}, make.f.enamel, 0.02f);
  make.Pipe({{-0.18f, 0, 0.1f}, {-0.18f, 0, size.z() - 0.2f}}, 0.055f, make.f.chrome, 20);
  const float table = 0.86f + static_cast<float>(dice.Between(0, 0.12));
  make.Block({-0.12f, 0, table - 0.06f}, {0.22f, 0.17f, 0.16f}, make.f.enamel, 0.03f);
  make.Block({0.16f, 0, table}, {0.42f, 0.42f, 0.05f}, make.f.chrome, 0.012f);
  make.Block({0.16f, 0.02f, table + 0.06f}, {0.12f, 0.2f, 0.08f}, make.f.dark, 0.01f);
  make.Block({0.14f, 0.12f, table + 0.07f}, {0.14f, 0.05f, 0.11f}, make.f.dark, 0.01f);
  AddHandwheel(make, {-0.12f, -0.1f, table - 0.06f}, -kY, 0.06f, 0.4f);
  const float head = size.z() - 0.24f;
  make.Block({0.05f, 0, head}, {0.6f, 0.27f, 0.4f}, make.f.enamel, 0.06f);
  make.Block({0, 0, head + 0.25f}, {0.68f, 0.3f, 0.13f}, make.f.enamel, 0.05f);
  make.Turn({-0.34f, 0, head - 0.12f}, kZ,
            {{0, 0}, {0.08f, 0.01f}, {0.095f, 0.03f}, {0.095f, 0.26f}, {0.07f, 0.29f}, {0, 0.3f}},
            make.f.dark, 20);
  make.Turn({0.18f, 0, head - 0.46f}, kZ,
            {{0, 0},
             {0.006f, 0.005f},
             {0.007f, 0.1f},
             {0.03f, 0.11f},
             {0.034f, 0.2f},
             {0.024f, 0.21f},
             {0.024f, 0.3f}},
            make.f.chrome, 16);
  const Vector3f hub(0.12f, -0.14f, head - 0.1f);
  make.Disc(hub, -kY, 0.035f, 0.05f, make.f.chrome);
  for (int i = 0; i < 3; ++i) {
    const float angle = 0.5f + 2.0944f * static_cast<float>(i);
    const Vector3f out(std::cos(angle), -0.25f, std::sin(angle));
    make.Pipe({hub, hub + 0.2f * out}, 0.008f, make.f.chrome, 8);
    make.Disc(hub + 0.19f * out, out, 0.018f, 0.03f, make.f.dark, 12);
  }
  make.Block({0.352f, 0, head + 0.02f}, {0.01f, 0.16f, 0.2f}, make.f.dark, 0.004f);
}

}  // namespace aisle::sim
