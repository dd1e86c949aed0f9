#include "simulator/world/footing.h"

#include <algorithm>
#include <cmath>

namespace aisle::sim {
namespace {

/// Legs are never quite stretched: a straight knee would jitter.
constexpr float kReach = 0.9985f;

/// Most a foot is lifted beyond what the mixed clips say.
constexpr float kExtraLift_m = 0.03f;

template <std::size_t N>
float Sampled(const std::array<float, N>& curve, double share) {
  const double at = share * static_cast<double>(N - 1);
  const std::size_t low = std::min(static_cast<std::size_t>(at), N - 2);
  const float t = static_cast<float>(at - static_cast<double>(low));
  return curve[low] + t * (curve[low + 1] - curve[low]);
}

Eigen::Vector3f AnkleIn(const Model& model, int clip, double time_s, int foot) {
  const PoseLayer layer{clip, time_s, 1, -1};
  return PoseNodes(model, {&layer, 1})[static_cast<std::size_t>(foot)].translation();
}

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

Footing::Footing(std::shared_ptr<const Model> model, Route route, Gait gait,
                 std::vector<WalkClip> walks, int stand_clip, double natural_stride_m)
    : model_(std::move(model)),
      route_(std::move(route)),
      gait_(std::move(gait)),
      walks_(std::move(walks)),
      stand_clip_(stand_clip),
      natural_stride_m_(natural_stride_m) {
  for (const std::string side : {"left", "right"}) {
    Leg leg;
    leg.limb = {model_->FindNode("thigh_" + side), model_->FindNode("shin_" + side),
                model_->FindNode("foot_" + side)};
    if (leg.limb.upper < 0 || leg.limb.lower < 0 || leg.limb.end < 0) continue;
    FindCurves(&leg);
    PlantSteps(&leg);
    legs_.push_back(std::move(leg));
  }
}

/// Mid-stance is where the foot is stillest over the floor, in the longest-striding walk.
void Footing::FindCurves(Leg* leg) const {
  const auto over_floor = [&](const WalkClip& walk, double phase) {
    Eigen::Vector3f ankle = AnkleIn(*model_, walk.clip, phase * walk.duration_s, leg->limb.end);
    ankle.x() += static_cast<float>(walk.stride_m * phase);
    return ankle;
  };
  float stillest = 1e9f;
  constexpr double kPhase = 1.0 / kSamples;
  for (int i = 0; i < kSamples; ++i) {
    const float way =
        (over_floor(walks_.back(), (i + 1) * kPhase) - over_floor(walks_.back(), (i - 1) * kPhase))
            .norm();
    if (way < stillest) {
      stillest = way;
      leg->mid_stance = i * kPhase;
    }
  }
  for (const WalkClip& walk : walks_) {
    Curve curve;
    const float start = over_floor(walk, leg->mid_stance).x();
    for (std::size_t i = 0; i <= kSamples; ++i) {
      const double share = static_cast<double>(i) * kPhase;
      const Eigen::Vector3f ankle = over_floor(walk, leg->mid_stance + share);
      curve.progress[i] = (ankle.x() - start) / static_cast<float>(walk.stride_m);
      curve.side[i] = ankle.y();
      curve.height[i] = ankle.z();
    }
    curve.ahead = start - static_cast<float>(walk.stride_m * leg->mid_stance);
    leg->curves.push_back(curve);
  }
  leg->standing = AnkleIn(*model_, stand_clip_, 0, leg->limb.end);
}

double Footing::StepsTaken(const Leg& leg, double time_s) const {
  return gait_.At(time_s).cycles - leg.mid_stance;
}

/// The foot's place under the body at a time, as its present stride sets it down.
Footing::Plant Footing::PlantAt(const Leg& leg, double time_s, int step) const {
  const RouteState body = route_.At(time_s);
  const WalkShares shares = SharesOf(walks_, gait_.At(time_s).amplitude * natural_stride_m_);
  Eigen::Vector2f offset = shares.stand * leg.standing.head<2>();
  for (std::size_t i = 0; i < walks_.size(); ++i) {
    offset += shares.walks[i] * Eigen::Vector2f(leg.curves[i].ahead, leg.curves[i].side[0]);
  }
  return {time_s, step,
          body.position + Eigen::Rotation2Dd(body.heading_rad) * offset.cast<double>(),
          body.heading_rad};
}

/// Every time the count of steps passes a whole number, the foot is in mid-stance.
void Footing::PlantSteps(Leg* leg) const {
  constexpr double kScan_s = 0.02;
  const double end = route_.duration_s();
  double before = StepsTaken(*leg, 0);
  leg->first = PlantAt(*leg, 0, static_cast<int>(std::floor(before)));
  leg->last = PlantAt(*leg, end, 0);
  leg->first_share = before - std::floor(before);
  for (double t = kScan_s; t < end + kScan_s; t += kScan_s) {
    const double now = StepsTaken(*leg, t);
    const double whole = std::floor(std::max(now, before));
    if (whole > std::min(now, before)) {
      double low = t - kScan_s, high = t;
      for (int i = 0; i < 40; ++i) {  // bisection
        const double middle = (low + high) / 2;
        const bool beyond = (StepsTaken(*leg, middle) >= whole) == (now > before);
        (beyond ? high : low) = middle;
      }
      leg->plants.push_back(PlantAt(*leg, high, static_cast<int>(whole)));
    }
    before = now;
  }
}

/// The plant of a step that is nearest in time (walking backwards repeats steps); where there is
/// none, the route begins or ends before it.
const Footing::Plant& Footing::Nearest(const Leg& leg, int step, double time_s) const {
  const Plant* nearest = nullptr;
  for (const Plant& plant : leg.plants) {
    if (plant.step != step) continue;
    if (nearest == nullptr ||
        std::abs(plant.time_s - time_s) < std::abs(nearest->time_s - time_s)) {
      nearest = &plant;
    }
  }
  if (nearest != nullptr) return *nearest;
  return step <= leg.first.step && (leg.plants.empty() || time_s < leg.plants.front().time_s)
             ? leg.first
             : leg.last;
}

float Footing::ProgressOf(const Leg& leg, const WalkShares& shares, double share) const {
  float progress = 0, total = 0;
  for (std::size_t i = 0; i < walks_.size(); ++i) {
    const float weight = shares.walks[i];
    progress += weight * Sampled(leg.curves[i].progress, share);
    total += weight;
  }
  return total > 0 ? progress / total : Sampled(leg.curves.front().progress, share);
}

Eigen::Affine3f Footing::TargetOf(const Leg& leg, double time_s, const RouteState& body,
                                  const Eigen::Affine3f& posed) const {
  const WalkShares shares = SharesOf(walks_, gait_.At(time_s).amplitude * natural_stride_m_);
  const double steps = StepsTaken(leg, time_s);
  const int step = static_cast<int>(std::floor(steps));
  const double share = steps - step;
  const Plant& from = Nearest(leg, step, time_s);
  const Plant& to = Nearest(leg, step + 1, time_s);
  float progress = ProgressOf(leg, shares, share);
  if (&from == &leg.first) {  // it set out from a stand, somewhere in its cycle
    const float done = ProgressOf(leg, shares, leg.first_share);
    progress = std::max(0.0f, (progress - done) / std::max(1 - done, 1e-3f));
  }
  const Eigen::Vector2d place = from.place + progress * (to.place - from.place);
  const double heading = from.heading_rad + progress * (to.heading_rad - from.heading_rad);

  // Height and swing to the side as the mixed clips have them.
  float height = shares.stand * leg.standing.z(), aside = 0;
  for (std::size_t i = 0; i < walks_.size(); ++i) {
    height += shares.walks[i] * Sampled(leg.curves[i].height, share);
    aside += shares.walks[i] * (Sampled(leg.curves[i].side, share) - leg.curves[i].side[0]);
  }
  // Short steps are scaled-down long ones; their feet would drag without a little more lift.
  const float full = 1 - shares.stand;
  height += kExtraLift_m * 4 * full * (1 - full) * 4 * progress * (1 - progress);
  const Eigen::Vector2d local = Eigen::Rotation2Dd(-body.heading_rad) * (place - body.position);
  const auto turn = static_cast<float>(heading - body.heading_rad);
  Eigen::Affine3f target = posed;
  target.linear() = Eigen::AngleAxisf(turn, Eigen::Vector3f::UnitZ()) * posed.linear();
  target.translation() << static_cast<float>(local.x()), static_cast<float>(local.y()) + aside,
      height;
  return target;
}

void Footing::Apply(double time_s, float hold, NodeFrames* frames) const {
  if (hold <= 0) return;
  const RouteState body = route_.At(time_s);
  for (const Leg& leg : legs_) {
    const Eigen::Affine3f posed = (*frames)[static_cast<std::size_t>(leg.limb.end)];
    Eigen::Affine3f target = TargetOf(leg, time_s, body, posed);
    target.translation() =
        posed.translation() + hold * (target.translation() - posed.translation());
    ReachFor(*model_, leg.limb, target, kReach, frames);
  }
}

}  // namespace aisle::sim
