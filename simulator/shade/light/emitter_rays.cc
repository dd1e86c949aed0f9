#include "simulator/shade/light/emitter_rays.h"

#include <algorithm>
#include <cmath>

namespace aisle::sim {

int RaysForShare(float share, float rays_per_share, int least, int most) {
  const float wanted = std::max(share * rays_per_share, 1.0f);
  const int power = 1 << std::lround(std::log2(wanted));
  return std::clamp(power, least, most);
}

}  // namespace aisle::sim
