#include <cmath>

#include "simulator/world/canvas.h"
#include "simulator/world/sheets.h"

namespace aisle::sim {
namespace {

/// A soft dark spot with a ragged rim: many discs of falling size.
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
  const float bend = static_cast<float>(dice.Signed()) * 0.12f;
  float x = static_cast<float>(dice.Between(0.1, 0.6));
  const float gauge = 0.2f;
  for (float y = 0.04f; y < 0.94f; y += 0.02f) {
    const float next = x + bend * 0.02f + 0.004f * static_cast<float>(dice.Signed());
    const float strength = static_cast<float>(wear * dice.Between(0.05, 0.35));
    for (const float side : {0.0f, gauge}) {
      sheet->Line(x + side, y, next + side, y + 0.021f, 0.018f, 0.2f, strength);
    }
    x = next;
  }
}

void Crack(Canvas* sheet, Dice dice) {
  float x = static_cast<float>(dice.Between(0.1, 0.9));
  float y = static_cast<float>(dice.Between(0.1, 0.9));
  float angle = static_cast<float>(dice.Between(0, 6.28));
  for (int i = 0; i < 22; ++i) {
    angle += 0.5f * static_cast<float>(dice.Signed());
    const float nx = x + 0.012f * std::cos(angle), ny = y + 0.012f * std::sin(angle);
    sheet->Line(x, y, nx, ny, 0.001f, 0.22f, 0.7f);
    x = nx;
    y = ny;
  }
}

void DirtTowardsFoot(Canvas* sheet, float strength) {
  for (int i = 0; i < 40; ++i) {
    const float from = 1 - 0.3f * static_cast<float>(i + 1) / 40;
    sheet->Fill(0, from, 1, 1 - from, 0.18f, strength / 40);
  }
}

}  // namespace

cv::Mat1b FloorSheet(Dice dice, FloorKind kind, double wear) {
  const bool painted = kind != FloorKind::kConcrete;
  Canvas sheet(1536, 1536, painted ? 0.55f : 0.52f);
  sheet.Fractal(dice.Fork(), 3, 7, painted ? 0.03f : 0.06f, 0.72f);
  sheet.Noise(dice.Fork(), 512, 512, painted ? 0.02f : 0.05f);
  const int stains = static_cast<int>(wear * 26);
  for (int i = 0; i < stains; ++i) {
    const float radius = static_cast<float>(0.004 + 0.03 * std::pow(dice.Unit(), 2));
    const bool dark = dice.Chance(0.75);
    Stain(&sheet, dice.Fork(), radius, dark ? 0.22f : 0.75f, 0.14f);
  }
  const int marks = static_cast<int>(wear * 4);
  for (int i = 0; i < marks; ++i) TyreMarks(&sheet, dice.Fork(), wear);
  const int cracks = painted ? 0 : static_cast<int>(wear * 6);
  for (int i = 0; i < cracks; ++i) Crack(&sheet, dice.Fork());
  for (int i = 0; i < static_cast<int>(wear * 160); ++i) {  // chips and grit
    sheet.Disc(static_cast<float>(dice.Unit()), static_cast<float>(dice.Unit()),
               static_cast<float>(dice.Between(0.0008, 0.0035)),
               static_cast<float>(dice.Chance(0.6) ? 0.2 : 0.8), 0.7f);
  }
  sheet.Fill(0, 0, 0.0022f, 1, 0.16f, 0.85f);  // saw-cut joints
  sheet.Fill(0, 0, 1, 0.0022f, 0.16f, 0.85f);
  sheet.Grain(dice.Fork(), painted ? 0.012f : 0.03f);
  return sheet.Finish();
}

cv::Mat1b WallSheet(Dice dice, WallKind kind) {
  Canvas sheet(1024, 1024, 0.72f);
  if (kind == WallKind::kPlain) {
    sheet.Fractal(dice.Fork(), 2, 3, 0.006f);
    return sheet.Finish();
  }
  if (kind == WallKind::kPanels) {
    for (int i = 0; i < 16; ++i) {  // ribs
      const float x = static_cast<float>(i) / 16;
      sheet.Fill(x, 0, 0.014f, 1, 0.86f, 0.6f);
      sheet.Fill(x + 0.014f, 0, 0.012f, 1, 0.45f, 0.6f);
    }
    for (int i = 0; i < 4; ++i) {  // panel joints with screws
      const float x = static_cast<float>(i) / 4;
      sheet.Fill(x, 0, 0.004f, 1, 0.3f, 0.8f);
      for (int k = 0; k < 10; ++k) {
        sheet.Disc(x + 0.03f, (static_cast<float>(k) + 0.5f) / 10, 0.004f, 0.4f);
      }
    }
    sheet.Fill(0, 0.5f, 1, 0.006f, 0.4f, 0.7f);
  } else {
    for (int row = 0; row < 32; ++row) {
      for (int i = 0; i < 9; ++i) {
        const float x = (static_cast<float>(i) - 0.5f * static_cast<float>(row % 2)) / 8;
        sheet.Fill(x + 0.004f, static_cast<float>(row) / 32 + 0.004f, 0.117f, 0.0245f,
                   static_cast<float>(dice.Between(0.42, 0.6)));
      }
    }
  }
  for (int i = 0; i < 10; ++i) {  // runs of water
    const float x = static_cast<float>(dice.Unit());
    sheet.Fill(x, static_cast<float>(dice.Between(0, 0.6)),
               static_cast<float>(dice.Between(0.002, 0.012)),
               static_cast<float>(dice.Between(0.1, 0.4)), 0.4f, 0.15f);
  }
  for (int i = 0; i < 24; ++i) {  // scrapes by loads, low down
    const float x = static_cast<float>(dice.Unit()),
                y = static_cast<float>(dice.Between(0.6, 0.97));
    sheet.Line(x, y, x + 0.08f * static_cast<float>(dice.Signed()),
               y + 0.01f * static_cast<float>(dice.Signed()), 0.002f, 0.25f, 0.5f);
  }
  sheet.Fractal(dice.Fork(), 4, 6, 0.03f);
  sheet.Grain(dice.Fork(), 0.015f);
  DirtTowardsFoot(&sheet, 0.35f);
  return sheet.Finish();
}

