#pragma once

#include <array>
#include <vector>

#include "simulator/mesh/capture/bvh.h"
#include "simulator/mesh/model.h"

namespace aisle::sim {

/// Parts of a body that both a recorded skeleton and a model have, each after the one it hangs on.
enum class BodyPart {
  kPelvis,
  kSpine,
  kChest,
  kNeck,
  kHead,
  kLeftClavicle,
  kLeftUpperArm,
  kLeftForearm,
  kLeftHand,
  kRightClavicle,
  kRightUpperArm,
  kRightForearm,
  kRightHand,
  kLeftThigh,
  kLeftShin,
  kLeftFoot,
  kLeftToes,
  kRightThigh,
  kRightShin,
  kRightFoot,
  kRightToes,
};
inline constexpr std::size_t kBodyParts = 21;

/// For each part the joint or node that moves it; -1 where there is none.
using BodyMap = std::array<int, kBodyParts>;

/// Finds a body in a recorded skeleton: its root is the pelvis; legs are chains of joints of one
/// side that hang on it, arms such chains further up, sides told by the names (left, l_, .L, ...);
/// what carries the arms is the chest. Throws ImportError naming what is missing: hips, knees,
/// ankles and a chest must be there.
BodyMap BodyOf(const Bvh& bvh);

/// The same of a model with the node names of assets/people: pelvis, spine, chest, thigh_left, ...
/// Throws ImportError likewise.
BodyMap BodyOf(const Model& model);

/// The part that a bone of this part leads to, by which its direction is told: the shin of a
/// thigh. -1: none.
int NextPart(BodyPart part);

}  // namespace aisle::sim
