#pragma once

#include "slam/map/frame.h"

namespace aisle::slam {

/// Whether a frame shows more than noise.
bool ShowsSomething(const Frame& frame);

/// Whether `now` shows another place than the frame `before` it: too little of what they show looks
/// alike for one view that has moved. The rig was carried, or frames are missing between them.
/// Never said of frames that show less than half of the `budget` of features a frame may have: they
/// may all lie on what a mover close by had hidden until now.
bool IsCut(const Frame& before, const Frame& now, int budget);

}  // namespace aisle::slam
