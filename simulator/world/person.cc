#include <array>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string_view>

#include "simulator/mesh/pose.h"
#include "simulator/motion/gait.h"
#include "simulator/world/actors.h"
#include "simulator/world/footing.h"
#include "simulator/world/held.h"
#include "simulator/world/manners.h"
#include "simulator/world/shapes.h"

namespace aisle::sim {
namespace {

/// Clips fade into one another over this time, arms starting and stopping as they do when they
/// reach for something (least jerk: Flash and Hogan, J. Neurosci. 5, 1985).
constexpr double kFade_s = 0.75;

/// Plain walking from slow to fast; others (with a load, backwards) are asked for by name.
constexpr std::array<std::string_view, 4> kWalks = {"walk_creep", "walk_slow", "walk", "walk_fast"};

/// Walking with a box; standing with it is its twin.
constexpr const char* kCarry = "walk_carry";

constexpr double kKneeling_s = 1.4, kLookingBack_s = 0.6;

/// A clip by its facts; one that walks has a stride, negative backwards.
struct PlayedClip {
  int clip = -1;
  double stride_m = 0;
  double duration_s = 1;
};

/// What a step of the route plays, and when.
struct Playing {
  int step = 0;
  std::string play;  ///< empty: plain walking and standing
  double from_s = 0, until_s = 0;
};

/// The steps of a route with their times, one after the other.
std::vector<Playing> PlayingsOf(const Route& route, const std::vector<RouteStep>& steps) {
  std::vector<Playing> playings;
  const auto begin = [&](int step, double from_s) {
    if (step < 0 || (!playings.empty() && playings.back().step == step)) return;
    if (!playings.empty()) playings.back().until_s = from_s;
    const std::string& play = steps[static_cast<std::size_t>(step)].play;
    playings.push_back({step, play, from_s, route.duration_s()});
  };
  for (const Route::Leg& leg : route.legs()) {
    begin(leg.start.step, leg.step_start_s);
    for (const auto& segment : leg.segment_steps) begin(segment.step, segment.start_s);
  }
  return playings;
}

/// How much of a time span lies around now, in fading's measure; those of neighbours sum to 1.
float ShareAround(double time_s, double from_s, double until_s) {
  const auto passed = [&](double at_s) { return SmoothStep((at_s - time_s) / kFade_s + 0.5); };
  return static_cast<float>(passed(until_s) - passed(from_s));
}

/// Who the person is and how it moves: everything a pose at a time needs.
class Walker {
 public:
  Walker(const PersonSpec& person, std::shared_ptr<const Model> model, const PersonFacts& facts)
      : model_(std::move(model)),
        route_(person.route.plan, person.route.limits),
        manners_(*model_),
        limp_(person.limp),
        natural_(person.natural) {
    stand_ = RequireClip("stand");
    const int walk = RequireClip("walk");
    for (const auto& [name, clip] : facts.clips) {
      const int index = model_->FindClip(name);
      if (index < 0) continue;
      clips_[name] = {index, clip.stride_m, clip.duration_s};
      if (std::ranges::find(kWalks, name) != kWalks.end() && clip.stride_m > 0) {
        walks_.push_back({index, clip.stride_m, clip.duration_s});
      }
    }
    std::ranges::sort(walks_, {}, &WalkClip::stride_m);
    if (walks_.empty()) throw std::runtime_error("the manifest gives its walk clip no stride_m");
    GaitStyle style;
    for (const WalkClip& one : walks_) {
      if (one.clip == walk) style = {one.stride_m, one.duration_s, walks_.back().stride_m};
    }
    style.limp = person.limp;
    stride_m_ = style.stride_m;
    for (const RouteStep& step : person.route.plan.steps) {
      carries_ = carries_ || step.play == kCarry;
      if (!step.play.empty() && !IsPosed(step.play)) RequireClip(step.play);
    }
    for (const Playing& playing : PlayingsOf(route_, person.route.plan.steps)) {
      if (!playing.play.empty()) (IsPosed(playing.play) ? posed_ : played_).push_back(playing);
    }
    FindHands(facts);
    footing_ = std::make_unique<Footing>(model_, route_, walks_, stand_, style);
  }

  RouteState RouteAt(double time_s) const { return route_.At(time_s); }

  bool carries() const { return carries_; }

  /// Where the hands hold what is carried, or else the handle of what is pushed.
  Eigen::Isometry3d GripAt(double time_s) const {
    const Eigen::Isometry3d place = ObjectPose(route_.At(time_s));
    if (!carries_) return place * Eigen::Translation3d(handle_ahead_m_, 0, 0);
    const Eigen::Affine3f moved = FramesAt(time_s)[chest_] * carry_chest_.inverse();
    Eigen::Isometry3d hands = place;
    hands.matrix() *= moved.matrix().cast<double>();
    return hands * Eigen::Translation3d(carry_centre_m_);
  }

