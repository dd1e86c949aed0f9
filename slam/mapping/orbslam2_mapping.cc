#include "slam/mapping/orbslam2_mapping.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "slam/common/stopwatch.h"
#include "slam/map/fuse.h"
#include "slam/map/landmarks_of.h"
#include "slam/map/triangulate_landmarks.h"
#include "slam/map/two_views.h"

namespace aisle::slam {
namespace {

/// Landmarks go and come: those that `neighbours` keyframes help to place.
Map RenewLandmarks(Map map, KeyframeId newest, const MappingTools& tools,
                   const OrbSlam2MappingOptions& orbslam2, int neighbours) {
  TriangulateOptions triangulate = tools.options.triangulate;
  triangulate.neighbours = neighbours;
  map.Apply(OrbSlam2CullLandmarks(map, newest, orbslam2));
  MapEdit placed;
  placed.new_landmarks =
      TriangulateLandmarks(map, newest, FuseNeighbours(map, newest, tools.options.fuse),
                           tools.camera, triangulate, OrbSlam2Place(orbslam2.least_ray_sine));
  map.Apply(placed);
  return map;
}

/// Neighbours learn of the keyframe's landmarks, and it of theirs.
Map ExchangeLandmarks(Map map, KeyframeId newest, const MappingTools& tools,
                      const OrbSlam2MappingOptions& orbslam2) {
  const FuseOptions& fuse = tools.options.fuse;
  const std::vector<KeyframeId> neighbours = OrbSlam2FuseNeighbours(map, newest, fuse, orbslam2);
  for (const KeyframeId neighbour : neighbours) {
    map.Apply(FuseInto(map, neighbour, LandmarksOf(map, {newest}), tools.camera, tools.levels, fuse,
                       FuseBound::kChi2));
  }
  map.Apply(FuseInto(map, newest, LandmarksOf(map, neighbours), tools.camera, tools.levels, fuse,
                     FuseBound::kChi2));
  return map;
}

/// Adjusts around the keyframe; landmarks that lose too many observations by it go.
void Adjust(Map& map, KeyframeId newest, const MappingTools& tools,
            const OrbSlam2MappingOptions& orbslam2, int final_iterations) {
  LocalAdjustmentOptions options = tools.options.adjust;
  options.final_iterations = final_iterations;
  const Adjustment adjustment = AdjustLocally(map, newest, tools.camera, options);
  map.Apply(adjustment.edit);
  std::vector<LandmarkId> cut;
  for (const MapEdit::Link& link : adjustment.edit.cuts) cut.push_back(link.landmark);
  map.Apply(OrbSlam2DropUnsupported(map, cut, orbslam2));
}

/// Drops keyframes that are not needed; landmarks that lose too many observations by it go too.
std::vector<KeyframeId> DropKeyframes(Map& map, KeyframeId newest, const MappingTools& tools,
                                      const OrbSlam2MappingOptions& orbslam2) {
  const MapEdit culling = OrbSlam2CullKeyframes(map, newest, tools.camera, orbslam2);
  const std::vector<LandmarkId> seen = LandmarksOf(map, culling.removed_keyframes);
  map.Apply(culling);
  map.Apply(OrbSlam2DropUnsupported(map, seen, orbslam2));
  return culling.removed_keyframes;
}

/// How much of an adjustment is done.
enum class Extent { kWhole, kFirstPass, kNothing };

MappingResult AdjustAndDrop(Map map, KeyframeId newest, const MappingTools& tools,
                            const OrbSlam2MappingOptions& orbslam2, Extent extent) {
  constexpr std::size_t kLeastKeyframes = 3;  // two and what they see have nothing to be held by
  MappingResult result;
  if (extent != Extent::kNothing) {
    const int final_iterations =
        extent == Extent::kWhole ? tools.options.adjust.final_iterations : 0;
    if (map.keyframes().size() >= kLeastKeyframes) {
      Adjust(map, newest, tools, orbslam2, final_iterations);
    }
    result.culled = DropKeyframes(map, newest, tools, orbslam2);
  }
  LookForLoops(map, newest, tools, result);
  result.map = std::move(map);
  result.keyframe = newest;
  return result;
}

/// Measures how long the work takes; reported, never decided upon.
MappingStep::Work WithTime(MappingStep::Work work) {
  return [work = std::move(work)](Map map, KeyframeId newest, const MappingTools& tools) {
    double ms = 0;
    MappingResult result = Timed(ms, [&] { return work(std::move(map), newest, tools); });
    result.milliseconds = ms;
    return result;
  };
}

MappingResult ResultOf(Map map, KeyframeId newest) {
  MappingResult result;
  result.map = std::move(map);
  result.keyframe = newest;
  return result;
}

MappingStep::Work Renewing(const OrbSlam2MappingOptions& orbslam2, bool hurried) {
  return WithTime([orbslam2, hurried](Map map, KeyframeId newest, const MappingTools& tools) {
    const int neighbours = hurried ? 1 : tools.options.triangulate.neighbours;
    return ResultOf(RenewLandmarks(std::move(map), newest, tools, orbslam2, neighbours), newest);
  });
}

MappingStep::Work Exchanging(const OrbSlam2MappingOptions& orbslam2) {
  return WithTime([orbslam2](Map map, KeyframeId newest, const MappingTools& tools) {
    return ResultOf(ExchangeLandmarks(std::move(map), newest, tools, orbslam2), newest);
  });
}

MappingStep::Work Nothing() {
  return [](Map map, KeyframeId newest, const MappingTools&) {
    return ResultOf(std::move(map), newest);
  };
}

MappingStep::Work Adjusting(const OrbSlam2MappingOptions& orbslam2, Extent extent) {
  return WithTime([orbslam2, extent](Map map, KeyframeId newest, const MappingTools& tools) {
    return AdjustAndDrop(std::move(map), newest, tools, orbslam2, extent);
  });
}

}  // namespace

PlacePoint OrbSlam2Place(double least_ray_sine) {
  return [least_ray_sine](const TwoViews& views, std::size_t i,
                          std::size_t j) -> std::optional<Eigen::Vector3d> {
    // Half of it is half a baseline over the depth, hence half a disparity / f.
    const auto stereo_angle = [&](const Measurement& measurement) {
      return measurement.has_depth() ? 2 * std::atan2(measurement.uvd.z() / 2, views.camera.fx) : 0;
    };
    const double here = stereo_angle(views.Here(i)), there = stereo_angle(views.There(j));
    const Intersection meeting = Intersect(views, i, j);
    const double rays = std::asin(std::min(1.0, meeting.sine));
    if (rays > std::max({here, there, here + there > 0 ? 0 : least_ray_sine})) return meeting.point;
    if (here > there) return Backproject(views.camera, views.Here(i).uvd);
    if (there > 0) {
      return views.T_there_here.inverse() * Backproject(views.camera, views.There(j).uvd);
    }
    return std::nullopt;
  };
}

std::vector<KeyframeId> OrbSlam2FuseNeighbours(const Map& map, KeyframeId id,
                                               const FuseOptions& fuse,
                                               const OrbSlam2MappingOptions& options) {
  std::vector<KeyframeId> neighbours;
  std::set<KeyframeId> there = {id};
  const auto add = [&](KeyframeId one) {
    if (there.insert(one).second) neighbours.push_back(one);
  };
  FuseOptions of_each = fuse;
  of_each.neighbours = options.second_neighbours;
  for (const KeyframeId neighbour : FuseNeighbours(map, id, fuse)) {
    add(neighbour);
    for (const KeyframeId second : FuseNeighbours(map, neighbour, of_each)) add(second);
  }
  return neighbours;
}

MappingPolicy OrbSlam2Mapping(const OrbSlam2MappingOptions& options, int mapping_frames) {
  const int first = std::min(options.points_after_frames, mapping_frames);
  return {
      {first, Renewing(options, false), Renewing(options, true), first, nullptr},
      {0, Exchanging(options), Nothing(), 0, nullptr},
      {mapping_frames - first, Adjusting(options, Extent::kWhole),
       Adjusting(options, Extent::kNothing), 0, Adjusting(options, Extent::kFirstPass)},
  };
}

}  // namespace aisle::slam
