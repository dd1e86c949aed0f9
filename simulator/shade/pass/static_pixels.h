#pragma once

#include "simulator/shade/lanes/wide.h"
#include "simulator/shade/pass/shading_view.h"

namespace aisle::sim {

/// Eight pixels of a row: where their static surfaces are and which way these face.
struct Pixels8 {
  F8x3 position, normal;
  I8 active;  ///< lanes that show the static world
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
  /// The points lifted a little off their surfaces, for rays that begin there.
  Pixels8 Locate(int x, int y, I8 active) const;

 private:
  const ShadingView& shading_;
};

}  // namespace aisle::sim
