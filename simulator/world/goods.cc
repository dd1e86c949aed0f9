#include "simulator/world/goods.h"

#include <cmath>

namespace aisle::sim {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

/// Usual sizes of cartons in metres (x, y, z); all tile a pallet or most of it.
constexpr std::array<std::array<float, 3>, 7> kCartonSizes = {{{0.6f, 0.4f, 0.4f},
                                                               {0.4f, 0.4f, 0.3f},
                                                               {0.4f, 0.266f, 0.25f},
                                                               {0.6f, 0.4f, 0.2f},
                                                               {0.3f, 0.4f, 0.35f},
                                                               {0.6f, 0.8f, 0.45f},
                                                               {0.4f, 0.8f, 0.3f}}};

constexpr float kWrapTile_m = 1.2f;

float Between(Dice* dice, double low, double high) {
  return static_cast<float>(dice->Between(low, high));
}

std::size_t PickOf(std::size_t count, Dice* dice) {
  return static_cast<std::size_t>(dice->Pick(static_cast<int>(count)));
}

void AddCarton(TriangleMesh* mesh, const Palette& palette, const Eigen::Isometry3f& pose,
               const Vector3f& size, std::size_t kind, Dice* dice) {
  BoxPaint paint = BoxPaint::Whole(palette.carton, palette.carton_sides[kind]);
  // Two neighbouring sides show one picture, the other two another.
  const std::size_t plain = (kind * 5 + 2) % kCartonSides;
  paint.uvs[kBack] = paint.uvs[kLeft] = palette.carton_sides[plain];
  paint.uvs[kTop] = palette.carton_tops[kind % kCartonTops];
  if (dice->Chance(0.5)) std::swap(paint.uvs[kFront], paint.uvs[kBack]);
  if (dice->Chance(0.5)) std::swap(paint.uvs[kLeft], paint.uvs[kRight]);
  paint.faces = kNoBottom;
  AddBox(mesh, pose * At(0, 0, size.z() / 2), size, paint);
}

/// Layers of equal cartons, put down by hand: every one a little off, the top layer not full.
void AddCartons(TriangleMesh* mesh, const Palette& palette, const Eigen::Isometry3f& pose,
                const Vector2f& footprint, float height, bool identical, Dice dice) {
  const auto& choice = kCartonSizes[identical ? 0 : PickOf(kCartonSizes.size(), &dice)];
  Vector3f size(choice[0], choice[1], choice[2]);
  const std::size_t kind = identical ? 1 : PickOf(kCartonSides, &dice);
  const auto fitting = [](float room, float side) {
    return std::max(1, static_cast<int>(room / side + 0.01f));
  };
  const int nx = fitting(footprint.x(), size.x()), ny = fitting(footprint.y(), size.y());
  const int layers = fitting(height, size.z());
  size = size.cwiseMin(Vector3f(footprint.x(), footprint.y(), height));  // low, narrow shelves
  const double sloppy = identical ? 0 : 1;
  for (int layer = 0; layer < layers; ++layer) {
    const bool top = layer + 1 == layers;
    for (int i = 0; i < nx * ny; ++i) {
      if (top && layers > 1 && dice.Chance(0.25 * sloppy)) continue;
      const float x = (static_cast<float>(i / ny) - static_cast<float>(nx - 1) / 2) * size.x();
      const float y = (static_cast<float>(i % ny) - static_cast<float>(ny - 1) / 2) * size.y();
      const float turn = static_cast<float>(sloppy * 0.02 * dice.Signed());
      const float slip = static_cast<float>(sloppy * 0.012);
      const float slip_y = slip * static_cast<float>(dice.Signed());
      const float slip_x = slip * static_cast<float>(dice.Signed());
      AddCarton(mesh, palette,
                pose * At(x + slip_x, y + slip_y, static_cast<float>(layer) * size.z(), turn),
                size * 0.985f, kind, &dice);
    }
  }
}

/// Single cartons of many sizes side by side, some with another on top.
void AddLooseCartons(TriangleMesh* mesh, const Palette& palette, const Eigen::Isometry3f& pose,
                     const Vector2f& footprint, float height, Dice dice) {
  float y = -footprint.y() / 2;
  while (true) {
    const float width = Between(&dice, 0.2, 0.6);
    if (y + width > footprint.y() / 2) break;
    float z = 0;
    while (true) {
      const float tall = Between(&dice, 0.15, 0.5), wide = width * Between(&dice, 0.8, 0.97);
      const Vector3f size(Between(&dice, 0.3, 0.9) * footprint.x(), wide, tall);
      if (z + size.z() > height) break;
      const std::size_t kind = PickOf(kCartonSides, &dice);
      const float turn = static_cast<float>(0.06 * dice.Signed());
      const float x = (footprint.x() - size.x()) / 2 * Between(&dice, -1, 1);
      AddCarton(mesh, palette, pose * At(x, y + width / 2, z, turn), size, kind, &dice);
      z += size.z();
      if (dice.Chance(0.45)) break;
    }
    y += width + Between(&dice, 0.01, 0.12);
  }
}

void AddDrums(TriangleMesh* mesh, const Palette& palette, const Eigen::Isometry3f& pose,
              const Vector2f& footprint, float height, Dice dice) {
  const float radius = std::min({0.29f, footprint.y() / 2 - 0.01f, footprint.x() / 2});
  const float tall = std::min(0.88f, height);
  const int nx = std::max(1, static_cast<int>(footprint.x() / (2 * radius)));
  for (int i = 0; i < nx; ++i) {
    const float x = (static_cast<float>(i) - static_cast<float>(nx - 1) / 2) * 2.02f * radius;
    AddCylinder(mesh, pose * At(x, 0, 0, Between(&dice, 0, 6.28)), radius, tall, 20, palette.drum,
                {}, {{0.1f, 0.06f}, {0.2f, 0.2f}});
  }
}

void AddTotes(TriangleMesh* mesh, const Palette& palette, const Eigen::Isometry3f& pose,
              const Vector2f& footprint, float height, Dice dice) {
  // Low, narrow shelves hold smaller ones.
  const Vector3f size =
      Vector3f(0.59f, 0.39f, 0.3f).cwiseMin(Vector3f(footprint.x(), footprint.y(), height));
  const int nx = std::max(1, static_cast<int>(footprint.x() / 0.6f + 0.01f));
  const int ny = std::max(1, static_cast<int>(footprint.y() / 0.4f + 0.01f));
  for (int i = 0; i < nx * ny; ++i) {
    const int layers = 1 + dice.Pick(std::max(1, static_cast<int>(height / 0.31f)));
    for (int layer = 0; layer < layers; ++layer) {
      const float x = (static_cast<float>(i / ny) - static_cast<float>(nx - 1) / 2) * 0.6f;
      const float y = (static_cast<float>(i % ny) - static_cast<float>(ny - 1) / 2) * 0.4f;
      BoxPaint paint = BoxPaint::Whole(palette.tote);
      paint.faces = kNoBottom;
      AddBox(mesh,
             pose * At(x, y, 0.31f * static_cast<float>(layer) + size.z() / 2,
                       static_cast<float>(0.015 * dice.Signed())),
             size, paint);
    }
  }
}

void AddWrapped(TriangleMesh* mesh, const Palette& palette, const Eigen::Isometry3f& pose,
                const Vector2f& footprint, float height, Dice dice) {
  const Vector3f size(footprint.x() * 0.97f, footprint.y() * 0.97f,
                      height * Between(&dice, 0.75, 1));
  BoxPaint paint;
  paint.material = palette.wrap;
  for (UvRect& uv : paint.uvs) {
    uv.origin = {Between(&dice, 0, 1), Between(&dice, 0, 1)};
    uv.size = {size.x() / kWrapTile_m, size.z() / kWrapTile_m};
  }
  paint.faces = kNoBottom;
  AddBox(mesh, pose * At(0, 0, size.z() / 2, static_cast<float>(0.02 * dice.Signed())), size,
         paint);
}

GoodsKind PickKind(Dice* dice) {
  const double draw = dice->Unit();
  return draw < 0.62   ? GoodsKind::kCartons
         : draw < 0.80 ? GoodsKind::kWrapped
         : draw < 0.91 ? GoodsKind::kTotes
                       : GoodsKind::kDrums;
}

}  // namespace

