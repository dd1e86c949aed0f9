#include "simulator/world/mechanism.h"

#include <algorithm>
#include <cmath>

#include "simulator/world/part_shapes.h"

namespace aisle::sim {
namespace {

/// Half of the time over which what holds a mechanism is differenced.
constexpr double kHalfStep_s = 0.0005;

Placement Resting(const Eigen::Isometry3d& pose) {
  return {pose.matrix(), Eigen::Matrix4d::Zero()};
}

Eigen::Isometry3d Stand(const MechanismSpec& mechanism) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() << mechanism.at, mechanism.above_m;
  pose.linear() =
      Eigen::AngleAxisd(mechanism.heading_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return pose;
}

/// Upright, its x from the one's hands to the other's, in the middle between them.
Eigen::Isometry3d Between(const Eigen::Isometry3d& rear, const Eigen::Isometry3d& front) {
  const Eigen::Vector3d x = (front.translation() - rear.translation()).normalized();
  const Eigen::Vector3d y = Eigen::Vector3d::UnitZ().cross(x).normalized();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() << x, y, x.cross(y);
  pose.translation() = (rear.translation() + front.translation()) / 2;
  return pose;
}

/// Where the mechanism as a whole is.
class Root {
 public:
  Root(const MechanismSpec& mechanism, const FindGrip& find) : stand_(Stand(mechanism)) {
    if (!mechanism.pushed_by.empty()) {
      held_ = [hands = find(mechanism.pushed_by), reach = mechanism.reach_m](double t) {
        return hands(t) * Eigen::Translation3d(reach, 0, 0);
      };
    } else if (!mechanism.front_by.empty()) {
      held_ = [front = find(mechanism.front_by), rear = find(mechanism.rear_by)](double t) {
        return Between(rear(t), front(t));
      };
    }
    for (const TakenSpec& taken : mechanism.taken) Take(taken, find(taken.by));
  }

  bool moves() const { return static_cast<bool>(held_) || !takes_.empty(); }

  Placement At(double time_s) const {
    if (held_) return Differenced(held_, time_s);
    Eigen::Isometry3d rests = stand_;
    for (const Taking& taking : takes_) {
      if (time_s < taking.at_s) break;
      const auto with_forks = [&](double t) { return taking.forks(t) * taking.T_forks_this; };
      if (time_s < taking.until_s) return Differenced(with_forks, time_s);
      rests = with_forks(taking.until_s);
    }
    return Resting(rests);
  }

 private:
  struct Taking {
    double at_s, until_s;
    Grip forks;
    Eigen::Isometry3d T_forks_this;
  };

  void Take(const TakenSpec& taken, Grip forks) {
    const Eigen::Isometry3d here(At(taken.at_s).pose);
    const Eigen::Isometry3d T_forks_this = forks(taken.at_s).inverse() * here;
    takes_.push_back({taken.at_s, taken.until_s, std::move(forks), T_forks_this});
  }

  static Placement Differenced(const auto& pose, double time_s) {
    const Eigen::Matrix4d later = pose(time_s + kHalfStep_s).matrix();
    const Eigen::Matrix4d earlier = pose(time_s - kHalfStep_s).matrix();
    return {pose(time_s).matrix(), (later - earlier) / (2 * kHalfStep_s)};
  }

  Eigen::Isometry3d stand_;
  Grip held_;
  std::vector<Taking> takes_;
};

/// Vertices of a mesh that one copy of a part carries.
struct Carried {
  std::size_t part = 0;
  int copy = 0;
  std::size_t first = 0, end = 0;
};

struct Body {
  TriangleMesh mesh;
  std::vector<Carried> carried;
};

/// The index of the part that one is on; -1: the mechanism itself.
int Below(const std::vector<PartSpec>& parts, const PartSpec& part) {
  const auto below = std::ranges::find_if(
      parts, [&](const PartSpec& one) { return !part.on.empty() && one.name == part.on; });
  return below == parts.end() ? -1 : static_cast<int>(below - parts.begin());
}

/// Whether a part has a joint or is on one that has, in a mechanism that stands.
bool HasJoint(const std::vector<PartSpec>& parts, const PartSpec& part) {
  if (part.joint.kind != Joint::Kind::kFixed) return true;
  const int below = Below(parts, part);
  return below >= 0 && HasJoint(parts, parts[static_cast<std::size_t>(below)]);
}

/// Where a mechanism is at one instant: as a whole, and each copy of each part.
struct PlacedLinkage {
  Placement root;
  std::vector<std::vector<Placement>> parts;

  const Placement& Of(const Carried& carried) const {
    return parts[carried.part][static_cast<std::size_t>(carried.copy)];
  }
};

/// The parts and what they are on.
class Linkage {
 public:
  Linkage(std::vector<PartSpec> parts, Root root)
      : parts_(std::move(parts)), root_(std::move(root)) {
    for (const PartSpec& part : parts_) on_.push_back(Below(parts_, part));
  }

