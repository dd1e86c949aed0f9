#pragma once

#include "slam/camera/stereo_camera.h"
#include "slam/map/map.h"
#include "slam/mapping/mapping_options.h"
#include "slam/optimize/adjust_map.h"

namespace aisle::slam {

/// Closes a loop (Mur-Artal et al. 2015, III-E): joins the two parts of the map that it connects if
/// it does; finds the landmarks that both visits saw with the new one where the loop says it is;
/// and spreads the error over the map, held by every pair of keyframes that come to share
/// landmarks by that: a few loops alone would not outweigh all the neighbours along the drift of a
/// dense map. Quick, so that tracking soon stands in one map again; exactness comes from
/// AdjustGlobally after. `levels` are those of the pyramids. Takes the map by value and returns the
/// next one: it can run beside readers. At least one loop.
Map CloseLoop(Map map, const std::vector<LoopEdge>& loops, const StereoCamera& camera, int levels,
              const LoopSpreadOptions& spread, const FuseOptions& fuse);

/// A global adjustment and the map it was made of, which has grown on since.
struct GlobalCorrection {
  Map before;
  MapEdit adjusted;         ///< of `before`
  double milliseconds = 0;  ///< reported, never decided upon
};

/// Adjusts all of a map, see AdjustGlobally.
GlobalCorrection CorrectGlobally(Map map, const StereoCamera& camera,
                                 const GlobalAdjustmentOptions& options);

/// What a correction asks of the map as it is `now`: keyframes move with what was made of them, and
/// what mapping has refined since stays as it stood to them; newer keyframes move with the one they
/// were tracked from (spanning tree), landmarks that have changed since with the first that saw
/// them.
MapEdit CarryOver(const Map& now, const GlobalCorrection& correction);

}  // namespace aisle::slam
