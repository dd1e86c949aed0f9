#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "simulator/motion/joint.h"
#include "simulator/scene/given_key.h"
#include "simulator/scene/kinds.h"
#include "simulator/scene/mark.h"

namespace aisle::sim {

/// What a part of a mechanism looks like.
enum class PartShape {
  kBox,
  kCylinder,  ///< along z, its middle at the centre
  kLink,      ///< of a chain: a ring, longer in z
  kModel,     ///< of assets/kit or assets/street
  kPallet,    ///< with goods on it, standing on the centre
};

enum class PartPaint {
  kSteel,
  kWood,
  kCarton,
  kWrap,
  kStripes,
  kTote,
  kDoor,
  kWall,
  kWhite,
  kDark,
  kFilm,   ///< metallised stretch film: mirrors half of the light
  kGlass,  ///< clear film or sheet: one sees through it
  kGlow,   ///< a lamp's lens
};

/// What labels call it.
enum class MechanismClass { kFurniture, kGoods, kWall };

/// One part, or several alike. Angles are radians here and degrees in the file.
struct PartSpec {
  Mark mark, model_mark;
  std::string name;  ///< what others are `on`; may be empty
  std::string on;    ///< the part it is fixed to; empty: the mechanism itself
  PartShape shape = PartShape::kBox;
  PartPaint paint = PartPaint::kSteel;
  std::string model;
  double goods_m = 1;                                       ///< of a pallet: height of its goods
  GoodsKind goods = GoodsKind::kCartons;                    ///< of a pallet
  Eigen::Vector3d size_m = Eigen::Vector3d::Constant(0.1);  ///< box; cylinder, link: the box around
  Eigen::Vector3d at_m = Eigen::Vector3d::Zero();           ///< the joint, in what it is on
  double heading_rad = 0;                                   ///< of the joint's frame, about z
  double roll_rad = 0;                                      ///< of it about x, after that
  Eigen::Vector3d center_m = Eigen::Vector3d::Zero();       ///< the shape, in the joint's frame
  int count = 1;                                            ///< copies
  Eigen::Vector3d step_m = Eigen::Vector3d::Zero();         ///< from copy to copy
  double delay_s = 0;                                       ///< by which each copy is later
  Joint joint;
  /// Keys that stand in the file, of those that not every kind of joint or shape has.
  std::vector<GivenKey> joint_given, shape_given;
};

/// A vehicle's forks have it between two times; then it stays where it was put.
struct TakenSpec {
  Mark mark;
  std::string by;  ///< a vehicle with forks
  double at_s = 0;
  double until_s = 1e9;
};

/// Something that is moved by joints, by people or by a fork: a door, a chain, a conveyor, a
/// trolley, a long box. Below its level it stands still, or stays away where people bring it.
struct MechanismSpec {
  Mark mark;
  std::size_t place = 0;  ///< in the file's list
  std::string name;
  MechanismClass object_class = MechanismClass::kFurniture;
  Dynamics level = Dynamics::kLow;
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  double above_m = 0;
  double heading_rad = 0;
  std::vector<PartSpec> parts;
  std::string pushed_by;          ///< a person; its frame is then before that one's hands
  double reach_m = 0;             ///< from those hands to its origin
  std::string front_by, rear_by;  ///< two people who carry it by its ends
  std::vector<TakenSpec> taken;   ///< in the order of their times
  bool still = false;             ///< it never moves: the scene is calmer than its level

  bool IsBrought() const { return !pushed_by.empty() || !front_by.empty(); }
};

}  // namespace aisle::sim
