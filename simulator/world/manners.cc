#include "simulator/world/manners.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulator/mesh/two_bone.h"

namespace aisle::sim {
namespace {

using Eigen::Vector3f;

constexpr double kGravity_mps2 = 9.80665;
constexpr double kDegree = std::numbers::pi / 180;
constexpr double kGazeAhead_s = 0.7, kMostGaze_rad = 40 * kDegree;
constexpr int kGazes = 9;
constexpr double kSmooth_s = 0.3;  // bodies answer to a change of velocity so early and so late
constexpr double kLookHead_rad = 75 * kDegree, kLookTrunk_rad = 30 * kDegree;
constexpr double kLurch_rad = 9 * kDegree;
constexpr float kReach = 0.9985f;

}  // namespace

double SmoothStep(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * t * (t * (6 * t - 15) + 10);
}

double Held(double elapsed_s, double duration_s, double rise_s) {
  return SmoothStep(elapsed_s / rise_s) * SmoothStep((duration_s - elapsed_s) / rise_s);
}

Manners::Manners(const Model& model)
    : model_(model),
      pelvis_(model.FindNode("pelvis")),
      spine_(model.FindNode("spine")),
      chest_(model.FindNode("chest")),
      neck_(model.FindNode("neck")),
      head_(model.FindNode("head")),
      thigh_right_(model.FindNode("thigh_right")),
      shin_right_(model.FindNode("shin_right")),
      foot_right_(model.FindNode("foot_right")),
      toes_right_(model.FindNode("toes_right")),
      thigh_left_(model.FindNode("thigh_left")),
      shin_left_(model.FindNode("shin_left")),
      foot_left_(model.FindNode("foot_left")) {}

/// Turns a node and all that hangs on it about an axis of the object through the node.
void Manners::TurnAbout(int node, const Vector3f& axis, double angle, NodeFrames* frames) const {
  if (node < 0 || angle == 0) return;
  const Vector3f at = (*frames)[static_cast<std::size_t>(node)].translation();
  const Eigen::Affine3f turn = Eigen::Translation3f(at) *
                               Eigen::AngleAxisf(static_cast<float>(angle), axis) *
                               Eigen::Translation3f(-at);
  MoveSubtree(model_, node, turn, frames);
}

void Manners::Balance(const Route& route, double time_s, NodeFrames* frames) const {
  const RouteState now = route.At(time_s);
  // The second difference of the way is the mean of the acceleration under a triangle, exactly: it
  // has no steps where a route changes its acceleration at once, as a crowd's do.
  const Eigen::Vector2d mean = (route.At(time_s + kSmooth_s).position - 2 * now.position +
                                route.At(time_s - kSmooth_s).position) /
                               (kSmooth_s * kSmooth_s);
  const Eigen::Vector2d felt = Eigen::Rotation2Dd(-now.heading_rad) * mean;
  const double pitch = std::atan(felt.x() / kGravity_mps2);
  const double roll = std::atan(felt.y() / kGravity_mps2);
  const double half = 0.5;  // of it in the legs' and half in the trunk's bend
  TurnAbout(pelvis_, Vector3f::UnitX(), -half * roll, frames);
  TurnAbout(spine_, Vector3f::UnitY(), pitch, frames);
  TurnAbout(spine_, Vector3f::UnitX(), -half * roll, frames);
  double gaze = 0;
  for (int i = 0; i < kGazes; ++i) {
    const double ahead = kGazeAhead_s * (i + 0.5) / kGazes * 2;
    gaze += (route.At(time_s + ahead).heading_rad - now.heading_rad) / kGazes;
  }
  gaze = std::clamp(gaze, -kMostGaze_rad, kMostGaze_rad);
  TurnAbout(chest_, Vector3f::UnitZ(), 0.25 * gaze, frames);
  TurnAbout(neck_, Vector3f::UnitZ(), 0.35 * gaze, frames);
  TurnAbout(head_, Vector3f::UnitZ(), 0.4 * gaze, frames);
  // The eyes stay level.
  TurnAbout(head_, Vector3f::UnitY(), -0.7 * pitch, frames);
  TurnAbout(head_, Vector3f::UnitX(), 0.8 * roll, frames);
}

void Manners::LookBack(double amount, NodeFrames* frames) const {
  TurnAbout(spine_, Vector3f::UnitZ(), -0.5 * amount * kLookTrunk_rad, frames);
  TurnAbout(chest_, Vector3f::UnitZ(), -0.5 * amount * kLookTrunk_rad, frames);
  TurnAbout(neck_, Vector3f::UnitZ(), -0.45 * amount * kLookHead_rad, frames);
  TurnAbout(head_, Vector3f::UnitZ(), -0.55 * amount * kLookHead_rad, frames);
}

void Manners::Lurch(double phase, double amount, NodeFrames* frames) const {
  // Most over mid-stance, to the right: about x, left side up.
  const double lean = amount * kLurch_rad * std::max(0.0, std::cos(2 * std::numbers::pi * phase));
  TurnAbout(spine_, Vector3f::UnitX(), lean, frames);
  TurnAbout(head_, Vector3f::UnitX(), -0.7 * lean, frames);
}

void Manners::Kneel(double amount, NodeFrames* frames) const {
  if (amount <= 0 || std::min({pelvis_, thigh_left_, shin_left_, foot_left_, thigh_right_,
                               shin_right_, foot_right_}) < 0) {
    return;
  }
  const auto at = [&](int node) { return (*frames)[static_cast<std::size_t>(node)].translation(); };
  const Eigen::Affine3f left = (*frames)[static_cast<std::size_t>(foot_left_)];
  Eigen::Affine3f right = (*frames)[static_cast<std::size_t>(foot_right_)];
  const float thigh = (at(shin_right_) - at(thigh_right_)).norm();
  const float shin = (at(foot_right_) - at(shin_right_)).norm();
  constexpr float kKneeRadius = 0.065f;  // m: of the knee on the floor
  constexpr float kAnkleUp = 0.13f;      // m: over toes that bear on the floor

  const auto back = static_cast<float>(SmoothStep(amount / 0.55));
  const auto down = static_cast<float>(SmoothStep((amount - 0.25) / 0.75));
  // The right hip ends over the knee, and that as far behind the left foot as a thigh is long.
  const Vector3f hip = at(thigh_right_);
  const float hip_down = hip.z() - (thigh + kKneeRadius);
  const float hip_back = 0.85f * thigh;
  const Eigen::Affine3f lowered(Eigen::Translation3f(-down * hip_back, 0, -down * hip_down));
  MoveSubtree(model_, pelvis_, lowered, frames);
  TurnAbout(spine_, Vector3f::UnitY(), down * 18 * kDegree, frames);

  const float foot_x = hip.x() - hip_back - 0.94f * shin;
  const float lift = 0.09f * 4 * back * (1 - back);
  right.translation().x() += back * (foot_x - right.translation().x());
  right.translation().z() += lift + back * (kAnkleUp - right.translation().z());
  const float heel_up = back * static_cast<float>(58 * kDegree);
  right.linear() = Eigen::AngleAxisf(heel_up, Vector3f::UnitY()) * right.linear();
  ReachFor(model_, {thigh_left_, shin_left_, foot_left_}, left, kReach, frames);
  ReachFor(model_, {thigh_right_, shin_right_, foot_right_}, right, kReach, frames);
  // The toes lie flat while the heel is up.
  TurnAbout(toes_right_, Vector3f::UnitY(), -heel_up, frames);
}

}  // namespace aisle::sim
