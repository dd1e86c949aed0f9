#pragma once

namespace aisle::slam {

/// What a disparity image (CV_32F, pixels, x_left - x_right >= 0) holds where nothing could be
/// matched.
inline constexpr float kNoDisparity = -1.0F;

}  // namespace aisle::slam