void AddPallet(TriangleMesh* mesh, const Palette& palette, const Eigen::Isometry3f& pose) {
  const auto board = [&](const Vector3f& middle, const Vector3f& size) {
    Eigen::Isometry3f at = pose;
    at.translate(middle);
    AddBox(mesh, at, size, BoxPaint::Tiled(palette.wood, size, 0.9f, middle.head<2>()));
  };
  for (int i = 0; i < 5; ++i) {  // top boards
    const float y = -0.33f + 0.165f * static_cast<float>(i);
    board({0, y, 0.133f}, {kPalletLength_m, 0.12f, 0.022f});
  }
  for (int i = 0; i < 3; ++i) {
    const float y = -0.33f + 0.33f * static_cast<float>(i);
    board({0, y, 0.011f}, {kPalletLength_m, 0.1f, 0.022f});
    for (int k = 0; k < 3; ++k) {  // blocks
      board({-0.53f + 0.53f * static_cast<float>(k), y, 0.072f}, {0.14f, 0.1f, 0.1f});
    }
  }
}

void AddGoods(TriangleMesh* mesh, const Palette& palette, const Eigen::Isometry3f& pose,
              const Vector2f& footprint, float height, GoodsKind kind, Dice dice) {
  if (kind == GoodsKind::kMixed) kind = PickKind(&dice);
  switch (kind) {
    case GoodsKind::kCartons:
      if (dice.Chance(0.2)) {
        AddLooseCartons(mesh, palette, pose, footprint, height, dice.Fork());
      } else {
        AddCartons(mesh, palette, pose, footprint, height, false, dice.Fork());
      }
      break;
    case GoodsKind::kIdentical:
      AddCartons(mesh, palette, pose, footprint, height, true, Dice(0, {}));
      break;
    case GoodsKind::kDrums:
      AddDrums(mesh, palette, pose, footprint, height, dice.Fork());
      break;
    case GoodsKind::kTotes:
      AddTotes(mesh, palette, pose, footprint, height, dice.Fork());
      break;
    case GoodsKind::kWrapped:
      AddWrapped(mesh, palette, pose, footprint, height, dice.Fork());
      break;
    case GoodsKind::kMixed:
    case GoodsKind::kNothing:
      break;
  }
}

void AddLoadedPallet(TriangleMesh* mesh, const Palette& palette, const Eigen::Isometry3f& pose,
                     float height, GoodsKind kind, Dice dice) {
  AddPallet(mesh, palette, pose);
  AddGoods(mesh, palette, pose * At(0, 0, kPalletHeight_m),
           {kPalletLength_m - 0.02f, kPalletWidth_m - 0.02f}, height, kind, dice);
}

}  // namespace aisle::sim
