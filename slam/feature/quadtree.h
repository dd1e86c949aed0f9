#pragma once

#include <span>
#include <vector>

#include "slam/feature/corners.h"

namespace aisle::slam {

/// Chooses at most `count` corners, spread over the image as in ORB-SLAM (Mur-Artal et al. 2015):
/// the area is quartered, larger and then fuller quarters first, until there are enough non-empty
/// ones, and each gives its strongest corner. Exactly min(count, corners) come out, by rising
/// (y, x), whatever order they went in; ties fall to the upper, then the left corner.
std::vector<Corner> DistributeCorners(std::span<const Corner> corners, int count);

}  // namespace aisle::slam
