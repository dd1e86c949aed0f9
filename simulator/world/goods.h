#pragma once

#include "simulator/world/palette.h"

namespace aisle::sim {

inline constexpr float kPalletWidth_m = 0.8f;   ///< EUR pallet, along its y
inline constexpr float kPalletLength_m = 1.2f;  ///< along its x
inline constexpr float kPalletHeight_m = 0.144f;

/// Appends an EUR pallet standing on the origin of `pose`.
void AddPallet(TriangleMesh* mesh, const Palette& palette, const Eigen::Isometry3f& pose);

/// Appends goods of a kind within a footprint (x × y) and a height, standing on the origin of
/// `pose`. kMixed picks one of the kinds.
void AddGoods(TriangleMesh* mesh, const Palette& palette, const Eigen::Isometry3f& pose,
              const Eigen::Vector2f& footprint, float height, GoodsKind kind, Dice dice);

/// A pallet with goods on it; `height` is that of the goods.
void AddLoadedPallet(TriangleMesh* mesh, const Palette& palette, const Eigen::Isometry3f& pose,
                     float height, GoodsKind kind, Dice dice);

}  // namespace aisle::sim
