#pragma once

#include "simulator/shade/lanes/wide.h"
#include "simulator/shade/pass/shading_view.h"

namespace aisle::sim {

/// Eight points of the static world, and where they lie on its triangles.
struct StaticPoints8 {
  F8x3 position;  ///< lifted a little off the surface, for rays that begin there
  F8x3 normal;
  I8 primitive;
  F8 u, v;
  /// Lanes that are such a point. None on a luminaire, which nothing darkens: its own radiance
  /// outshines by far what it reflects.
  I8 active;
};

/// The points of the static world that a picture shows, eight pixels of a row at a time. x is a
/// multiple of eight.
class StaticPixels {
 public:
  /// `shading` must outlive it.
  explicit StaticPixels(const ShadingView& shading) : shading_(shading) {}

  I8 Lanes(int x, int y) const {
    return LoadI(&shading_.image.geometry[shading_.image.Index(x, y)]) == 0;
  }
  /// World; of lanes that are not active nothing is said.
  F8x3 PositionsOf(int x, int y, I8 active) const;
  StaticPoints8 Locate(int x, int y, I8 active) const;

 private:
  const ShadingView& shading_;
};

/// The points where eight rays hit the static world.
StaticPoints8 LocateHits(const SurfaceTables& tables, const Rays8& rays, const Hits8& hits);

}  // namespace aisle::sim
