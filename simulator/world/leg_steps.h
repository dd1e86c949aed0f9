#pragma once

#include <array>
#include <string>
#include <vector>

#include "simulator/mesh/pose.h"
#include "simulator/mesh/two_bone.h"

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

/// Where the foot is within a step, seen from the place it was planted at mid-stance.
struct FootMotion {
  Eigen::Vector2f way = Eigen::Vector2f::Zero();  ///< ankle, metres ahead and to the left
  float height_m = 0;                             ///< of the ankle
  float stride_m = 0;  ///< from this place to the next, as the mixed clips have it
  float swing = 0;     ///< 0 while it stands on this place, 1 once it stands on the next
};

/// How one leg steps in each walk, measured from the clips: from mid-stance to mid-stance.
class LegSteps {
 public:
  /// `walks` by rising stride. The leg's nodes are thigh_, shin_, foot_ + `side`; Exists() tells
  /// whether the model has them.
  LegSteps(const Model& model, const std::vector<WalkClip>& walks, int stand_clip,
           const std::string& side);

  bool Exists() const { return limb_.upper >= 0 && limb_.lower >= 0 && limb_.end >= 0; }
  const Limb& limb() const { return limb_; }
  /// Phase of the gait, in [0, 1), at which the foot is planted.
  double mid_stance() const { return mid_stance_; }

  /// The foot at `share` in [0, 1] of its step.
  FootMotion At(const WalkShares& shares, double share) const;
  /// Ankle under the body at mid-stance, object frame.
  Eigen::Vector2f PlantUnderBody(const WalkShares& shares) const;
  /// Ankle under the body when it just stands.
  Eigen::Vector2f Standing() const { return standing_.head<2>(); }
  /// Gives the toes the bend they have in another pose.
  void BendToes(const NodeFrames& like, NodeFrames* frames) const;
  /// Height of the sole's lowest point in a pose.
  float LowestSole(const Model& model, const NodeFrames& frames) const;

 private:
  static constexpr int kSamples = 128;
  struct Sample {
    Eigen::Vector3f ankle;  ///< from the ankle's place at mid-stance; z above the floor
    float swing = 0;
  };
  struct Curve {
    std::array<Sample, kSamples + 1> samples;
    Eigen::Vector2f under_body = Eigen::Vector2f::Zero();
    float stride_m = 0;
  };

  void FindSole(const Model& model);
  void FindMidStance(const Model& model, const WalkClip& walk);
  Curve Measure(const Model& model, const WalkClip& walk) const;

  Limb limb_;
  int toes_ = -1;
  std::vector<std::size_t> sole_;  ///< vertices
  double mid_stance_ = 0;
  std::vector<Curve> curves_;  ///< per walk
  Eigen::Vector3f standing_ = Eigen::Vector3f::Zero();
};

/// The phase, in [0, 1), in the middle of a time when both feet stand in the slowest walk: people
/// begin and end walking there. 0 when there are no two legs.
double RestPhase(const std::vector<LegSteps>& legs, std::size_t walks);

}  // namespace aisle::sim
