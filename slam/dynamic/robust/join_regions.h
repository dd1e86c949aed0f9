#pragma once

#include "slam/dynamic/robust/disparity_tolerance.h"
#include "slam/dynamic/robust/moving_regions.h"

namespace aisle::slam::dynamic {

/// The things that the regions are parts of, the largest part's first: what lies to a good share in
/// the box of a larger region, at the same distance, is part of that, as a truck's mast and cab
/// are, between which the wall behind it shows. The box encloses all parts; the id is the oldest of
/// theirs. `parts` are as FindRegions gives them, the largest first. `disparity`, of half size, is
/// not positive where it is unknown; nothing is joined to what has no known one.
std::vector<PixelRegion> JoinRegions(const PixelRegions& parts, const cv::Mat1f& disparity,
                                     const DisparityTolerance& tolerance,
                                     const RegionOptions& options);

}  // namespace aisle::slam::dynamic
