#pragma once

#include <array>
#include <vector>

#include "simulator/mesh/capture/body_map.h"
#include "simulator/mesh/capture/retarget.h"
#include "simulator/mesh/pose.h"

namespace aisle::sim {

/// Where the balls of both feet are, frame by frame; metres, z up.
using FootTracks = std::array<std::vector<Eigen::Vector3d>, 2>;
/// Frames in which a foot stands, first and last of each time.
using FootContacts = std::array<std::vector<std::array<std::size_t, 2>>, 2>;

/// A foot stands while its ball is slow and near to the lowest it comes; shorter than a tenth of a
/// second does not count.
FootContacts FindContacts(const FootTracks& tracks, double frame_s, const RetargetOptions& options);

/// Keeps the balls of standing feet where they are in the middle of their standing, `ball_m` above
/// the floor, by bending the legs; feet come to that place and leave it smoothly. Where a leg is
/// too short for that the pelvis sinks.
void StandOnFloor(const Model& model, const BodyMap& map, float ball_m,
                  const FootContacts& contacts, double frame_s, const RetargetOptions& options,
                  std::vector<NodeFrames>* poses);

}  // namespace aisle::sim
