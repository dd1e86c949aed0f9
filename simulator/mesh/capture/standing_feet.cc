#include "simulator/mesh/capture/standing_feet.h"

#include <cmath>

#include "simulator/mesh/two_bone.h"

namespace aisle::sim {
namespace {

using Eigen::Affine3f, Eigen::Vector3f;

constexpr double kShortest_s = 0.1;
constexpr float kReach = 0.9995f;    ///< of a stretched leg
constexpr float kDeepest_m = 0.15f;  ///< that the pelvis sinks

struct Leg {
  Limb limb;
  int toes = -1;
};

Leg LegOf(const BodyMap& map, std::size_t side) {
  const auto thigh =
      static_cast<std::size_t>(side == 0 ? BodyPart::kLeftThigh : BodyPart::kRightThigh);
  return {{map[thigh], map[thigh + 1], map[thigh + 2]}, map[thigh + 3]};
}

const Affine3f& FrameOf(const NodeFrames& frames, int node) {
  return frames[static_cast<std::size_t>(node)];
}

float Smooth(float share) {
  const float t = std::clamp(share, 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

/// How far each frame's ball is to be moved: all the way while its foot stands, less and less
/// before and after.
std::vector<Vector3f> ShiftsOf(const std::vector<Vector3f>& balls, float ball_m,
                               const std::vector<std::array<std::size_t, 2>>& contacts,
                               double frame_s, double blend_s) {
  std::vector<Vector3f> sum(balls.size(), Vector3f::Zero());
  std::vector<float> weights(balls.size(), 0);
  const auto reach = static_cast<std::ptrdiff_t>(std::ceil(blend_s / frame_s));
  for (const auto& [first, last] : contacts) {
    Vector3f place = balls[(first + last) / 2];
    place.z() = ball_m;
    const auto from = static_cast<std::ptrdiff_t>(first), to = static_cast<std::ptrdiff_t>(last);
    for (std::ptrdiff_t k = std::max<std::ptrdiff_t>(0, from - reach);
         k <= std::min(std::ssize(balls) - 1, to + reach); ++k) {
      const std::ptrdiff_t outside = std::max({from - k, k - to, std::ptrdiff_t{0}});
      const float weight = Smooth(1 - static_cast<float>(outside) / static_cast<float>(reach + 1));
      const auto inside = static_cast<std::size_t>(std::clamp(k, from, to));
      const auto at = static_cast<std::size_t>(k);
      sum[at] += weight * (place - balls[inside]);
      weights[at] += weight;
    }
  }
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] /= std::max(1.0f, weights[k]);
  return sum;
}

/// How much the pelvis has to sink for a leg to reach its ankle's target.
float SinkFor(const NodeFrames& frames, const Limb& limb, const Vector3f& ankle) {
  const Vector3f hip = FrameOf(frames, limb.upper).translation();
  const Vector3f knee = FrameOf(frames, limb.lower).translation();
  const Vector3f end = FrameOf(frames, limb.end).translation();
  const float length = kReach * ((knee - hip).norm() + (end - knee).norm());
  const float aside = (ankle - hip).head<2>().norm();
  const float high = std::sqrt(std::max(0.0f, length * length - aside * aside));
  return std::clamp(hip.z() - ankle.z() - high, 0.0f, kDeepest_m);
}

/// Lowers a node and all that hangs on it.
void Sink(const Model& model, int top, float by_m, NodeFrames* frames) {
  std::vector<bool> below(model.nodes.size(), false);
  for (std::size_t i = static_cast<std::size_t>(top); i < below.size(); ++i) {
    const int parent = model.nodes[i].parent;
    below[i] =
        static_cast<int>(i) == top || (parent >= top && below[static_cast<std::size_t>(parent)]);
    if (below[i]) (*frames)[i] = Eigen::Translation3f(0, 0, -by_m) * (*frames)[i];
  }
}

}  // namespace

FootContacts FindContacts(const FootTracks& tracks, double frame_s,
                          const RetargetOptions& options) {
  FootContacts contacts;
  for (std::size_t side = 0; side < 2; ++side) {
    const std::vector<Eigen::Vector3d>& track = tracks[side];
    double lowest = track.front().z();
    for (const Eigen::Vector3d& place : track) lowest = std::min(lowest, place.z());
    std::size_t standing = 0;  // frames up to now
    for (std::size_t k = 0; k <= track.size(); ++k) {
      bool stands = false;
      if (k < track.size()) {
        const std::size_t before = k == 0 ? 0 : k - 1, after = std::min(k + 1, track.size() - 1);
        const double seconds = frame_s * static_cast<double>(after - before);
        const double speed = (track[after] - track[before]).norm() / seconds;
        stands = speed <= options.still_mps && track[k].z() <= lowest + options.low_m;
      }
      if (stands) ++standing;
      if (stands || standing == 0) continue;
      if (frame_s * static_cast<double>(standing) >= kShortest_s) {
        contacts[side].push_back({k - standing, k - 1});
      }
      standing = 0;
    }
  }
  return contacts;
}

void StandOnFloor(const Model& model, const BodyMap& map, float ball_m,
                  const FootContacts& contacts, double frame_s, const RetargetOptions& options,
                  std::vector<NodeFrames>* poses) {
  const std::array legs = {LegOf(map, 0), LegOf(map, 1)};
  std::array<std::vector<Vector3f>, 2> shifts;
  for (std::size_t side = 0; side < 2; ++side) {
    std::vector<Vector3f> balls;
    for (const NodeFrames& frames : *poses) {
      balls.emplace_back(FrameOf(frames, legs[side].toes).translation());
    }
    shifts[side] = ShiftsOf(balls, ball_m, contacts[side], frame_s, options.blend_s);
  }
  for (std::size_t k = 0; k < poses->size(); ++k) {
    NodeFrames& frames = (*poses)[k];
    std::array<Affine3f, 2> ankles;
    float sink = 0;
    for (std::size_t side = 0; side < 2; ++side) {
      ankles[side] = Eigen::Translation3f(shifts[side][k]) * FrameOf(frames, legs[side].limb.end);
      sink = std::max(sink, SinkFor(frames, legs[side].limb, ankles[side].translation()));
    }
    Sink(model, map[static_cast<std::size_t>(BodyPart::kPelvis)], sink, &frames);
    for (std::size_t side = 0; side < 2; ++side) {
      ReachFor(model, legs[side].limb, ankles[side], kReach, &frames);
    }
  }
}

}  // namespace aisle::sim
