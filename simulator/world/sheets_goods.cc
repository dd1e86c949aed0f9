#include <cmath>

#include "simulator/world/canvas.h"
#include "simulator/world/sheets.h"

namespace aisle::sim {
namespace {

float Between(Dice* dice, double low, double high) {
  return static_cast<float>(dice->Between(low, high));
}

/// A line of print that cannot be read but looks like it: words as bars of letter height.
void SmallPrint(Canvas* sheet, Dice* dice, float x, float y, float w, float h) {
  for (float at = x; at < x + w;) {
    const float word = Between(dice, 0.02, 0.09);
    sheet->Fill(at, y, std::min(word, x + w - at), h, 0.15f, 0.75f);
    at += word + 0.012f;
  }
}

void Label(Canvas* face, Dice dice) {
  static constexpr std::array<const char*, 10> kWords = {
      "NORDPACK", "LOT", "PARTS", "HAMBURG", "RIGA", "FRAGILE", "QTY", "OSLO", "TOOLS", "PUMPS"};
  const float w = Between(&dice, 0.28, 0.5), h = Between(&dice, 0.22, 0.4);
  const float x = Between(&dice, 0.06, 0.9 - w), y = Between(&dice, 0.1, 0.85 - h);
  Canvas label = face->Part(x, y, w, h);
  label.Fill(0, 0, 1, 1, 0.92f);
  label.Text(kWords[static_cast<std::size_t>(dice.Pick(10))], 0.06f, 0.22f, 0.14f, 0.1f, 0.6f);
  label.Text(std::to_string(1000 + dice.Pick(8999)), 0.62f, 0.22f, 0.13f, 0.1f, 0.34f);
  for (int i = 0; i < 3; ++i) {
    SmallPrint(&label, &dice, 0.06f, 0.3f + 0.08f * static_cast<float>(i), 0.84f, 0.035f);
  }
  label.Barcode(dice.Fork(), 0.06f, 0.58f, 0.86f, 0.3f, 0.08f);
  label.Frame(0, 0, 1, 1, 0.01f, 0.5f);
}

void Print(Canvas* face, Dice dice) {
  static constexpr std::array<const char*, 8> kBrands = {"KARO",  "ALBA",    "NEXUS", "VOLTA",
                                                         "TERRA", "DELTA-9", "FJORD", "MAXI"};
  const float ink = Between(&dice, 0.12, 0.3);
  face->Text(kBrands[static_cast<std::size_t>(dice.Pick(8))], Between(&dice, 0.06, 0.3),
             Between(&dice, 0.3, 0.5), Between(&dice, 0.1, 0.2), ink, 0.6f);
  const float x = Between(&dice, 0.65, 0.75), y = Between(&dice, 0.6, 0.7);
  for (const float dx : {0.0f, 0.12f}) {  // this side up
    face->Fill(x + dx + 0.03f, y + 0.05f, 0.025f, 0.17f, ink);
    face->Polygon({{x + dx, y + 0.08f}, {x + dx + 0.0425f, y}, {x + dx + 0.085f, y + 0.08f}}, ink);
  }
  face->Fill(x - 0.01f, y + 0.24f, 0.23f, 0.015f, ink);
}

/// Corrugated board, darker at the edges and rubbed at the corners.
void Board(Canvas* face, Dice dice) {
  const float base = Between(&dice, 0.46, 0.72);
  face->Fill(0, 0, 1, 1, base);
  face->Noise(dice.Fork(), 90, 6, 0.012f);
  face->Fractal(dice.Fork(), 3, 5, 0.03f);
  for (int i = 0; i < 8; ++i) {
    const float rim = 0.004f * static_cast<float>(i + 1);
    face->Frame(0, 0, 1, 1, rim, base * 0.8f + 0.012f * static_cast<float>(i));
  }
  for (int i = 0; i < 10; ++i) {  // dents and rubs
    const float x = Between(&dice, 0, 1), y = Between(&dice, 0, 1);
    face->Line(x, y, x + Between(&dice, -0.1, 0.1), y + Between(&dice, -0.1, 0.1), 0.004f,
               base * (dice.Chance(0.5) ? 0.75f : 1.2f), 0.5f);
  }
}

}  // namespace

cv::Mat1b CartonSheet(Dice dice) {
  Canvas sheet(2048, 2048, 0.6f);
  for (int i = 0; i < 16; ++i) {
    Canvas face =
        sheet.Part(static_cast<float>(i % 4) / 4, static_cast<float>(i / 4) / 4, 0.25f, 0.25f);
    Board(&face, dice.Fork());
    const bool top = i >= 12, labelled = i < 8;
    if (top) {
      face.Fill(0, 0.495f, 1, 0.008f, 0.25f);
      face.Fill(0, 0.45f, 1, 0.1f, 0.8f, 0.45f);
    } else {
      face.Fill(0.44f, 0, 0.12f, Between(&dice, 0.1, 0.25), 0.8f, 0.45f);
      if (i >= 4) Print(&face, dice.Fork());
    }
    if (labelled || i == 13) Label(&face, dice.Fork());
  }
  sheet.Grain(dice.Fork(), 0.012f);
  return sheet.Finish();
}

cv::Mat1b WoodSheet(Dice dice) {
  Canvas sheet(512, 512, 0.6f);
  for (int plank = 0; plank < 4; ++plank) {
    Canvas board = sheet.Part(0, static_cast<float>(plank) / 4, 1, 0.25f);
    board.Fill(0, 0, 1, 1, Between(&dice, 0.45, 0.68));
    board.Noise(dice.Fork(), 3, 24, 0.07f);
    board.Noise(dice.Fork(), 6, 60, 0.06f);
    for (int i = 0; i < 3; ++i) {
      board.Disc(Between(&dice, 0, 1), Between(&dice, 0.2, 0.8), 0.012f, 0.25f, 0.8f);
    }
    for (const float x : {0.04f, 0.5f, 0.96f}) board.Disc(x, 0.5f, 0.006f, 0.12f);
  }
  sheet.Grain(dice.Fork(), 0.03f);
  return sheet.Finish();
}

cv::Mat1b UprightSheet(Dice dice) {
  Canvas sheet(128, 512, 0.34f);
  sheet.Fractal(dice.Fork(), 4, 4, 0.04f);
  for (int i = 0; i < 10; ++i) {  // two columns of holes
    const float y = (static_cast<float>(i) + 0.5f) / 10;
    for (const float x : {0.3f, 0.7f}) sheet.Fill(x - 0.09f, y - 0.02f, 0.18f, 0.04f, 0.04f);
  }
  for (int i = 0; i < 12; ++i) {
    const float x = Between(&dice, 0, 1), y = Between(&dice, 0, 1);
    sheet.Line(x, y, x + Between(&dice, -0.2, 0.2), y + 0.02f, 0.02f, 0.6f, 0.5f);
  }
  return sheet.Finish();
}

cv::Mat1b BeamSheet(Dice dice) {
  Canvas sheet(1024, 128, 0.6f);
  sheet.Fractal(dice.Fork(), 16, 4, 0.03f);
  sheet.Fill(0, 0.42f, 1, 0.16f, 0.52f);
  for (int i = 0; i < 3; ++i) {  // place labels
    const float x = (static_cast<float>(i) + 0.5f) / 3 - 0.035f;
    Canvas label = sheet.Part(x, 0.18f, 0.07f, 0.64f);
    label.Fill(0, 0, 1, 1, 0.93f);
    label.Barcode(dice.Fork(), 0.08f, 0.12f, 0.5f, 0.5f, 0.05f);
    label.Text(std::to_string(10 + dice.Pick(89)), 0.62f, 0.62f, 0.45f, 0.1f, 0.34f);
  }
  for (int i = 0; i < 30; ++i) {
    const float x = Between(&dice, 0, 1), y = Between(&dice, 0, 1);
    sheet.Line(x, y, x + Between(&dice, -0.04, 0.04), y + Between(&dice, -0.1, 0.1), 0.002f, 0.3f,
               0.6f);
  }
  return sheet.Finish();
}

cv::Mat1b SteelSheet(Dice dice) {
  Canvas sheet(256, 256, 0.42f);
  sheet.Fractal(dice.Fork(), 4, 5, 0.05f);
  for (int i = 0; i < 40; ++i) {
    const float x = Between(&dice, 0, 1), y = Between(&dice, 0, 1);
    sheet.Line(x, y, x + Between(&dice, -0.1, 0.1), y + Between(&dice, -0.1, 0.1), 0.004f,
               dice.Chance(0.5) ? 0.25f : 0.65f, 0.5f);
  }
  return sheet.Finish();
}

cv::Mat1b WrapSheet(Dice dice) {
  Canvas sheet(1024, 1024, 0.55f);
  for (int row = 0; row < 5; ++row) {  // cartons below the film
    for (int i = 0; i < 4; ++i) {
      Canvas box = sheet.Part(static_cast<float>(i) / 4, static_cast<float>(row) / 5, 0.25f, 0.2f);
      box.Fill(0, 0, 1, 1, Between(&dice, 0.4, 0.62));
      box.Frame(0, 0, 1, 1, 0.02f, 0.28f);
      if (dice.Chance(0.6)) Label(&box, dice.Fork());
    }
  }
  sheet.Fill(0, 0, 1, 1, 0.68f, 0.3f);  // the film's haze
  for (int i = 0; i < 60; ++i) {        // folds and highlights
    const float y = Between(&dice, 0, 1), x = Between(&dice, 0, 0.8);
    sheet.Line(x, y, x + Between(&dice, 0.1, 0.5), y + Between(&dice, -0.06, 0.06),
               Between(&dice, 0.001, 0.005), dice.Chance(0.6) ? 0.95f : 0.35f, 0.4f);
  }
  sheet.Noise(dice.Fork(), 6, 60, 0.04f);
  sheet.Fractal(dice.Fork(), 6, 5, 0.04f);
  return sheet.Finish();
}

cv::Mat1b DrumSheet(Dice dice) {
  Canvas sheet(1024, 512, 0.38f);
  sheet.Fractal(dice.Fork(), 8, 5, 0.03f);
  for (const float y : {0.02f, 0.33f, 0.66f, 0.96f}) {
    sheet.Fill(0, y, 1, 0.02f, 0.6f);
    sheet.Fill(0, y + 0.02f, 1, 0.012f, 0.15f);
  }
  for (int i = 0; i < 3; ++i) {
    Canvas side = sheet.Part(static_cast<float>(i) / 3, 0.36f, 0.3f, 0.3f);
    Label(&side, dice.Fork());
  }
  for (int i = 0; i < 40; ++i) {
    const float x = Between(&dice, 0, 1), y = Between(&dice, 0, 1);
    sheet.Line(x, y, x + Between(&dice, -0.03, 0.03), y + Between(&dice, -0.05, 0.05), 0.002f,
               0.62f, 0.6f);
  }
  return sheet.Finish();
}

cv::Mat1b ToteSheet(Dice dice) {
  Canvas sheet(512, 512, 0.45f);
  sheet.Frame(0.02f, 0.02f, 0.96f, 0.96f, 0.03f, 0.58f);
  for (int i = 1; i < 6; ++i) {
    sheet.Fill(static_cast<float>(i) / 6 - 0.008f, 0.08f, 0.016f, 0.84f, 0.56f);
    sheet.Fill(static_cast<float>(i) / 6 + 0.008f, 0.08f, 0.01f, 0.84f, 0.3f);
  }
  sheet.Fill(0.34f, 0.14f, 0.32f, 0.09f, 0.1f);  // handle
  Canvas card = sheet.Part(0.34f, 0.45f, 0.34f, 0.3f);
  card.Fill(0, 0, 1, 1, 0.9f);
  card.Barcode(dice.Fork(), 0.08f, 0.1f, 0.84f, 0.4f, 0.08f);
  card.Text(std::to_string(100 + dice.Pick(899)), 0.1f, 0.9f, 0.28f, 0.1f, 0.8f);
  sheet.Fractal(dice.Fork(), 4, 5, 0.03f);
  return sheet.Finish();
}

}  // namespace aisle::sim
