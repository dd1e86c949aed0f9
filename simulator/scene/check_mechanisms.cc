#include "simulator/scene/check_mechanisms.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "simulator/scene/check_given.h"
#include "simulator/scene/hall.h"

namespace aisle::sim {
namespace {

class MechanismChecker {
 public:
  MechanismChecker(const Scene& scene, const MechanismSpec& one, std::string key, Issues* issues)
      : scene_(scene), one_(one), key_(std::move(key)), issues_(issues) {}

  void Run() {
    if (!one_.IsBrought() && !InHall(scene_.hall, one_.at, 0)) {
      Say(one_.mark, ".at",
          fmt::format("[{:g}, {:g}] is outside {}", one_.at.x(), one_.at.y(),
                      HallText(scene_.hall)));
    }
    std::set<std::string> names;
    for (std::size_t i = 0; i < one_.parts.size(); ++i) CheckPart(i, &names);
    CheckPeople();
    for (std::size_t i = 0; i < one_.taken.size(); ++i) CheckTaken(i);
  }

 private:
  void Say(Mark mark, const std::string& part, const std::string& what) {
    issues_->Add(mark, key_ + part, what);
  }

  void CheckPart(std::size_t index, std::set<std::string>* names) {
    const PartSpec& part = one_.parts[index];
    const std::string key = fmt::format(".parts[{}]", index);
    if (!part.on.empty() && !names->contains(part.on)) {
      Say(part.mark, key + ".on",
          fmt::format("no earlier part is named '{}'; a part comes after the one it is on",
                      part.on));
    }
    if (!part.name.empty() && !names->insert(part.name).second) {
      Say(part.mark, key + ".name", fmt::format("another part is already named '{}'", part.name));
    }
    if (part.shape == PartShape::kModel && part.model.empty()) {
      Say(part.mark, key + ".model", "the model of a shape; example: model: roll_cage");
    }
    CheckGiven(part.shape_given, KeysOf(part.shape), key_ + key, issues_);
    CheckGiven(part.joint_given, KeysOf(part.joint.kind), key_ + key + ".joint", issues_);
    const std::string wrong = JointError(part.joint);
    if (!wrong.empty()) Say(part.mark, key + ".joint", wrong);
  }

  static KindKeys KeysOf(PartShape shape) {
    switch (shape) {
      case PartShape::kBox:
        break;
      case PartShape::kCylinder:
        return {"a cylinder", {"size_m"}};
      case PartShape::kLink:
        return {"a link", {"size_m"}};
      case PartShape::kModel:
        return {"a model", {"model"}};
      case PartShape::kPallet:
        return {"a pallet", {"goods", "goods_m"}};
    }
    return {"a box", {"size_m"}};
  }

  static KindKeys KeysOf(Joint::Kind kind) {
    switch (kind) {
      case Joint::Kind::kFixed:
        break;
      case Joint::Kind::kHinge:
        return {"a hinge", {"moves", "start_deg", "to_deg"}};
      case Joint::Kind::kSlider:
        return {"a slider", {"moves", "start_m", "to_m"}};
      case Joint::Kind::kPendulum:
        return {"a pendulum", {"swing_deg", "length_m", "decay_s", "at_s"}};
      case Joint::Kind::kSpin:
        return {"a spin", {"rate_hz", "from_s", "until_s", "ramp_s"}};
      case Joint::Kind::kBelt:
        return {"a belt", {"speed_mps", "length_m", "from_s", "until_s", "ramp_s"}};
      case Joint::Kind::kChain:
        return {"a chain", {"swing_m", "length_m", "decay_s", "at_s"}};
    }
    return {"a fixed joint", {}};
  }

