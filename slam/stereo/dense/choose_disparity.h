#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace aisle::slam {

/// The disparity of least cost of a pixel.
struct Winner {
  std::uint16_t cost = 0;
  std::int16_t sixteenths = -1;  ///< of a pixel; < 0: others cost nearly as little
  std::uint8_t disparity = 0;    ///< whole pixels
};

/// Of `pixels` in a row, each with costs of 32, 64, 96 or 128 disparities below 512, the sums of
/// two numbers. Others than its neighbours must cost more than a winner by `uniqueness_percent`.
/// Between whole disparities the costs are taken to rise as fast on either side (equiangular
/// lines).
void ChooseDisparities(const std::uint8_t* some, const std::uint8_t* others, int pixels,
                       int disparities, int uniqueness_percent, Winner* winners);

/// Forgets the winners of a row that more than `most_difference` part from what the right image's
/// pixel there would choose of them: its cheapest. Writes sixteenths, or `unknown`.
void CheckRightToLeft(const Winner* winners, int columns, int most_difference, std::int16_t unknown,
                      std::int16_t* sixteenths);

}  // namespace aisle::slam
