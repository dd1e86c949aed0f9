#include "simulator/mesh/capture/retarget.h"

#include <numbers>

#include "simulator/mesh/capture/body_map.h"
#include "simulator/mesh/capture/standing_feet.h"
#include "simulator/mesh/pose.h"

namespace aisle::sim {
namespace {

using Eigen::Isometry3d, Eigen::Matrix3d, Eigen::Quaterniond, Eigen::Vector3d;

constexpr std::size_t kTried = 60;  ///< frames that are looked at for one where both agree

/// Parts by whose directions two bodies are compared.
constexpr std::array kLimbs = {BodyPart::kLeftUpperArm,  BodyPart::kLeftForearm,
                               BodyPart::kRightUpperArm, BodyPart::kRightForearm,
                               BodyPart::kLeftThigh,     BodyPart::kLeftShin,
                               BodyPart::kRightThigh,    BodyPart::kRightShin};

std::size_t At(BodyPart part) { return static_cast<std::size_t>(part); }

/// A body's joints in a pose.
class Body {
 public:
  Body(const BodyMap& map, std::vector<Isometry3d> joints)
      : map_(map), joints_(std::move(joints)) {}

  bool Has(BodyPart part) const { return map_[At(part)] >= 0; }
  const Isometry3d& Joint(BodyPart part) const {
    return joints_[static_cast<std::size_t>(map_[At(part)])];
  }
  Vector3d Place(BodyPart part) const { return Joint(part).translation(); }

  /// Where a part's bone points; zero where nothing tells.
  Vector3d Direction(BodyPart part) const {
    int next = NextPart(part);
    while (next >= 0 && !Has(static_cast<BodyPart>(next))) {
      next = NextPart(static_cast<BodyPart>(next));
    }
    if (next < 0 || !Has(part)) return Vector3d::Zero();
    const Vector3d way = Place(static_cast<BodyPart>(next)) - Place(part);
    return way.norm() > 1e-9 ? Vector3d(way.normalized()) : Vector3d::Zero();
  }
  Vector3d MiddleOfHips() const {
    return (Place(BodyPart::kLeftThigh) + Place(BodyPart::kRightThigh)) / 2;
  }
  Vector3d AcrossHips() const { return Place(BodyPart::kLeftThigh) - Place(BodyPart::kRightThigh); }
  double LegLength() const {
    return (Place(BodyPart::kLeftShin) - Place(BodyPart::kLeftThigh)).norm() +
           (Place(BodyPart::kLeftFoot) - Place(BodyPart::kLeftShin)).norm();
  }

 private:
  BodyMap map_;
  std::vector<Isometry3d> joints_;
};

/// Rows: ahead, left and up of a body whose up is `up`, in its file's axes.
Matrix3d AxesOf(const Body& body, const Vector3d& up) {
  Vector3d left = body.AcrossHips() - body.AcrossHips().dot(up) * up;
  if (left.norm() < 1e-6 * body.AcrossHips().norm() || left.norm() == 0) {
    throw ImportError("its hips are one above the other, so the direction it faces is unknown");
  }
  left.normalize();
  Matrix3d axes;
  axes.row(0) = left.cross(up);
  axes.row(1) = left;
  axes.row(2) = up;
  return axes;
}

/// The file's axis that runs from the feet to the chest.
Vector3d UpOf(const Body& body) {
  const Vector3d rise = body.Place(BodyPart::kChest) -
                        (body.Place(BodyPart::kLeftFoot) + body.Place(BodyPart::kRightFoot)) / 2;
  int axis = 0;
  rise.cwiseAbs().maxCoeff(&axis);
  return Vector3d::Unit(axis) * (rise[axis] < 0 ? -1 : 1);
}

double AngleBetween(const Vector3d& a, const Vector3d& b) {
  return std::acos(std::clamp(a.dot(b), -1.0, 1.0));
}

/// Mean angle between the limbs of two bodies, both ahead along x.
double Disagreement(const Body& body, const Matrix3d& axes, const Body& model) {
  double sum = 0;
  for (const BodyPart part : kLimbs) {
    sum += AngleBetween(axes * body.Direction(part), model.Direction(part));
  }
  return sum / static_cast<double>(kLimbs.size());
}

/// The recording with what is known of its body.
class Recording {
 public:
  Recording(const Bvh& bvh, const Body& model, const RetargetOptions& options)
      : bvh_(bvh), map_(BodyOf(bvh)) {
    const Body first = BodyAt(0);
    up_ = UpOf(first);
    axes_ = AxesOf(first, up_);
    ChooseReference(model, options);
  }

  Body BodyAt(std::size_t frame) const { return {map_, PoseOf(bvh_, frame)}; }
  const Matrix3d& axes() const { return axes_; }
  const Vector3d& up() const { return up_; }
  const Body& reference() const { return *reference_; }
  const Matrix3d& reference_axes() const { return reference_axes_; }

