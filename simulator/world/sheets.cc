#include "simulator/world/sheets.h"

#include <array>
#include <cmath>

#include "simulator/world/canvas.h"

namespace aisle::sim {
namespace {

/// A soft spot with a ragged rim: many discs of falling size.
void Stain(Canvas* sheet, Dice dice, float radius, float grey, float strength) {
  const float x = static_cast<float>(dice.Between(0.1, 0.9));
  const float y = static_cast<float>(dice.Between(0.1, 0.9));
  for (int i = 0; i < 14; ++i) {
    const float angle = static_cast<float>(dice.Between(0, 6.28));
    const float away = radius * static_cast<float>(dice.Between(0, 0.9));
    sheet->Disc(x + away * std::cos(angle), y + away * std::sin(angle),
                radius * static_cast<float>(dice.Between(0.15, 0.7)), grey, strength);
  }
}

/// A pair of tyre tracks that swings slightly.
void TyreMarks(Canvas* sheet, Dice dice, double wear) {
  constexpr float kGauge = 0.2f, kStep = 0.02f;
  const float bend = static_cast<float>(dice.Signed()) * 0.12f;
  float x = static_cast<float>(dice.Between(0.1, 0.6));
  for (float y = 0.04f; y < 0.94f; y += kStep) {
    const float next = x + bend * kStep + 0.004f * static_cast<float>(dice.Signed());
    const float strength = static_cast<float>(wear * dice.Between(0.05, 0.3));
    for (const float side : {0.0f, kGauge}) {
      sheet->Line(x + side, y, next + side, y + kStep, 0.018f, 0.2f, strength);
    }
    x = next;
  }
}

void RubOff(Canvas* sheet, Dice* dice, double wear) {
  sheet->Fractal(dice->Fork(), 8, 5, 0.05f);
  for (int i = 0; i < static_cast<int>(wear * 60); ++i) {
    const auto radius = static_cast<float>(dice->Between(0.004, 0.03));
    Stain(sheet, dice->Fork(), radius, 0.5f, 0.3f);
  }
  sheet->Grain(dice->Fork(), 0.02f);
}

}  // namespace

cv::Mat1b Plainer(const cv::Mat1b& picture, float share, int limit) {
  std::array<int, 256> count = {};
  for (const std::uint8_t grey : picture) ++count[grey];
  int median = 0;
  for (int below = count[0]; 2 * below < static_cast<int>(picture.total());) {
    below += count[static_cast<std::size_t>(++median)];
  }
  cv::Mat1b curve(1, 256);
  for (int grey = 0; grey < 256; ++grey) {
    const float within = static_cast<float>(std::clamp(grey - median, -limit, limit));
    curve(grey) =
        static_cast<std::uint8_t>(std::lround(static_cast<float>(grey) - (1 - share) * within));
  }
  cv::Mat1b plainer;
  cv::LUT(picture, curve, plainer);
  return plainer;
}

cv::Mat1b WornFloor(const cv::Mat1b& clean, Dice dice, double wear) {
  Canvas sheet(clean);
  for (int i = 0; i < static_cast<int>(wear * 26); ++i) {
    const float radius = static_cast<float>(0.004 + 0.03 * std::pow(dice.Unit(), 2));
    const bool dark = dice.Chance(0.75);
    Stain(&sheet, dice.Fork(), radius, dark ? 0.22f : 0.75f, 0.12f);
  }
  for (int i = 0; i < static_cast<int>(wear * 4); ++i) TyreMarks(&sheet, dice.Fork(), wear);
  for (int i = 0; i < static_cast<int>(wear * 200); ++i) {  // chips and grit
    const float grey = dice.Chance(0.6) ? 0.2f : 0.8f;
    const auto radius = static_cast<float>(dice.Between(0.0008, 0.003));
    const auto y = static_cast<float>(dice.Unit()), x = static_cast<float>(dice.Unit());
    sheet.Disc(x, y, radius, grey, 0.7f);
  }
  sheet.Fill(0, 0, 0.0022f, 1, 0.16f, 0.85f);  // saw-cut joints
  sheet.Fill(0, 0, 1, 0.0022f, 0.16f, 0.85f);
  return sheet.Finish();
}

cv::Mat1b LinePaintSheet(Dice dice, double wear) {
  Canvas sheet(512, 512, 0.86f);
  RubOff(&sheet, &dice, wear);
  return sheet.Finish();
}

cv::Mat1b HatchSheet(Dice dice, double wear) {
  Canvas sheet(512, 512, 0.5f);
  for (int i = -4; i < 8; ++i) {
    const float x = static_cast<float>(i) / 4;
    sheet.Polygon({{x, 0}, {x + 0.125f, 0}, {x + 1.125f, 1}, {x + 1, 1}}, 0.84f);
  }
  RubOff(&sheet, &dice, wear);
  return sheet.Finish();
}

}  // namespace aisle::sim
