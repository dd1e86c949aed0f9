#pragma once

#include <memory>
#include <vector>

#include "simulator/motion/gait.h"
#include "simulator/world/leg_steps.h"

namespace aisle::sim {

/// Keeps planted feet where they are. Mixing clips turns joints, and feet at the end of mixed
/// joints slide; here each foot has a place and a heading on the floor for every stance, rolls over
/// it as its clips do (heel, sole, toes), and swings from one to the next; the legs are solved to
/// follow. Places are fixed by where the body is at mid-stance, so on a straight way at a clip's
/// own speed the feet move as the clip has them, and they stay when the speed changes or the path
/// turns.
class Footing {
 public:
  /// `walks` by rising stride. A model without legs of the usual names is left as posed.
  Footing(std::shared_ptr<const Model> model, Route route, std::vector<WalkClip> walks,
          int stand_clip, const GaitStyle& style);

  /// The walk cycle over time; it begins and ends every walk with both feet on the floor.
  const Gait& gait() const { return gait_; }

  /// Solves both legs of a pose (frames in the object's frame) at a time; the feet roll as in the
  /// pose of plain walking.
  void Apply(double time_s, const NodeFrames& walking, NodeFrames* frames) const;

 private:
  /// A stance: where the foot is planted at its mid-stance.
  struct Plant {
    double time_s = 0;
    int step = 0;
    Eigen::Vector2d place = Eigen::Vector2d::Zero();
    double heading_rad = 0;
  };
  struct Leg {
    LegSteps steps;
    std::vector<Plant> plants;  ///< by time; neighbours differ in their step
  };

  void PlantSteps(Leg* leg) const;
  Plant PlantAt(const Leg& leg, double time_s, int step) const;
  Plant StandAt(const Leg& leg, double time_s) const;
  Eigen::Affine3f AnkleOf(const Leg& leg, double time_s, const Eigen::Affine3f& posed) const;
  double StepsTaken(const Leg& leg, double time_s) const;
  WalkShares SharesAt(double time_s) const;
  void LowerToReach(const std::vector<Eigen::Affine3f>& ankles, NodeFrames* frames) const;

  std::shared_ptr<const Model> model_;
  Route route_;
  std::vector<WalkClip> walks_;
  double natural_stride_m_ = 0;
  Gait gait_;
  std::vector<Leg> legs_;
};

}  // namespace aisle::sim