 private:
  void ChooseReference(const Body& model, const RetargetOptions& options) {
    const Body zero(map_, ZeroPose(bvh_));
    double least = Try(zero, model);
    if (least <= options.agreement_rad) return;
    const std::size_t step = std::max<std::size_t>(1, bvh_.frames.size() / kTried);
    for (std::size_t frame = 0; frame < bvh_.frames.size(); frame += step) {
      const Body body = BodyAt(frame);
      if (Disagreement(body, AxesOf(body, up_), model) < least) least = Try(body, model);
    }
  }
  double Try(const Body& body, const Body& model) {
    const Vector3d across = body.AcrossHips() - body.AcrossHips().dot(up_) * up_;
    const bool flat = across.norm() <= 1e-6 * std::max(1e-9, body.LegLength());
    if (flat && reference_) return std::numbers::pi;
    reference_ = body;
    reference_axes_ = flat ? axes_ : AxesOf(body, up_);
    return flat ? std::numbers::pi : Disagreement(body, reference_axes_, model);
  }

  const Bvh& bvh_;
  BodyMap map_;
  Vector3d up_;
  Matrix3d axes_;  ///< of the first frame
  std::optional<Body> reference_;
  Matrix3d reference_axes_;
};

Body BodyOfModel(const Model& model, const BodyMap& map) {
  std::vector<Isometry3d> joints;
  for (const Eigen::Affine3f& frame : PoseNodes(model, {})) {
    Isometry3d joint = Isometry3d::Identity();
    joint.linear() = Quaterniond(frame.rotation().cast<double>()).toRotationMatrix();
    joint.translation() = frame.translation().cast<double>();
    joints.push_back(joint);
  }
  return {map, std::move(joints)};
}

/// Turns that lay the model's rest pose onto the recording's reference, by part. Feet turn about
/// the vertical alone: both stand flat there, whatever their ankles' heights.
std::array<Quaterniond, kBodyParts> Alignment(const Recording& recording, const Body& model) {
  std::array<Quaterniond, kBodyParts> turns;
  turns.fill(Quaterniond::Identity());
  for (std::size_t i = 0; i < kBodyParts; ++i) {
    const auto part = static_cast<BodyPart>(i);
    Vector3d to = recording.reference_axes() * recording.reference().Direction(part);
    Vector3d from = model.Direction(part);
    if (part == BodyPart::kLeftFoot || part == BodyPart::kRightFoot) to.z() = from.z() = 0;
    if (to.norm() < 1e-6 || from.norm() < 1e-6) continue;
    turns[i] = Quaterniond::FromTwoVectors(from, to);
  }
  return turns;
}

class Retargeter {
 public:
  Retargeter(const Bvh& bvh, const Model& model, const RetargetOptions& options)
      : bvh_(bvh),
        model_(model),
        options_(options),
        map_(BodyOf(model)),
        rest_(BodyOfModel(model, map_)),
        recording_(bvh, rest_, options),
        turns_(Alignment(recording_, rest_)),
        scale_(rest_.LegLength() / recording_.reference().LegLength()) {
    if (!std::isfinite(scale_) || scale_ <= 0) throw ImportError("its legs have no length");
    part_of_node_.resize(model.nodes.size(), -1);
    for (std::size_t i = 0; i < kBodyParts; ++i) {
      part_of_node_[static_cast<std::size_t>(map_[i])] = static_cast<int>(i);
    }
    MeasureFloor();
  }

  Retargeted Run() {
    std::vector<NodeFrames> poses;
    FootTracks tracks;
    for (std::size_t frame = 0; frame < bvh_.frames.size(); ++frame) {
      const Body body = recording_.BodyAt(frame);
      poses.push_back(FramesOf(body));
      for (std::size_t side = 0; side < 2; ++side) {
        tracks[side].push_back(BallOf(body, side));
      }
    }
    Retargeted result;
    result.contacts = FindContacts(tracks, bvh_.frame_s, options_);
    StandOnFloor(model_, map_, rest_ball_m_, result.contacts, bvh_.frame_s, options_, &poses);
    result.clip = ClipOf(poses);
    return result;
  }

 private:
  /// The toes where the recording has them, else the ankle.
  static BodyPart BallPart(const Body& body, std::size_t side) {
    const BodyPart toes = side == 0 ? BodyPart::kLeftToes : BodyPart::kRightToes;
    return body.Has(toes) ? toes : side == 0 ? BodyPart::kLeftFoot : BodyPart::kRightFoot;
  }
  /// In metres of the model, floor axes.
  Vector3d BallOf(const Body& body, std::size_t side) const {
    return scale_ * (recording_.axes() * body.Place(BallPart(body, side)));
  }

