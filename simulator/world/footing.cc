#include "simulator/world/footing.h"

#include <algorithm>
#include <cmath>

namespace aisle::sim {
namespace {

/// Legs are never quite stretched: a straight knee would jitter.
constexpr float kReach = 0.9985f;

/// Before that they stretch ever more slowly, from so much less than their reach on: the nearer to
/// straight, the further a knee goes for each bit of the leg's length.
constexpr float kYield_m = 0.008f;

/// How far a leg is stretched that is asked to be so long.
float Stretched(float length_m, float reach_m) {
  const float beyond = (length_m - reach_m) / kYield_m + 1;
  return beyond <= 0 ? length_m : reach_m - kYield_m * std::exp(-beyond);
}

/// Most a foot is lifted beyond what the mixed clips say.
constexpr float kExtraLift_m = 0.03f;

double ShareOf(double steps) { return steps - std::floor(steps); }

}  // namespace

Footing::Footing(std::shared_ptr<const Model> model, Route route, std::vector<WalkClip> walks,
                 int stand_clip, const GaitStyle& style)
    : model_(std::move(model)),
      route_(std::move(route)),
      walks_(std::move(walks)),
      natural_stride_m_(style.stride_m) {
  std::vector<LegSteps> legs;
  for (const std::string side : {"left", "right"}) {
    LegSteps steps(*model_, walks_, stand_clip, side);
    if (steps.Exists()) legs.push_back(std::move(steps));
  }
  GaitStyle from_rest = style;
  from_rest.rest_phase = RestPhase(legs, walks_.size());
  gait_ = Gait(route_, from_rest);
  for (LegSteps& steps : legs) {
    legs_.push_back({std::move(steps), {}});
    PlantSteps(&legs_.back());
  }
}

double Footing::StepsTaken(const Leg& leg, double time_s) const {
  return gait_.At(time_s).cycles - leg.steps.mid_stance();
}

WalkShares Footing::SharesAt(double time_s) const {
  return SharesOf(walks_, gait_.At(time_s).amplitude * natural_stride_m_);
}

/// The foot's place under the body at a time, as its present stride sets it down.
Footing::Plant Footing::PlantAt(const Leg& leg, double time_s, int step) const {
  const RouteState body = route_.At(time_s);
  const Eigen::Vector2f offset = leg.steps.PlantUnderBody(SharesAt(time_s));
  return {time_s, step,
          body.position + Eigen::Rotation2Dd(body.heading_rad) * offset.cast<double>(),
          body.heading_rad};
}

/// The foot's place beside the other at either end of the route, where both feet stand.
Footing::Plant Footing::StandAt(const Leg& leg, double time_s) const {
  const double steps = StepsTaken(leg, time_s);
  const float swing = leg.steps.At(SharesAt(time_s), ShareOf(steps)).swing;
  const int step = static_cast<int>(std::floor(steps)) + (swing > 0.5f ? 1 : 0);
  return PlantAt(leg, time_s, step);
}

/// Every time the count of steps passes a whole number, the foot is in mid-stance; wherever the
/// body rests, both feet stand. Where the count turns back without a swing, it is the same stance.
void Footing::PlantSteps(Leg* leg) const {
  const auto plant = [&](const Plant& next) {
    if (leg->plants.empty() || leg->plants.back().step != next.step) leg->plants.push_back(next);
  };
  plant(StandAt(*leg, 0));
  for (const Route::Leg& walk : route_.legs()) {
    const double end = walk.start_s + walk.duration_s;
    const double first = StepsTaken(*leg, walk.start_s), last = StepsTaken(*leg, end);
    const int sign = last < first ? -1 : 1;
    for (double whole = sign > 0 ? std::ceil(first) : std::floor(first);
         sign * whole <= sign * last && first != last; whole += sign) {
      double low = walk.start_s, high = end;
      for (int i = 0; i < 50; ++i) {  // bisection: steps are monotonic within a walk
        const double middle = (low + high) / 2;
        (sign * StepsTaken(*leg, middle) >= sign * whole ? high : low) = middle;
      }
      plant(PlantAt(*leg, high, static_cast<int>(whole)));
    }
    plant(StandAt(*leg, end));
  }
}

/// Where a foot has to be, in the object's frame.
Eigen::Affine3f Footing::AnkleOf(const Leg& leg, double time_s,
                                 const Eigen::Affine3f& posed) const {
  const WalkShares shares = SharesAt(time_s);
  const double steps = StepsTaken(leg, time_s);
  const FootMotion motion = leg.steps.At(shares, ShareOf(steps));
  const auto after = std::ranges::upper_bound(leg.plants, time_s, {}, &Plant::time_s);
  const Plant& recent = after == leg.plants.begin() ? *after : *std::prev(after);
  const Plant& next = after == leg.plants.end() ? recent : *after;
  // Walking backwards, the stance to come is the lower one.
  const Plant& from = next.step < recent.step ? next : recent;
  const Plant& to = next.step < recent.step ? recent : next;
  // It may stand on its next place before it is over it, where the body rests or starts.
  const int step = static_cast<int>(std::floor(steps));
  const double swing = from.step > step ? 0 : to.step <= step ? 1 : motion.swing;

  // The foot rolls over the place it left and over the one it goes to; on a straight way at the
  // clip's stride the two are the same.
  const auto seen_from = [&](const Plant& plant) -> Eigen::Vector2d {
    const auto strides = static_cast<float>(plant.step - step);
    const Eigen::Vector2f way = motion.way - Eigen::Vector2f(strides * motion.stride_m, 0);
    return plant.place + Eigen::Rotation2Dd(plant.heading_rad) * way.cast<double>();
  };
  const Eigen::Vector2d place = (1 - swing) * seen_from(from) + swing * seen_from(to);
  const double heading = (1 - swing) * from.heading_rad + swing * to.heading_rad;

  const RouteState body = route_.At(time_s);
  const Eigen::Vector2d local = Eigen::Rotation2Dd(-body.heading_rad) * (place - body.position);
  const float walking = 1 - shares.stand;
  const auto swung = static_cast<float>(4 * swing * (1 - swing));
  // Short steps are scaled-down long ones; their feet would drag without a little more lift.
  const float lift = kExtraLift_m * (1 - walking * walking) * swung;
  Eigen::Affine3f ankle = posed;
  const auto turn = static_cast<float>(heading - body.heading_rad);
  ankle.linear() = Eigen::AngleAxisf(turn, Eigen::Vector3f::UnitZ()) * posed.linear();
  ankle.translation() << local.cast<float>(), motion.height_m + lift;
  return ankle;
}

/// Bends both knees so far that neither foot is out of reach.
void Footing::LowerToReach(const std::vector<Eigen::Affine3f>& ankles, NodeFrames* frames) const {
  float drop = 0;
  for (std::size_t i = 0; i < legs_.size(); ++i) {
    const Limb& limb = legs_[i].steps.limb();
    const auto at = [&](int node) {
      return (*frames)[static_cast<std::size_t>(node)].translation();
    };
    const Eigen::Vector3f hip = at(limb.upper), knee = at(limb.lower), ankle = at(limb.end);
    const float reach = kReach * ((knee - hip).norm() + (ankle - knee).norm());
    const Eigen::Vector3f way = hip - ankles[i].translation();
    const float length = Stretched(way.norm(), reach);
    const float highest = std::sqrt(std::max(0.0f, length * length - way.head<2>().squaredNorm()));
    drop = std::max(drop, way.z() - highest);
  }
  for (Eigen::Affine3f& frame : *frames) frame.translation().z() -= drop;
}

void Footing::Apply(double time_s, const NodeFrames& walking, NodeFrames* frames) const {
  std::vector<Eigen::Affine3f> ankles;
  for (const Leg& leg : legs_) {
    const auto foot = static_cast<std::size_t>(leg.steps.limb().end);
    ankles.push_back(AnkleOf(leg, time_s, walking[foot]));
  }
  LowerToReach(ankles, frames);
  for (std::size_t i = 0; i < legs_.size(); ++i) {
    const LegSteps& steps = legs_[i].steps;
    ReachFor(*model_, steps.limb(), ankles[i], kReach, frames);
    steps.BendToes(walking, frames);
    // Mixed joints may leave the sole a little below the floor.
    const float sole = steps.LowestSole(*model_, *frames);
    if (sole >= 0) continue;
    ankles[i].translation().z() -= sole;
    ReachFor(*model_, steps.limb(), ankles[i], kReach, frames);
  }
}

}  // namespace aisle::sim