  const std::vector<PartSpec>& parts() const { return parts_; }

  bool Moves(std::size_t part) const { return root_.moves() || HasJoint(parts_, parts_[part]); }

  /// Whether a part comes round, or what it is on does.
  bool ComesRound(std::size_t part) const {
    return parts_[part].joint.kind == Joint::Kind::kBelt ||
           (on_[part] >= 0 && ComesRound(static_cast<std::size_t>(on_[part])));
  }

  /// How often a copy of a part has come round, all that it is on included.
  int Rounds(std::size_t part, int copy, double time_s) const {
    const PartSpec& own = parts_[part];
    const int rounds = RoundsOf(own.joint, copy, own.count, time_s - copy * own.delay_s);
    if (on_[part] < 0) return rounds;
    const auto below = static_cast<std::size_t>(on_[part]);
    return rounds + Rounds(below, std::min(copy, parts_[below].count - 1), time_s);
  }

  /// Copies of a part ride on those of the same number.
  PlacedLinkage At(double time_s) const {
    PlacedLinkage all{root_.At(time_s), {}};
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const PartSpec& part = parts_[i];
      std::vector<Placement>& placed = all.parts.emplace_back();
      for (int copy = 0; copy < part.count; ++copy) {
        const double time = time_s - copy * part.delay_s;
        const Placement own =
            Resting(Seat(part, copy)) * JointAt(part.joint, copy, part.count, time);
        if (on_[i] < 0) {
          placed.push_back(all.root * own);
          continue;
        }
        const auto& below = all.parts[static_cast<std::size_t>(on_[i])];
        placed.push_back(below[std::min(static_cast<std::size_t>(copy), below.size() - 1)] * own);
      }
    }
    return all;
  }

 private:
  static Eigen::Isometry3d Seat(const PartSpec& part, int copy) {
    Eigen::Isometry3d seat = Eigen::Isometry3d::Identity();
    seat.translation() = part.at_m + copy * part.step_m;
    seat.linear() = (Eigen::AngleAxisd(part.heading_rad, Eigen::Vector3d::UnitZ()) *
                     Eigen::AngleAxisd(part.roll_rad, Eigen::Vector3d::UnitX()))
                        .toRotationMatrix();
    return seat;
  }

  std::vector<PartSpec> parts_;
  std::vector<int> on_;  ///< per part: the one it is on, -1: the root
  Root root_;
};

/// The first part that moves.
std::size_t Leader(const Linkage& linkage) {
  for (std::size_t i = 0; i < linkage.parts().size(); ++i) {
    if (linkage.Moves(i)) return i;
  }
  return 0;
}

/// The object's frame: upright, turned as the mechanism is as a whole, at the joint of the leader.
/// How that part turns or lies is its own matter: a box around a conveyor does not spin with its
/// first roller.
Eigen::Isometry3d ObjectFrame(const Placement& root, const Placement& leader) {
  const Eigen::Vector2d ahead = root.pose.topLeftCorner<2, 1>();
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.linear() = Eigen::AngleAxisd(std::atan2(ahead.y(), ahead.x()), Eigen::Vector3d::UnitZ())
                       .toRotationMatrix();
  frame.translation() = leader.pose.topRightCorner<3, 1>();
  return frame;
}

void MoveVertices(const PlacedLinkage& placed, const Body& body, MoverState* state) {
  state->velocities.resize(body.mesh.positions.size());
  for (const Carried& carried : body.carried) {
    const Placement& at = placed.Of(carried);
    for (std::size_t i = carried.first; i < carried.end; ++i) {
      const Eigen::Vector4d p = body.mesh.positions[i].cast<double>().homogeneous();
      state->velocities[i] = (at.rate * p).head<3>().cast<float>();
    }
  }
}

void PlaceVertices(const PlacedLinkage& placed, const Body& body, MoverState* state) {
  state->positions.resize(body.mesh.positions.size());
  state->normals.resize(state->positions.size());
  for (const Carried& carried : body.carried) {
    const Placement& at = placed.Of(carried);
    for (std::size_t i = carried.first; i < carried.end; ++i) {
      const Eigen::Vector4d p = body.mesh.positions[i].cast<double>().homogeneous();
      state->positions[i] = (at.pose * p).head<3>().cast<float>();
      state->normals[i] =
          (at.pose.topLeftCorner<3, 3>() * body.mesh.normals[i].cast<double>()).cast<float>();
    }
  }
}

/// Of a body of which something comes round, how often each vertex has.
void CountRounds(const Linkage& linkage, const Body& body, double time_s, MoverState* state) {
  const bool comes_round = std::ranges::any_of(
      body.carried, [&](const Carried& carried) { return linkage.ComesRound(carried.part); });
  if (!comes_round) return;
  state->rounds.resize(body.mesh.positions.size());
  for (const Carried& carried : body.carried) {
    std::fill(state->rounds.begin() + static_cast<std::ptrdiff_t>(carried.first),
              state->rounds.begin() + static_cast<std::ptrdiff_t>(carried.end),
              linkage.Rounds(carried.part, carried.copy, time_s));
  }
}

MoverState StateAt(const Linkage& linkage, const Body& body, std::size_t leader, double time_s,
                   MoverParts parts) {
  const PlacedLinkage placed = linkage.At(time_s);
  MoverState state;
  MoveVertices(placed, body, &state);
  if (parts == MoverParts::kVelocities) return state;
  PlaceVertices(placed, body, &state);
  CountRounds(linkage, body, time_s, &state);
  const Placement& leading = placed.parts[leader][0];
  state.T_world_object = ObjectFrame(placed.root, leading);
  state.velocity_mps = leading.rate.topRightCorner<3, 1>();
  return state;
}

bool IsClear(const PartSpec& part) { return part.paint == PartPaint::kGlass; }

/// Clear panes and lenses are seen as movers are, even where they never move.
bool IsBuilt(const PartSpec& part, bool moves) {
  return !moves && part.paint != PartPaint::kGlass && part.paint != PartPaint::kGlow;
}

}  // namespace