  /// Where the floor is under the recording: as low as its ankles come. A rare dip does not count.
  void MeasureFloor() {
    std::vector<double> heights;
    for (std::size_t frame = 0; frame < bvh_.frames.size(); ++frame) {
      const Body body = recording_.BodyAt(frame);
      for (const BodyPart foot : {BodyPart::kLeftFoot, BodyPart::kRightFoot}) {
        heights.push_back(scale_ * recording_.up().dot(body.Place(foot)));
      }
    }
    const auto low = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 20);
    std::ranges::nth_element(heights, low);
    ankle_shift_m_ = rest_.Place(BodyPart::kLeftFoot).z() - *low;
    const Vector3d hips = scale_ * (recording_.axes() * recording_.BodyAt(0).MiddleOfHips());
    origin_ = {hips.x(), hips.y(), 0};
    rest_ball_m_ = static_cast<float>(rest_.Place(BodyPart::kLeftToes).z());
  }

  /// The model's nodes in a frame of the recording.
  NodeFrames FramesOf(const Body& body) const {
    std::array<Quaterniond, kBodyParts> turned;
    for (std::size_t i = 0; i < kBodyParts; ++i) turned[i] = TurnOf(body, i);
    NodeFrames frames;
    for (std::size_t node = 0; node < model_.nodes.size(); ++node) {
      const ModelNode& own = model_.nodes[node];
      Eigen::Affine3f local = Eigen::Translation3f(own.rest.translation) * own.rest.rotation *
                              Eigen::Scaling(own.rest.scale);
      frames.push_back(own.parent < 0 ? local
                                      : frames[static_cast<std::size_t>(own.parent)] * local);
      const int part = part_of_node_[node];
      if (part < 0 || !Drives(body, static_cast<std::size_t>(part))) continue;
      frames.back().linear() =
          turned[static_cast<std::size_t>(part)].toRotationMatrix().cast<float>();
      if (part == static_cast<int>(BodyPart::kPelvis)) {
        frames.back().translation() =
            PelvisAt(body, turned[static_cast<std::size_t>(part)]).cast<float>();
      }
    }
    return frames;
  }
  bool Drives(const Body& body, std::size_t part) const {
    return body.Has(static_cast<BodyPart>(part));
  }

  /// The turn of a model's part: the recorded one's since the reference, after the alignment.
  Quaterniond TurnOf(const Body& body, std::size_t index) const {
    const auto part = static_cast<BodyPart>(index);
    const Matrix3d rest = rest_.Joint(part).linear();
    if (!body.Has(part)) return Quaterniond(rest);
    const Matrix3d since = recording_.axes() * body.Joint(part).linear() *
                           recording_.reference().Joint(part).linear().transpose() *
                           recording_.reference_axes().transpose();
    return Quaterniond(since) * turns_[index] * Quaterniond(rest);
  }

  /// Such that the middle of the hips is where the recording has it.
  Vector3d PelvisAt(const Body& body, const Quaterniond& turn) const {
    Vector3d hips = scale_ * (recording_.axes() * body.MiddleOfHips()) - origin_;
    hips.z() += ankle_shift_m_;
    const Vector3d in_pelvis = rest_.Joint(BodyPart::kPelvis).linear().transpose() *
                               (rest_.MiddleOfHips() - rest_.Place(BodyPart::kPelvis));
    return hips - turn * in_pelvis;
  }

  Clip ClipOf(const std::vector<NodeFrames>& poses) const {
    Clip clip;
    clip.name = "capture";
    clip.duration_s = static_cast<float>(bvh_.duration_s());
    for (std::size_t node = 0; node < model_.nodes.size(); ++node) {
      if (part_of_node_[node] < 0) continue;
      ClipChannel channel;
      channel.node = static_cast<int>(node);
      const bool is_pelvis = part_of_node_[node] == static_cast<int>(BodyPart::kPelvis);
      for (std::size_t frame = 0; frame < poses.size(); ++frame) {
        const float time = static_cast<float>(bvh_.frame_s * static_cast<double>(frame));
        const int parent = model_.nodes[node].parent;
        const Eigen::Affine3f above = parent < 0 ? Eigen::Affine3f::Identity()
                                                 : poses[frame][static_cast<std::size_t>(parent)];
        const Eigen::Affine3f local = above.inverse() * poses[frame][node];
        Eigen::Quaternionf turn(local.rotation());
        if (frame > 0 && turn.dot(channel.rotations.keys.back().second) < 0) {
          turn.coeffs() *= -1;
        }
        channel.rotations.keys.emplace_back(time, turn);
        if (is_pelvis) channel.translations.keys.emplace_back(time, local.translation());
      }
      clip.channels.push_back(std::move(channel));
    }
    return clip;
  }

  const Bvh& bvh_;
  const Model& model_;
  const RetargetOptions& options_;
  BodyMap map_;
  Body rest_;
  Recording recording_;
  std::array<Quaterniond, kBodyParts> turns_;
  double scale_;
  std::vector<int> part_of_node_;
  double ankle_shift_m_ = 0;  ///< that brings the recording's lowest ankle to the model's height
  Vector3d origin_ = Vector3d::Zero();
  float rest_ball_m_ = 0;
};

}  // namespace

Retargeted Retarget(const Bvh& bvh, const Model& model, const RetargetOptions& options) {
  return Retargeter(bvh, model, options).Run();
}

}  // namespace aisle::sim