  static std::string JointError(const Joint& joint) {
    using Kind = Joint::Kind;
    if (std::abs(joint.axis.norm() - 1) > 1e-6) return "its axis must not be [0, 0, 0]";
    const bool moves = joint.kind == Kind::kHinge || joint.kind == Kind::kSlider;
    if (moves && joint.moves.empty()) {
      return "a hinge or slider needs moves; example: moves: [{at_s: 3, to_m: 2, over_s: 2}]";
    }
    const bool swings = joint.kind == Kind::kPendulum || joint.kind == Kind::kChain;
    if (swings && joint.swing == 0) {
      return joint.kind == Kind::kChain ? "a chain needs swing_m; example: swing_m: 0.4"
                                        : "a pendulum needs swing_deg; example: swing_deg: 12";
    }
    const bool runs = joint.kind == Kind::kSpin || joint.kind == Kind::kBelt;
    if (runs && joint.speed == 0) {
      return joint.kind == Kind::kSpin ? "a spin needs rate_hz; example: rate_hz: 1.5"
                                       : "a belt needs speed_mps; example: speed_mps: 0.4";
    }
    if (runs && joint.run.to_s < joint.run.from_s + joint.run.ramp_s) {
      return "`until_s` must be at least `ramp_s` later than `from_s`";
    }
    if (joint.kind == Kind::kChain && std::abs(joint.axis.z()) > 1e-6) {
      return "a chain swings horizontally: the third number of its axis must be 0";
    }
    return MovesError(joint.moves);
  }

  /// A person who is there when it is, and has hands that are known.
  void CheckPerson(const std::string& name, const char* key) {
    const auto found = std::ranges::find(scene_.people, name, &PersonSpec::name);
    if (found == scene_.people.end()) {
      Say(one_.mark, key, fmt::format("no person named '{}'", name));
    } else if (!found->capture.bvh.name.empty() || !found->capture.mesh.name.empty()) {
      Say(one_.mark, key,
          fmt::format("'{}' has its own motion or body (`bvh`, `mesh`), which cannot hold "
                      "anything; name a person with a `model` and `steps`",
                      name));
    } else if (found->level > one_.level) {
      Say(one_.mark, key, "its level must be that of the person who brings it, or higher");
    }
  }

  void CheckPeople() {
    if (one_.front_by.empty() != one_.rear_by.empty()) {
      Say(one_.mark, "", "`front_by` and `rear_by` go together: two people carry it");
    }
    const int ways = !one_.pushed_by.empty() + !one_.front_by.empty() + !one_.taken.empty();
    if (ways > 1) Say(one_.mark, "", "it can only be one of pushed, carried or taken");
    for (const auto& [name, key] :
         {std::pair(one_.pushed_by, ".pushed_by"), std::pair(one_.front_by, ".front_by"),
          std::pair(one_.rear_by, ".rear_by")}) {
      if (!name.empty()) CheckPerson(name, key);
    }
  }

  void CheckTaken(std::size_t index) {
    const TakenSpec& taken = one_.taken[index];
    const std::string key = fmt::format(".taken[{}]", index);
    const auto found = std::ranges::find(scene_.vehicles, taken.by, &VehicleSpec::name);
    if (found == scene_.vehicles.end()) {
      Say(taken.mark, key + ".by", fmt::format("no vehicle named '{}'", taken.by));
    } else if (found->level > one_.level) {
      Say(taken.mark, key + ".by",
          "its level must be that of the vehicle that takes it, or higher");
    }
    if (taken.until_s <= taken.at_s) {
      Say(taken.mark, key, "`until_s` must be later than `at_s`");
    }
    if (index > 0 && taken.at_s < one_.taken[index - 1].until_s) {
      Say(taken.mark, key + ".at_s", "the previous vehicle still has it");
    }
  }

  const Scene& scene_;
  const MechanismSpec& one_;
  std::string key_;
  Issues* issues_;
};

}  // namespace

void CheckMechanisms(const Scene& scene, Issues* issues) {
  for (std::size_t i = 0; i < scene.mechanisms.size(); ++i) {
    MechanismChecker(scene, scene.mechanisms[i], fmt::format("mechanisms[{}]", i), issues).Run();
  }
}

}  // namespace aisle::sim
