#include "simulator/shade/light/shared_visibility.h"

#include "simulator/common/parallel.h"
#include "simulator/shade/light/direct_light.h"

namespace aisle::sim {
namespace {

std::vector<float> UnshadowedOf(std::span<const SurfacePoint> places,
                                std::span<const AreaLight> lights,
                                std::span<const float> light_scale) {
  std::vector<float> light(places.size());
  ParallelFor(std::size_t{0}, (places.size() + kLanes - 1) / kLanes, [&](std::size_t packet) {
    const std::size_t first = packet * kLanes;
    const std::size_t count = std::min<std::size_t>(kLanes, places.size() - first);
    const auto these = UnshadowedLight(lights, light_scale, places.subspan(first, count));
    for (std::size_t k = 0; k < count; ++k) light[first + k] = these[k];
  });
  return light;
}

/// Of each group the point with most light to lose, the first of equals, by the group's leader.
std::vector<std::uint32_t> BrightestOf(std::span<const std::uint32_t> leaders,
                                       std::span<const float> light) {
  std::vector<std::uint32_t> brightest(leaders.begin(), leaders.end());
  for (std::uint32_t i = 0; i < leaders.size(); ++i) {
    std::uint32_t& best = brightest[leaders[i]];
    if (light[i] > light[best]) best = i;
  }
  return brightest;
}

}  // namespace

std::vector<float> SharedVisibility::Spread(std::span<const float> traced_light) const {
  std::vector<float> light(of_point.size());
  for (std::size_t i = 0; i < light.size(); ++i) light[i] = share[i] * traced_light[of_point[i]];
  return light;
}

SharedVisibility ShareVisibility(std::span<const std::uint32_t> things,
                                 std::span<const SurfacePoint> places,
                                 std::span<const AreaLight> lights,
                                 std::span<const float> light_scale) {
  std::vector<std::uint32_t> loose, loose_things;
  std::vector<SurfacePoint> loose_places;
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    if (things[i] == kFixed) continue;
    loose.push_back(i);
    loose_things.push_back(things[i]);
    loose_places.push_back(places[i]);
  }
  const std::vector<float> light = UnshadowedOf(loose_places, lights, light_scale);
  const std::vector<std::uint32_t> leaders = GroupsOfThings(loose_places, loose_things);
  const std::vector<std::uint32_t> brightest = BrightestOf(leaders, light);

  SharedVisibility shared;
  shared.of_point.resize(places.size());
  shared.share.assign(places.size(), 1);
  const auto trace = [&](std::uint32_t point) {
    shared.of_point[point] = static_cast<std::uint32_t>(shared.traced.size());
    shared.traced.push_back(point);
  };
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    if (things[i] == kFixed) trace(i);
  }
  shared.fixed = shared.traced.size();
  for (std::uint32_t k = 0; k < loose.size(); ++k) {
    if (brightest[leaders[k]] == k) trace(loose[k]);
  }
  for (std::size_t k = 0; k < loose.size(); ++k) {
    const std::uint32_t of = brightest[leaders[k]];
    shared.of_point[loose[k]] = shared.of_point[loose[of]];
    shared.share[loose[k]] = light[of] > 0 ? light[k] / light[of] : 0;
  }
  return shared;
}

}  // namespace aisle::sim
