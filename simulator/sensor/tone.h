#pragma once

#include <algorithm>

namespace aisle::sim {

/// From the share of white that a pixel collected to the share that its grey shows.
enum class Tone {
  kLinear,
  kCompanded,  ///< Compand
};

/// The MT9V034's 12 to 10 bit companding: codes to 255 stay, to 511 go two to one, to 2047 four to
/// one, to 4095 eight to one. As shares of white: knees at (1/16, 1/4), (1/8, 3/8), (1/2, 3/4),
/// nearly a square root. Rising and concave, hence the least of its four lines.
inline float Compand(float share) {
  return std::min(std::min(4 * share, 0.125f + 2 * share),
                  std::min(0.25f + share, 0.5f + 0.5f * share));
}

/// Inverse of Compand.
inline float Expand(float grey) {
  return std::max(std::max(0.25f * grey, 0.5f * (grey - 0.125f)),
                  std::max(grey - 0.25f, 2 * grey - 1));
}

}  // namespace aisle::sim
