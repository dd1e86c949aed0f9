#pragma once

#include <array>
#include <string_view>

#include "simulator/mesh/pose.h"
#include "simulator/motion/route.h"

namespace aisle::sim {

/// What a step of a person may play though its model has no clip of that name.
inline constexpr std::array<std::string_view, 2> kManners = {"kneel", "look_back"};

/// What a person does beside the clips that are played: each changes the skeleton in the object's
/// frame (x ahead, y to the left, z up), by the names of its nodes. A model without them is left as
/// posed.
class Manners {
 public:
  explicit Manners(const Model& model);

  /// Leans as it speeds up and into turns, by the angle of the apparent gravity, as bodies balance,
  /// whatever speed does within the 0.3 s before and after; and turns the head to where the way
  /// goes within the next 0.7 s, at most 40 degrees: gaze leads the body's turn (Grasso, Prevost,
  /// Ivanenko and Berthoz, Neurosci. Lett. 253, 1998).
  void Balance(const Route& route, double time_s, NodeFrames* frames) const;

  /// Looks over the right shoulder: `amount` from 0 to 1 is 75 degrees of the head and 30 of the
  /// trunk.
  void LookBack(double amount, NodeFrames* frames) const;

  /// Lurches over the right leg while it stands, as who spares it does (Trendelenburg's gait):
  /// `phase` is that of the walk cycle from the right leg's mid-stance, `amount` from 0 to 1.
  void Lurch(double phase, double amount, NodeFrames* frames) const;

  /// Kneels on the right knee, the left foot where it was: `amount` from 0, standing, to 1. The
  /// right foot steps back first, then the body goes down.
  void Kneel(double amount, NodeFrames* frames) const;

 private:
  void TurnAbout(int node, const Eigen::Vector3f& axis, double angle, NodeFrames* frames) const;

  const Model& model_;
  int pelvis_, spine_, chest_, neck_, head_;
  int thigh_right_, shin_right_, foot_right_, toes_right_;
  int thigh_left_, shin_left_, foot_left_;
};

/// From 0 to 1, clamped outside, smooth to the second derivative.
double SmoothStep(double t);

/// From 0 to 1 and back within a step: rises over `rise_s` from its start, falls as long before its
/// end, both smooth to the second derivative.
double Held(double elapsed_s, double duration_s, double rise_s);

}  // namespace aisle::sim