ObjectClass ClassOf(const MechanismSpec& mechanism) {
  const MechanismClass given = mechanism.object_class;
  return given == MechanismClass::kGoods  ? ObjectClass::kGoods
         : given == MechanismClass::kWall ? ObjectClass::kWall
                                          : ObjectClass::kFurniture;
}

std::size_t CountMovers(const MechanismSpec& mechanism) {
  const bool is_held = mechanism.IsBrought() || !mechanism.taken.empty();
  std::size_t solid = 0, clear = 0;
  for (const PartSpec& part : mechanism.parts) {
    if (IsBuilt(part, is_held || HasJoint(mechanism.parts, part))) continue;
    (IsClear(part) ? clear : solid) = 1;
  }
  return solid + clear;
}

std::vector<MechanismMesh> MakeMechanism(const MechanismSpec& mechanism, const FindGrip& find,
                                         AssetLibrary* assets, Wardrobe* wardrobe,
                                         PartPaints* paints, std::uint64_t seed,
                                         WorldBuilder* builder) {
  const auto linkage = std::make_shared<const Linkage>(mechanism.parts, Root(mechanism, find));
  const PlacedLinkage at_start = linkage->At(0);
  std::array<Body, 2> bodies;  // solid, clear
  TriangleMesh frame;
  for (std::size_t i = 0; i < mechanism.parts.size(); ++i) {
    const PartSpec& part = mechanism.parts[i];
    for (int copy = 0; copy < part.count; ++copy) {
      const auto at = static_cast<std::uint64_t>(copy);
      const TriangleMesh piece =
          DrawPart(part, copy, assets, wardrobe, paints, Dice(seed, {440, mechanism.place, i, at}));
      if (IsBuilt(part, linkage->Moves(i))) {
        AddMesh(&frame, Eigen::Isometry3d(at_start.parts[i][at].pose).cast<float>(), piece);
        continue;
      }
      Body& body = bodies[IsClear(part) ? 1 : 0];
      const std::size_t first = body.mesh.positions.size();
      AddMesh(&body.mesh, Eigen::Isometry3f::Identity(), piece);
      body.carried.push_back({i, copy, first, body.mesh.positions.size()});
    }
  }
  if (!frame.triangles.empty()) {
    builder->Add(mechanism.name + "_frame", ClassOf(mechanism),
                 [&](TriangleMesh* mesh) { AddMesh(mesh, Eigen::Isometry3f::Identity(), frame); });
  }
  std::vector<MechanismMesh> made;
  for (Body& body : bodies) {
    if (body.mesh.triangles.empty()) continue;
    MechanismMesh one{.mesh = body.mesh, .motion = {}, .is_clear = &body == &bodies[1]};
    const auto shared = std::make_shared<const Body>(std::move(body));
    one.motion = [linkage, shared, leader = Leader(*linkage), still = mechanism.still,
                  is_clear = one.is_clear](double time_s, MoverParts parts) {
      MoverState state = StateAt(*linkage, *shared, leader, still ? 0 : time_s, parts);
      state.casts_shadow = !is_clear;
      if (still) {
        state.velocity_mps.setZero();
        std::ranges::fill(state.velocities, Eigen::Vector3f::Zero());
      }
      return state;
    };
    made.push_back(std::move(one));
  }
  return made;
}

}  // namespace aisle::sim