  /// Matrix of each joint of the model as it is shown (with what it holds): bind position ->
  /// object.
  std::vector<Eigen::Affine3f> JointsAt(const Model& shown, double time_s) const {
    return JointMatrices(shown, FramesAt(time_s));
  }

 private:
  /// The skeleton in the object's frame.
  NodeFrames FramesAt(double time_s) const {
    const std::vector<PoseLayer> walk = WalkLayersAt(time_s);
    const NodeFrames walking = PoseNodes(*model_, walk);
    std::vector<PoseLayer> layers = walk;
    if (route_.At(time_s).speed_mps < 0) TurnBackwards(time_s, &layers);
    AddPlayed(time_s, &layers);
    NodeFrames frames = PoseNodes(*model_, layers);
    if (natural_) manners_.Balance(route_, time_s, &frames);
    footing_->Apply(time_s, walking, &frames);
    AddManners(time_s, &frames);
    if (limp_ > 0) {
      const GaitState gait = footing_->gait().At(time_s);
      manners_.Lurch(gait.cycles - footing_->gait().SparedPhase(),
                     std::min(1.0, gait.amplitude) * limp_ / 0.4, &frames);
    }
    return frames;
  }

  /// Whether the simulator itself poses what is to be played, for want of such a clip.
  bool IsPosed(const std::string& play) const {
    return std::ranges::count(kManners, play) > 0 && !clips_.contains(play);
  }

  /// What the route's steps have the simulator pose.
  void AddManners(double time_s, NodeFrames* frames) const {
    for (const auto& [step, pose, from_s, until_s] : posed_) {
      const double elapsed_s = time_s - from_s, duration_s = until_s - from_s;
      if (elapsed_s <= 0 || elapsed_s >= duration_s) continue;
      if (pose == "kneel") manners_.Kneel(Held(elapsed_s, duration_s, kKneeling_s), frames);
      if (pose == "look_back") {
        manners_.LookBack(Held(elapsed_s, duration_s, kLookingBack_s), frames);
      }
    }
  }

  /// What the clips say of the hands.
  void FindHands(const PersonFacts& facts) {
    const auto push = facts.clips.find("walk_push");
    if (push != facts.clips.end()) handle_ahead_m_ = push->second.handle_ahead_m;
    const auto carry = facts.clips.find(kCarry);
    const int chest = model_->FindNode("chest");
    if (!carries_ || carry == facts.clips.end() || !carry->second.box || chest < 0) return;
    const PoseLayer layer{model_->FindClip(kCarry), 0, 1, -1};
    chest_ = static_cast<std::size_t>(chest);
    carry_chest_ = PoseNodes(*model_, {&layer, 1})[chest_];
    carry_centre_m_ = carry->second.box->centre_m.cast<double>();
  }

  int RequireClip(const std::string& name) const {
    const int clip = model_->FindClip(name);
    if (clip < 0) {
      throw std::runtime_error(fmt::format("the model '{}' has no clip '{}'", model_->name, name));
    }
    return clip;
  }

  /// Standing and walking, mixed for the present stride.
  std::vector<PoseLayer> WalkLayersAt(double time_s) const {
    const GaitState gait = footing_->gait().At(time_s);
    const WalkShares shares = SharesOf(walks_, gait.amplitude * stride_m_);
    std::vector<PoseLayer> layers = {{stand_, time_s, shares.stand, -1}};
    for (std::size_t i = 0; i < walks_.size(); ++i) {
      layers.push_back({walks_[i].clip, gait.cycles * walks_[i].duration_s, shares.walks[i], -1});
    }
    return layers;
  }

  /// Walking backwards: the trunk leans and the arms hang as its own clip has it.
  void TurnBackwards(double time_s, std::vector<PoseLayer>* layers) const {
    const auto backwards = clips_.find("walk_backwards");
    if (backwards == clips_.end()) return;
    const float standing = layers->front().weight;
    layers->resize(1);
    layers->push_back(LayerOf(backwards->second, time_s, 0, 1 - standing));
  }

  /// A clip `elapsed` seconds after it began; one that walks keeps step with the feet instead.
  PoseLayer LayerOf(const PlayedClip& clip, double time_s, double elapsed_s, float weight) const {
    const double cycles = footing_->gait().At(time_s).cycles;
    const double time = clip.stride_m > 0   ? cycles * clip.duration_s
                        : clip.stride_m < 0 ? -cycles * clip.duration_s
                                            : elapsed_s;
    return {clip.clip, time, weight, -1};
  }

