#pragma once

#include <optional>

#include "slam/track/prior_map.h"
#include "slam/track/relocalise.h"
#include "slam/track/track_frame.h"

namespace aisle::slam {

/// Finds a frame whose way from the last one is measured: landmarks are looked for around where
/// that leads, those vote that agree with it, and it counts itself. A pose that contradicts it is
/// that of something that moves, and is not believed, however many points it explains. Where the
/// left camera does not convince, both are asked; where nothing is found around there, keyframes
/// are asked by their looks, under the same test. TrackMemory::measured must be there. Nothing
/// where the images do not tell.
std::optional<FramePose> TrackMeasured(const PlainContext& context, const TrackMemory& memory,
                                       const Places& places, std::int64_t turn);

/// The same where landmarks of a prior map have told where the frame stands. Nothing where the
/// others do not agree with that.
std::optional<FramePose> TrackInPriorMap(const PlainContext& context, const TrackMemory& memory,
                                         const PoseInPriorMap& told);

/// Finds the frame in the map as TrackFrame does; in a pose that convinces the rig's inertia counts
/// as one more observation where in some direction it knows more than the images. One that explains
/// too little of what is in view must be where inertia can have carried it, and contends with what
/// both cameras find by looking there, as if inertia were a measurement: who explains more is
/// believed. While there is no velocity, and what is carried is what the images have shown of the
/// rig's motion, no pose may contradict it. Nothing if neither finds it.
std::optional<FramePose> TrackCarried(const PlainContext& context, const TrackMemory& memory,
                                      const Places& places, std::int64_t turn);

}  // namespace aisle::slam