cv::Mat1b RoofSheet(Dice dice) {
  Canvas sheet(512, 512, 0.5f);
  for (int i = 0; i < 16; ++i) {
    sheet.Fill(static_cast<float>(i) / 16, 0, 0.025f, 1, 0.34f, 0.8f);
  }
  sheet.Fractal(dice.Fork(), 4, 4, 0.04f);
  return sheet.Finish();
}

cv::Mat1b LinePaintSheet(Dice dice, double wear) {
  Canvas sheet(512, 512, 0.88f);
  sheet.Fractal(dice.Fork(), 8, 5, 0.05f);
  for (int i = 0; i < static_cast<int>(wear * 70); ++i) {
    Stain(&sheet, dice.Fork(), static_cast<float>(dice.Between(0.004, 0.03)), 0.5f, 0.3f);
  }
  sheet.Grain(dice.Fork(), 0.02f);
  return sheet.Finish();
}

cv::Mat1b HatchSheet(Dice dice, double wear) {
  Canvas sheet(512, 512, 0.5f);
  for (int i = -4; i < 8; ++i) {
    const float x = static_cast<float>(i) / 4;
    sheet.Polygon({{x, 0}, {x + 0.125f, 0}, {x + 1.125f, 1}, {x + 1, 1}}, 0.86f);
  }
  sheet.Fractal(dice.Fork(), 8, 5, 0.05f);
  for (int i = 0; i < static_cast<int>(wear * 50); ++i) {
    Stain(&sheet, dice.Fork(), static_cast<float>(dice.Between(0.004, 0.03)), 0.5f, 0.3f);
  }
  sheet.Grain(dice.Fork(), 0.03f);
  return sheet.Finish();
}

cv::Mat1b StripeSheet(Dice dice) {
  Canvas sheet(256, 256, 0.12f);
  for (int i = -2; i < 4; ++i) {
    const float x = static_cast<float>(i) / 2;
    sheet.Polygon({{x, 0}, {x + 0.25f, 0}, {x + 1.25f, 1}, {x + 1, 1}}, 0.87f);
  }
  sheet.Fractal(dice.Fork(), 8, 4, 0.04f);
  return sheet.Finish();
}

cv::Mat1b DoorSheet(Dice dice) {
  Canvas sheet(512, 512, 0.66f);
  for (int i = 0; i < 12; ++i) {
    const float y = static_cast<float>(i) / 12;
    sheet.Fill(0, y, 1, 0.008f, 0.3f);
    sheet.Fill(0, y + 0.008f, 1, 0.012f, 0.8f, 0.6f);
  }
  sheet.Fill(0.3f, 0.52f, 0.12f, 0.055f, 0.2f);
  sheet.Fill(0.58f, 0.52f, 0.12f, 0.055f, 0.2f);
  sheet.Fractal(dice.Fork(), 4, 5, 0.03f);
  DirtTowardsFoot(&sheet, 0.4f);
  return sheet.Finish();
}

cv::Mat1b SignSheet(Dice dice) {
  Canvas sheet(1024, 1024, 0.9f);
  const std::array<const char*, 16> texts = {
      "A 01",      "A 02",     "B 03", "B 04",         "C 05",        "C 06", "D 07",   "D 08",
      "FORKLIFTS", "NO ENTRY", "EXIT", "SAFETY SHOES", "MAX 1000 kg", "FIRE", "DOCK 3", "5 km/h"};
  for (int i = 0; i < 16; ++i) {
    Canvas sign =
        sheet.Part(static_cast<float>(i % 4) / 4, static_cast<float>(i / 4) / 4, 0.25f, 0.25f);
    const bool dark = i < 8 || i % 3 == 0;
    const float back = dark ? 0.2f : 0.9f, front = dark ? 0.95f : 0.1f;
    sign.Fill(0, 0, 1, 1, back);
    sign.Frame(0.03f, 0.03f, 0.94f, 0.94f, 0.02f, front);
    if (i < 8) {
      sign.Text(texts[static_cast<std::size_t>(i)], 0.09f, 0.62f, 0.34f, front, 0.8f);
      sign.Barcode(dice.Fork(), 0.2f, 0.74f, 0.6f, 0.13f, front);
    } else {
      if (i % 2 == 0) {
        sign.Polygon({{0.5f, 0.1f}, {0.84f, 0.64f}, {0.16f, 0.64f}}, front);
        sign.Polygon({{0.5f, 0.21f}, {0.74f, 0.58f}, {0.26f, 0.58f}}, back);
        sign.Fill(0.475f, 0.32f, 0.05f, 0.15f, front);
        sign.Disc(0.5f, 0.525f, 0.03f, front);
      } else {
        sign.Disc(0.5f, 0.38f, 0.26f, front);
        sign.Disc(0.5f, 0.38f, 0.21f, back);
        sign.Line(0.36f, 0.24f, 0.64f, 0.52f, 0.05f, front);
      }
      sign.Text(texts[static_cast<std::size_t>(i)], 0.08f, 0.87f, 0.12f, front, 0.84f);
    }
  }
  sheet.Fractal(dice.Fork(), 6, 4, 0.02f);
  return sheet.Finish();
}

}  // namespace aisle::sim
