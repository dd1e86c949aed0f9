#pragma once

#include <array>
#include <memory>
#include <vector>

#include "simulator/mesh/two_bone.h"
#include "simulator/motion/gait.h"

namespace aisle::sim {

/// A clip of walking in place and the stride it was made for.
struct WalkClip {
  int clip = -1;
  double stride_m = 0;
  double duration_s = 1;
};

/// How much of standing and of each walk a pose holds; they sum to 1.
struct WalkShares {
  float stand = 1;
  std::vector<float> walks;
};

/// Standing and the walks (by rising stride) that enclose a stride, so mixed that their strides'
/// mean is that stride.
WalkShares SharesOf(const std::vector<WalkClip>& walks, double stride_m);

/// Keeps planted feet where they are. Mixing clips turns joints, and feet at the end of mixed
/// joints slide; here each foot is sent from one place on the floor to the next, as its clip moves
/// it from mid-stance to mid-stance, and the leg is solved to reach it. Places are fixed by where
/// the body is at mid-stance, so a walk at a clip's own speed stays as the clip has it, and feet
/// neither slide when the speed changes nor when the path turns.
class Footing {
 public:
  /// `walks` by rising stride. A model without legs of the usual names is left as posed.
  Footing(std::shared_ptr<const Model> model, Route route, Gait gait, std::vector<WalkClip> walks,
          int stand_clip, double natural_stride_m);

  /// Solves both legs of a pose (frames in the object's frame) at a time. `hold` in [0, 1]: how
  /// much the feet are held, 0 leaves the pose alone.
  void Apply(double time_s, float hold, NodeFrames* frames) const;

 private:
  static constexpr int kSamples = 64;

  /// A foot in one clip, from mid-stance to mid-stance.
  struct Curve {
    std::array<float, kSamples + 1> progress{};  ///< of the way to its next place, 0 to 1
    std::array<float, kSamples + 1> side{};      ///< y, object frame
    std::array<float, kSamples + 1> height{};    ///< z
    float ahead = 0;                             ///< x at mid-stance
  };
  /// Where the foot is planted, as the body was at its mid-stance.
  struct Plant {
    double time_s = 0;
    int step = 0;
    Eigen::Vector2d place = Eigen::Vector2d::Zero();
    double heading_rad = 0;
  };
  struct Leg {
    Limb limb;
    double mid_stance = 0;      ///< phase of the gait at which it is planted
    std::vector<Curve> curves;  ///< per walk
    Eigen::Vector3f standing = Eigen::Vector3f::Zero();
    std::vector<Plant> plants;  ///< by time
    Plant first, last;          ///< standing at either end of the route
    double first_share = 0;     ///< progress of the step it starts in
  };

  void FindCurves(Leg* leg) const;
  void PlantSteps(Leg* leg) const;
  Plant PlantAt(const Leg& leg, double time_s, int step) const;
  const Plant& Nearest(const Leg& leg, int step, double time_s) const;
  Eigen::Affine3f TargetOf(const Leg& leg, double time_s, const RouteState& body,
                           const Eigen::Affine3f& posed) const;
  double StepsTaken(const Leg& leg, double time_s) const;
  float ProgressOf(const Leg& leg, const WalkShares& shares, double share) const;

  std::shared_ptr<const Model> model_;
  Route route_;
  Gait gait_;
  std::vector<WalkClip> walks_;
  int stand_clip_;
  double natural_stride_m_;
  std::vector<Leg> legs_;
};

}  // namespace aisle::sim
