#include "simulator/world/leg_steps.h"

#include <algorithm>
#include <cmath>

namespace aisle::sim {
namespace {

/// Soles lower than this carry weight; the same bound tests use to call a foot planted.
constexpr float kContact_m = 0.006f;

/// Vertices of a shoe this low in the rest pose are its sole.
constexpr float kSole_m = 0.03f;

NodeFrames FramesAt(const Model& model, int clip, double time_s) {
  const PoseLayer layer{clip, time_s, 1, -1};
  return PoseNodes(model, {&layer, 1});
}

float SmoothStep(float t) { return t * t * t * (t * (6 * t - 15) + 10); }

}  // namespace

WalkShares SharesOf(const std::vector<WalkClip>& walks, double stride_m) {
  WalkShares shares;
  shares.walks.assign(walks.size(), 0.0f);
  shares.stand = 0;
  const auto above =
      std::ranges::find_if(walks, [&](const WalkClip& walk) { return walk.stride_m > stride_m; });
  const auto index = static_cast<std::size_t>(above - walks.begin());
  if (above == walks.end()) {
    shares.walks.back() = 1;
    return shares;
  }
  const double low = index == 0 ? 0 : walks[index - 1].stride_m;
  const float share = static_cast<float>((stride_m - low) / (above->stride_m - low));
  shares.walks[index] = share;
  (index == 0 ? shares.stand : shares.walks[index - 1]) = 1 - share;
  return shares;
}

LegSteps::LegSteps(const Model& model, const std::vector<WalkClip>& walks, int stand_clip,
                   const std::string& side)
    : limb_{model.FindNode("thigh_" + side), model.FindNode("shin_" + side),
            model.FindNode("foot_" + side)},
      toes_(model.FindNode("toes_" + side)) {
  if (!Exists()) return;
  FindSole(model);
  FindMidStance(model, walks.back());
  for (const WalkClip& walk : walks) curves_.push_back(Measure(model, walk));
  standing_ = FramesAt(model, stand_clip, 0)[static_cast<std::size_t>(limb_.end)].translation();
}

void LegSteps::FindSole(const Model& model) {
  for (std::size_t i = 0; i < model.weights.size(); ++i) {
    const int node = model.joints[model.weights[i].joints[0]].node;
    if ((node == limb_.end || node == toes_) && model.mesh.positions[i].z() < kSole_m) {
      sole_.push_back(i);
    }
  }
}

void LegSteps::BendToes(const NodeFrames& like, NodeFrames* frames) const {
  if (toes_ < 0) return;
  const auto foot = static_cast<std::size_t>(limb_.end), toes = static_cast<std::size_t>(toes_);
  (*frames)[toes] = (*frames)[foot] * like[foot].inverse() * like[toes];
}

float LegSteps::LowestSole(const Model& model, const NodeFrames& frames) const {
  float lowest = std::numeric_limits<float>::infinity();
  for (const std::size_t i : sole_) {
    const VertexWeights& carried = model.weights[i];
    float height = 0;
    for (std::size_t k = 0; k < carried.joints.size() && carried.weights[k] > 0; ++k) {
      const ModelJoint& joint = model.joints[carried.joints[k]];
      const Eigen::Vector3f in_node = joint.bind_to_node * model.bind_positions[i];
      height += carried.weights[k] * (frames[static_cast<std::size_t>(joint.node)] * in_node).z();
    }
    lowest = std::min(lowest, height);
  }
  return lowest;
}

/// Mid-stance is where the foot is stillest over the floor.
void LegSteps::FindMidStance(const Model& model, const WalkClip& walk) {
  constexpr double kPhase = 1.0 / kSamples;
  const auto over_floor = [&](double phase) {
    Eigen::Vector3f ankle =
        FramesAt(model, walk.clip, phase * walk.duration_s)[static_cast<std::size_t>(limb_.end)]
            .translation();
    ankle.x() += static_cast<float>(walk.stride_m * phase);
    return ankle;
  };
  float stillest = std::numeric_limits<float>::infinity();
  for (int i = 0; i < kSamples; ++i) {
    const float way = (over_floor((i + 1) * kPhase) - over_floor((i - 1) * kPhase)).norm();
    if (way < stillest) {
      stillest = way;
      mid_stance_ = i * kPhase;
    }
  }
}

LegSteps::Curve LegSteps::Measure(const Model& model, const WalkClip& walk) const {
  Curve curve;
  curve.stride_m = static_cast<float>(walk.stride_m);
  std::array<bool, kSamples + 1> planted{};
  for (std::size_t i = 0; i <= kSamples; ++i) {
    const double share = static_cast<double>(i) / kSamples;
    const NodeFrames frames = FramesAt(model, walk.clip, (mid_stance_ + share) * walk.duration_s);
    planted[i] = LowestSole(model, frames) < kContact_m;
    curve.samples[i].ankle = frames[static_cast<std::size_t>(limb_.end)].translation();
    if (i == 0) curve.under_body = curve.samples[0].ankle.head<2>();
    curve.samples[i].ankle.head<2>() -= curve.under_body;
    curve.samples[i].ankle.x() += static_cast<float>(walk.stride_m * share);
  }
  // It swings from when its toes leave the floor until its heel strikes.
  const auto leave = std::find(planted.begin(), planted.end(), false);
  const auto strike = std::find(planted.rbegin(), planted.rend(), false).base();
  const auto off = static_cast<float>(leave - planted.begin());
  const auto on = std::max(static_cast<float>(strike - planted.begin()), off + 1);
  for (std::size_t i = 0; i <= kSamples; ++i) {
    const float t = (static_cast<float>(i) - off) / (on - off);
    curve.samples[i].swing = SmoothStep(std::clamp(t, 0.0f, 1.0f));
  }
  return curve;
}

FootMotion LegSteps::At(const WalkShares& shares, double share) const {
  const double at = share * kSamples;
  const std::size_t low = std::min(static_cast<std::size_t>(at), std::size_t{kSamples - 1});
  const float t = static_cast<float>(at - static_cast<double>(low));
  FootMotion motion;
  motion.height_m = shares.stand * standing_.z();
  float walking = 0;
  for (std::size_t i = 0; i < curves_.size(); ++i) {
    const float weight = shares.walks[i];
    const Sample& before = curves_[i].samples[low];
    const Sample& after = curves_[i].samples[low + 1];
    const Eigen::Vector3f ankle = before.ankle + t * (after.ankle - before.ankle);
    motion.way += weight * ankle.head<2>();
    motion.height_m += weight * ankle.z();
    motion.stride_m += weight * curves_[i].stride_m;
    motion.swing += weight * (before.swing + t * (after.swing - before.swing));
    walking += weight;
  }
  const Sample& slowest = curves_.front().samples[low];
  motion.swing = walking > 1e-4f ? motion.swing / walking : slowest.swing;
  return motion;
}

Eigen::Vector2f LegSteps::PlantUnderBody(const WalkShares& shares) const {
  Eigen::Vector2f offset = shares.stand * Standing();
  for (std::size_t i = 0; i < curves_.size(); ++i) {
    offset += shares.walks[i] * curves_[i].under_body;
  }
  return offset;
}

double RestPhase(const std::vector<LegSteps>& legs, std::size_t walks) {
  if (legs.size() < 2 || walks == 0) return 0;
  constexpr int kPhases = 256;
  WalkShares slowest{0, std::vector<float>(walks, 0.0f)};
  slowest.walks.front() = 1;
  const auto both_stand = [&](int i) {
    return std::ranges::all_of(legs, [&](const LegSteps& leg) {
      const double steps = static_cast<double>(i % kPhases) / kPhases - leg.mid_stance();
      const float swing = leg.At(slowest, steps - std::floor(steps)).swing;
      return swing <= 0 || swing >= 1;
    });
  };
  int longest = 0, run = 0, middle = 0;
  for (int i = 0; i < 2 * kPhases; ++i) {
    run = both_stand(i) ? run + 1 : 0;
    if (run > longest && run <= kPhases) {
      longest = run;
      middle = i - run / 2;
    }
  }
  return static_cast<double>(middle % kPhases) / kPhases;
}

}  // namespace aisle::sim
