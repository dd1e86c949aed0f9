#include "slam/map/landmark_view.h"

#include <algorithm>
#include <cmath>

namespace aisle::slam {
namespace {

/// More observations than this tell nothing new of how a landmark looks.
constexpr std::size_t kDescriptorsCompared = 12;

const Descriptor& DescriptorOf(const Map& map, const Observation& observation) {
  return map.At(observation.keyframe)
      .frame->features.descriptors[static_cast<std::size_t>(observation.feature)];
}

/// The descriptor whose median distance to the others is least, the earlier one on a tie.
Descriptor MedoidDescriptor(const Map& map, const Landmark& landmark) {
  std::vector<const Descriptor*> descriptors;
  const std::size_t count = landmark.observations.size();
  const std::size_t stride = (count + kDescriptorsCompared - 1) / kDescriptorsCompared;
  for (std::size_t i = 0; i < count; i += stride) {
    descriptors.push_back(&DescriptorOf(map, landmark.observations[i]));
  }
  int least = 257;
  const Descriptor* medoid = descriptors.front();
  std::vector<int> distances(descriptors.size());
  for (const Descriptor* one : descriptors) {
    std::transform(descriptors.begin(), descriptors.end(), distances.begin(),
                   [one](const Descriptor* other) { return HammingDistance(*one, *other); });
    const auto middle = distances.begin() + std::ssize(distances) / 2;
    std::nth_element(distances.begin(), middle, distances.end());
    if (*middle < least) least = *middle, medoid = one;
  }
  return *medoid;
}

}  // namespace

void RefreshView(const Map& map, Landmark& landmark) {
  landmark.descriptor = MedoidDescriptor(map, landmark);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Observation& observation : landmark.observations) {
    const Keyframe& keyframe = map.At(observation.keyframe);
    sum += (landmark.position - keyframe.T_world_rig.translation()).normalized();
  }
  landmark.normal = sum.squaredNorm() > 0 ? Eigen::Vector3d(sum.normalized()) : sum;
  const Observation& reference = landmark.observations.front();
  const Keyframe& keyframe = map.At(reference.keyframe);
  landmark.reference_distance_m = (landmark.position - keyframe.T_world_rig.translation()).norm();
  landmark.reference_level =
      keyframe.frame->features.keypoints[static_cast<std::size_t>(reference.feature)].level;
}

int PredictLevel(const Landmark& landmark, double distance_m, double scale, int levels) {
  const double steps = std::log(landmark.reference_distance_m / distance_m) / std::log(scale);
  const double level = landmark.reference_level + steps;
  return std::clamp(static_cast<int>(std::lround(level)), 0, levels - 1);
}

bool CanBeSeenFrom(const Landmark& landmark, const Eigen::Vector3d& centre, double scale,
                   int levels) {
  const Eigen::Vector3d ray = landmark.position - centre;
  const double distance = ray.norm();
  // Nearest where the top level fits, farthest where the bottom one does, with a fifth to spare.
  const double farthest = landmark.reference_distance_m * std::pow(scale, landmark.reference_level);
  const double nearest = farthest * std::pow(scale, -(levels - 1));
  if (distance > 1.2 * farthest || distance < 0.8 * nearest) return false;
  return ray.dot(landmark.normal) >= 0.5 * distance;
}

}  // namespace aisle::slam
