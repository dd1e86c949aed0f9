#pragma once

#include "slam/map/frame.h"

namespace aisle::slam {

/// Whether a frame shows more than noise.
bool ShowsSomething(const Frame& frame);

/// Whether two frames show one view, moved, by what of their features looks alike; if not, the rig
/// was carried or frames are missing between them.
bool ShareView(const Frame& before, const Frame& now);

}  // namespace aisle::slam