  /// Adds what the route's steps play, with as much weight as each takes of the time around now;
  /// who carries a box never lets go of it.
  void AddPlayed(double time_s, std::vector<PoseLayer>* layers) const {
    if (carries_) {
      layers->clear();
      return AddClip(kCarry, time_s, time_s, 1, layers);
    }
    const std::size_t walking = layers->size();
    float plain = 1;
    for (const auto& [step, clip, from_s, until_s] : played_) {
      const float share = ShareAround(time_s, from_s, until_s);
      if (share <= 0) continue;
      AddClip(clip, time_s, time_s - from_s, share, layers);
      plain -= share;
    }
    for (PoseLayer& layer : std::span(*layers).first(walking))
      layer.weight *= std::max(0.0f, plain);
  }

  /// A walk that has a standing twin (walk_carry, stand_carry) turns into it as the steps shrink.
  void AddClip(const std::string& name, double time_s, double elapsed_s, float weight,
               std::vector<PoseLayer>* layers) const {
    const auto twin =
        name.starts_with("walk_") ? clips_.find("stand" + name.substr(4)) : clips_.end();
    const double amplitude = footing_->gait().At(time_s).amplitude;
    const float walks = twin == clips_.end() ? 1 : static_cast<float>(std::min(1.0, amplitude));
    layers->push_back(LayerOf(clips_.at(name), time_s, elapsed_s, weight * walks));
    if (walks < 1) layers->push_back(LayerOf(twin->second, time_s, time_s, weight * (1 - walks)));
  }

  std::shared_ptr<const Model> model_;
  Route route_;
  int stand_ = -1;
  double stride_m_ = 1.4;
  std::vector<WalkClip> walks_;  ///< by stride
  std::map<std::string, PlayedClip> clips_;
  std::unique_ptr<const Footing> footing_;
  std::vector<Playing> played_;  ///< clips
  std::vector<Playing> posed_;   ///< what the simulator poses itself
  Manners manners_;
  double limp_ = 0;
  bool natural_ = false;
  bool carries_ = false;
  double handle_ahead_m_ = 0;
  std::size_t chest_ = 0;
  Eigen::Affine3f carry_chest_ = Eigen::Affine3f::Identity();
  Eigen::Vector3d carry_centre_m_ = Eigen::Vector3d::Zero();
};

/// A taped carton, somewhere in the picture atlas.
TriangleMesh BoxInArms(const BoxFacts& box, const Palette& palette, Dice dice) {
  const auto pick = [&](const auto& rects) {
    return rects[static_cast<std::size_t>(dice.Pick(static_cast<int>(rects.size())))];
  };
  BoxPaint paint = BoxPaint::Whole(palette.carton, pick(palette.carton_sides));
  paint.uvs[kTop] = pick(palette.carton_tops);
  TriangleMesh mesh;
  AddBox(&mesh, At(box.centre_m.x(), box.centre_m.y(), box.centre_m.z()), box.size_m, paint);
  return mesh;
}

/// The box moves with the chest, as the arms of the clip do.
Model WithBox(const Model& model, const TriangleMesh& box) {
  const PoseLayer layer{model.FindClip(kCarry), 0, 1, -1};
  const int chest = model.FindNode("chest");
  if (chest < 0) throw std::runtime_error(model.name + " has no node 'chest' to carry a box");
  return Carrying(model, box, chest, PoseNodes(model, {&layer, 1}));
}

}  // namespace

Actor MakePerson(const PersonSpec& person, AssetLibrary* assets, const Palette& palette, Dice dice,
                 Wardrobe* wardrobe, bool shares_load) {
  const PersonFacts& facts = assets->Person(person.model);
  std::shared_ptr<const Model> model = assets->Load("people/" + person.model);
  TriangleMesh mesh = wardrobe->Wear(model);
  const auto walker = std::make_shared<const Walker>(person, model, facts);
  if (walker->carries() && !shares_load) {
    const auto carry = facts.clips.find(kCarry);
    if (carry == facts.clips.end() || !carry->second.box) {
      throw std::runtime_error(fmt::format("assets/manifest.json names no box for {}", kCarry));
    }
    const TriangleMesh box = BoxInArms(*carry->second.box, palette, dice);
    model = std::make_shared<const Model>(WithBox(*model, box));
    AddMesh(&mesh, Eigen::Isometry3f::Identity(), box);
  }
  return {std::move(mesh),
          [walker, model](double time_s, MoverParts parts) {
            MoverState state = SkinState(*model,
                                         {[&](double t) { return walker->JointsAt(*model, t); },
                                          [&](double t) { return ObjectPose(walker->RouteAt(t)); }},
                                         time_s, parts);
            PlaceObject(walker->RouteAt(time_s), 0, &state);
            return state;
          },
          [walker](double time_s) { return walker->GripAt(time_s); }};
}

}  // namespace aisle::sim
