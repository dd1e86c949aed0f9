#pragma once

#include "simulator/shade/lanes/wide.h"

namespace aisle::sim {

/// Eight frames around unit normals, the third axes; Duff et al. 2017, as BasisAround.
struct Frame8 {
  F8x3 x, y, z;

  explicit Frame8(const F8x3& n) : z(n) {
    const F8 sign = Select(n.z < 0, Wide(-1), Wide(1));
    const F8 a = -1 / (sign + n.z), b = n.x * n.y * a;
    x = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
    y = {b, sign + n.y * n.y * a, -n.y};
  }
  F8x3 ToLocal(const F8x3& d) const { return {Dot(x, d), Dot(y, d), Dot(z, d)}; }
  F8x3 ToWorld(const F8x3& d) const {
    return {x.x * d.x + y.x * d.y + z.x * d.z, x.y * d.x + y.y * d.y + z.y * d.z,
            x.z * d.x + y.z * d.y + z.z * d.z};
  }
};

}  // namespace aisle::sim
