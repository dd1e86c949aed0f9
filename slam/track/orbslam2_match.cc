#include "slam/track/orbslam2_match.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace aisle::slam {
namespace {

constexpr int kSectors = 12;

std::size_t SectorOf(float turn_deg) {
  const auto sector = std::lround(turn_deg * (static_cast<float>(kSectors) / 360)) % kSectors;
  return static_cast<std::size_t>(sector < 0 ? sector + kSectors : sector);
}

/// Whether a feature with depth lies too far from where the right camera should see the landmark.
bool IsOffInRightImage(const Measurement& measurement, const Sought& sought) {
  if (!measurement.has_depth()) return false;
  const double measured = measurement.uvd.x() - measurement.uvd.z();
  return std::abs(measured - (sought.uvd.x() - sought.uvd.z())) > sought.radius_px;
}

Match BestFeature(const Frame& frame, const Sought& sought, int distance, double ratio,
                  const std::vector<bool>& taken) {
  const cv::Point2f pixel(static_cast<float>(sought.uvd.x()), static_cast<float>(sought.uvd.y()));
  Match best{sought.landmark->id, -1, 257};
  int second = 257, best_level = -1, second_level = -1;
  for (const int candidate : frame.grid.Near(pixel, static_cast<float>(sought.radius_px),
                                             sought.lowest, sought.highest)) {
    const auto i = static_cast<std::size_t>(candidate);
    if (taken[i] || IsOffInRightImage(frame.measurements[i], sought)) continue;
    const int bits = HammingDistance(sought.landmark->descriptor, frame.features.descriptors[i]);
    const int level = frame.features.keypoints[i].level;
    if (bits < best.distance) {
      second = best.distance, second_level = best_level;
      best.feature = candidate, best.distance = bits, best_level = level;
    } else if (bits < second) {
      second = bits, second_level = level;
    }
  }
  const bool rivalled = second_level == best_level && best.distance > ratio * second;
  if (best.distance > distance || rivalled) best.feature = -1;
  return best;
}

}  // namespace

int PredictLevelAbove(const Landmark& landmark, double distance_m, double scale, int levels) {
  const double steps = std::log(landmark.reference_distance_m / distance_m) / std::log(scale);
  return std::clamp(static_cast<int>(std::ceil(landmark.reference_level + steps)), 0, levels - 1);
}

std::vector<Match> MatchInTurn(const Frame& frame, std::span<const Sought> sought, int distance,
                               double ratio, std::vector<bool>& taken) {
  std::vector<Match> matches;
  for (const Sought& one : sought) {
    const Match match = BestFeature(frame, one, distance, ratio, taken);
    if (match.feature < 0) continue;
    taken[static_cast<std::size_t>(match.feature)] = true;
    matches.push_back(match);
  }
  return matches;
}

std::vector<Match> KeepCommonTurns(const std::vector<Match>& matches,
                                   const std::vector<float>& turns_deg) {
  std::array<int, kSectors> counts{};
  for (const float turn : turns_deg) ++counts[SectorOf(turn)];
  std::array<int, kSectors> ranked = counts;
  std::ranges::sort(ranked, std::greater<>());
  const int least = std::max(ranked[2], (ranked[0] + 9) / 10);
  std::vector<Match> kept;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (counts[SectorOf(turns_deg[i])] >= std::max(least, 1)) kept.push_back(matches[i]);
  }
  return kept;
}

}  // namespace aisle::slam
