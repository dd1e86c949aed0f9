#include "slam/track/both_cameras.h"

#include <set>

#include "slam/optimize/observations_of.h"

namespace aisle::slam {
namespace {

std::vector<PointObservation> WithRight(const PlainContext& context,
                                        std::vector<PointObservation> observations,
                                        const std::vector<Match>& right_matches) {
  if (!context.right) return observations;
  const auto right = ObservationsOf(context.map, *context.right, right_matches);
  observations.insert(observations.end(), right.begin(), right.end());
  return observations;
}

}  // namespace

PlainContext LeftAlone(const PlainContext& context) {
  return {context.map,     context.frame, context.camera, context.levels,
          context.options, nullptr,       context.masked};
}

std::vector<Match> MatchRight(const PlainContext& context, const std::vector<Expected>& expected,
                              const std::vector<Match>& matches, const MatchOptions& options) {
  if (!context.right) return {};
  std::set<LandmarkId> seen;
  for (const Match& match : matches) seen.insert(match.landmark);
  std::vector<Expected> hidden;
  for (const Expected& one : expected) {
    const double u = one.uvd.x() - one.uvd.z();
    if (u < 0 || seen.contains(one.landmark->id)) continue;
    hidden.push_back({one.landmark, {u, one.uvd.y(), 0}, one.level});
  }
  return MatchByProjection(*context.right, hidden, options);
}

std::vector<PointObservation> ObservationsOfBoth(const PlainContext& context,
                                                 const std::vector<Measurement>& measurements,
                                                 const std::vector<Match>& matches,
                                                 const std::vector<Match>& right_matches) {
  return WithRight(context, ObservationsOf(context.map, measurements, matches), right_matches);
}

std::vector<PointObservation> ObservationsOfBoth(const PlainContext& context,
                                                 const std::vector<Match>& matches,
                                                 const std::vector<Match>& right_matches) {
  return WithRight(context, ObservationsOf(context.map, context.frame, matches), right_matches);
}

std::vector<LandmarkId> InliersOfBoth(const std::vector<Match>& matches,
                                      const std::vector<Match>& right_matches,
                                      const RefinedPose& pose) {
  std::vector<LandmarkId> inliers;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (pose.inlier[i]) inliers.push_back(matches[i].landmark);
  }
  for (std::size_t i = 0; i < right_matches.size(); ++i) {
    if (pose.inlier[matches.size() + i]) inliers.push_back(right_matches[i].landmark);
  }
  return inliers;
}

}  // namespace aisle::slam
