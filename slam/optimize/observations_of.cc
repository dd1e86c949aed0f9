#include "slam/optimize/observations_of.h"

namespace aisle::slam {

std::vector<PointObservation> ObservationsOf(const Map& map, const Frame& frame,
                                             const std::vector<Match>& matches) {
  std::vector<PointObservation> observations;
  for (const Match& match : matches) {
    observations.push_back({map.At(match.landmark).position,
                            frame.measurements[static_cast<std::size_t>(match.feature)]});
  }
  return observations;
}

std::vector<PointObservation> ObservationsOf(const Map& map,
                                             const std::vector<Measurement>& measurements,
                                             const std::vector<Match>& matches) {
  std::vector<PointObservation> observations;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    observations.push_back({map.At(matches[i].landmark).position, measurements[i]});
  }
  return observations;
}

}  // namespace aisle::slam
