#include "simulator/world/captured_person.h"

#include <cmath>
#include <stdexcept>

#include "simulator/mesh/capture/retarget.h"
#include "simulator/mesh/pose.h"

namespace aisle::sim {
namespace {

constexpr double kHalfStep_s = 0.005;  ///< over which the body's speed is differenced

/// A recorded motion, laid down at the person's start.
class Played {
 public:
  Played(const PersonSpec& person, const Model& base, const Clip& clip)
      : start_s_(person.route.plan.start_s) {
    auto model = std::make_shared<Model>(base);
    model->clips.push_back(clip);
    clip_ = static_cast<int>(model->clips.size()) - 1;
    duration_s_ = clip.duration_s;
    pelvis_ = static_cast<std::size_t>(model->FindNode("pelvis"));
    ahead_in_pelvis_ =
        PoseNodes(*model, {})[pelvis_].rotation().transpose() * Eigen::Vector3f::UnitX();
    model_ = std::move(model);
    origin_ = {.position = person.route.plan.start, .heading_rad = person.route.plan.heading_rad};
  }

  /// The object is below the pelvis, faces as that does, and may move sideways.
  MoverState At(double time_s, MoverParts parts) const {
    MoverState moved = SkinState(*model_,
                                 {[&](double t) { return JointMatrices(*model_, FramesAt(t)); },
                                  [&](double) { return ObjectPose(origin_); }},
                                 time_s, parts);
    RouteState state = PlaceAt(time_s);
    const Eigen::Vector2d velocity =
        (PlaceAt(time_s + kHalfStep_s).position - PlaceAt(time_s - kHalfStep_s).position) /
        (2 * kHalfStep_s);
    const Eigen::Vector2d ahead(std::cos(state.heading_rad), std::sin(state.heading_rad));
    state.speed_mps = velocity.dot(ahead);
    PlaceObject(state, velocity.dot(Eigen::Vector2d(-ahead.y(), ahead.x())), &moved);
    return moved;
  }

  FloorWay Way() const {
    FloorWay way;
    const double steps = std::ceil(duration_s_ / way.step_s);
    for (int i = 0; i <= static_cast<int>(steps); ++i) {
      way.places.push_back(PlaceAt(start_s_ + i * way.step_s).position);
    }
    return way;
  }

 private:
  NodeFrames FramesAt(double time_s) const {
    constexpr double kBeforeItsEnd = 1 - 1e-6;  // at its end a clip would begin anew
    const double time = std::clamp(time_s - start_s_, 0.0, kBeforeItsEnd * duration_s_);
    const PoseLayer layer{clip_, time, 1, -1};
    return PoseNodes(*model_, {&layer, 1});
  }

  RouteState PlaceAt(double time_s) const {
    const Eigen::Affine3f T_object_pelvis = FramesAt(time_s)[pelvis_];
    const Eigen::Isometry3d T_world_object = ObjectPose(origin_);
    const Eigen::Vector3d place =
        T_world_object * Eigen::Vector3f(T_object_pelvis.translation()).cast<double>();
    const Eigen::Vector3d ahead =
        T_world_object.linear() *
        Eigen::Vector3f(T_object_pelvis.linear() * ahead_in_pelvis_).cast<double>();
    RouteState state;
    state.position = place.head<2>();
    state.heading_rad = std::atan2(ahead.y(), ahead.x());
    return state;
  }

  std::shared_ptr<const Model> model_;
  int clip_ = 0;
  double duration_s_ = 0, start_s_ = 0;
  std::size_t pelvis_ = 0;
  Eigen::Vector3f ahead_in_pelvis_;
  RouteState origin_;
};

int ClipOf(const Model& model, const std::string& name) {
  if (name.empty() && model.clips.size() == 1) return 0;
  const int clip = model.FindClip(name);
  if (clip >= 0) return clip;
  std::string names;
  for (const Clip& one : model.clips) names += (names.empty() ? "" : ", ") + one.name;
  throw std::runtime_error(fmt::format("clip '{}': the model '{}' has {}", name, model.name,
                                       names.empty() ? "no animation" : "the animations " + names));
}

/// A model of the user's own that plays a clip along its route.
class Own {
 public:
  Own(const PersonSpec& person, std::shared_ptr<const Model> model)
      : model_(std::move(model)),
        route_(person.route.plan, person.route.limits),
        clip_(ClipOf(*model_, person.capture.clip)),
        duration_s_(model_->clips[static_cast<std::size_t>(clip_)].duration_s),
        stride_m_(person.capture.stride_m) {}

  MoverState At(double time_s, MoverParts parts) const {
    MoverState moved = SkinState(
        *model_,
        {[&](double t) { return JointsAt(t); }, [&](double t) { return ObjectPose(route_.At(t)); }},
        time_s, parts);
    PlaceObject(route_.At(time_s), 0, &moved);
    return moved;
  }

 private:
  std::vector<Eigen::Affine3f> JointsAt(double time_s) const {
    const double time =
        stride_m_ > 0 ? route_.At(time_s).odometer_m / stride_m_ * duration_s_ : time_s;
    const PoseLayer layer{clip_, time, 1, -1};
    return JointMatrices(*model_, PoseNodes(*model_, {&layer, 1}));
  }

  std::shared_ptr<const Model> model_;
  Route route_;
  int clip_;
  double duration_s_, stride_m_;
};

std::shared_ptr<const Model> BodyOf(const PersonSpec& person, AssetLibrary* assets) {
  const CaptureSpec& capture = person.capture;
  return capture.mesh.name.empty() ? assets->Load("people/" + person.model)
                                   : assets->LoadSkinned(capture.mesh.file);
}

std::shared_ptr<const Played> PlayedBy(const PersonSpec& person, const Model& body) {
  return std::make_shared<const Played>(person, body,
                                        Retarget(ReadBvh(person.capture.bvh.file), body).clip);
}

template <class Body>
Actor ActorOf(TriangleMesh mesh, std::shared_ptr<const Body> body) {
  return {std::move(mesh),
          [body](double time_s, MoverParts parts) { return body->At(time_s, parts); }};
}

}  // namespace

bool IsCaptured(const PersonSpec& person) {
  return !person.capture.bvh.name.empty() || !person.capture.mesh.name.empty();
}

Actor MakeCapturedPerson(const PersonSpec& person, AssetLibrary* assets, Wardrobe* wardrobe) {
  const std::shared_ptr<const Model> model = BodyOf(person, assets);
  TriangleMesh mesh = wardrobe->Wear(model);
  if (person.capture.bvh.name.empty()) {
    return ActorOf<Own>(std::move(mesh), std::make_shared<const Own>(person, model));
  }
  return ActorOf<Played>(std::move(mesh), PlayedBy(person, *model));
}

FloorWay RecordedWay(const PersonSpec& person, AssetLibrary* assets) {
  return PlayedBy(person, *BodyOf(person, assets))->Way();
}

void CheckClip(const PersonSpec& person, AssetLibrary* assets) {
  ClipOf(*BodyOf(person, assets), person.capture.clip);
}

}  // namespace aisle::sim
