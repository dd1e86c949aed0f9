#pragma once

#include "slam/map/triangulate_landmarks.h"
#include "slam/mapping/mapping_policy.h"
#include "slam/mapping/orbslam2_mapping_options.h"

namespace aisle::slam {

/// New landmarks go that are hardly found again, or that nobody has confirmed in time.
MapEdit OrbSlam2CullLandmarks(const Map& map, KeyframeId newest,
                              const OrbSlam2MappingOptions& options);

/// Keyframes around `newest` go whose close points others see as well.
MapEdit OrbSlam2CullKeyframes(const Map& map, KeyframeId newest, const StereoCamera& camera,
                              const OrbSlam2MappingOptions& options);

/// Those of `landmarks` go that have too few observations left.
MapEdit OrbSlam2DropUnsupported(const Map& map, const std::vector<LandmarkId>& landmarks,
                                const OrbSlam2MappingOptions& options);

/// Places a point by the two rays if their angle is wider than that between the two cameras, else
/// by the disparity of the view that has it better; nothing where neither is.
PlacePoint OrbSlam2Place(double least_ray_sine);

/// The neighbours to exchange points with, and theirs.
std::vector<KeyframeId> OrbSlam2FuseNeighbours(const Map& map, KeyframeId id,
                                               const FuseOptions& fuse,
                                               const OrbSlam2MappingOptions& options);

/// How ORB-SLAM2 works a keyframe in, in three steps: landmarks go and come; they are exchanged
/// with neighbours; everything around is adjusted and keyframes go. Where other keyframes wait when
/// a step begins, only the best neighbour helps to place landmarks, nothing is exchanged, nothing
/// is adjusted and no keyframe goes. An adjustment under way is given up after its first pass once
/// a keyframe is wanted.
MappingPolicy OrbSlam2Mapping(const OrbSlam2MappingOptions& options, int mapping_frames);

}  // namespace aisle::slam
