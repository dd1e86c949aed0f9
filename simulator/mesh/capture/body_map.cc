#include "simulator/mesh/capture/body_map.h"

#include <cctype>

namespace aisle::sim {
namespace {

enum class Side { kMiddle, kLeft, kRight };

std::string Lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// mixamorig:LeftArm, lShldr, thigh_left, Arm.R, Bip01 L Thigh, J_L_Hip.
Side SideOf(const std::string& name) {
  std::string plain = name.substr(name.rfind(':') == std::string::npos ? 0 : name.rfind(':') + 1);
  const std::string lower = Lower(plain);
  if (lower.find("left") != std::string::npos) return Side::kLeft;
  if (lower.find("right") != std::string::npos) return Side::kRight;
  std::string parted = " ";  // words apart, so that a lone letter is one
  for (const char c : plain) parted += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : ' ';
  parted = Lower(parted + " ");
  if (parted.find(" l ") != std::string::npos) return Side::kLeft;
  if (parted.find(" r ") != std::string::npos) return Side::kRight;
  const bool upper_second = plain.size() > 1 && std::isupper(static_cast<unsigned char>(plain[1]));
  if (upper_second && (plain[0] == 'l' || plain[0] == 'L')) return Side::kLeft;
  if (upper_second && (plain[0] == 'r' || plain[0] == 'R')) return Side::kRight;
  return Side::kMiddle;
}

class Finder {
 public:
  explicit Finder(const Bvh& bvh) : bvh_(bvh), children_(bvh.joints.size()) {
    for (std::size_t i = 1; i < bvh.joints.size(); ++i) {
      children_[static_cast<std::size_t>(bvh.joints[i].parent)].push_back(static_cast<int>(i));
    }
    for (const BvhJoint& joint : bvh.joints) sides_.push_back(SideOf(joint.name));
  }

  BodyMap Find() {
    map_.fill(-1);
    const std::vector<int> trunk = Trunk();
    Set(BodyPart::kPelvis, 0);
    FindLeg(Side::kLeft, BodyPart::kLeftThigh);
    FindLeg(Side::kRight, BodyPart::kRightThigh);
    const int chest = Chest(trunk);
    FindTrunk(trunk, chest);
    FindArm(chest, Side::kLeft, BodyPart::kLeftClavicle);
    FindArm(chest, Side::kRight, BodyPart::kRightClavicle);
    return map_;
  }

 private:
  const std::vector<int>& ChildrenOf(int joint) const {
    return children_[static_cast<std::size_t>(joint)];
  }
  bool IsEnd(int joint) const {
    return bvh_.joints[static_cast<std::size_t>(joint)].channels.empty();
  }
  Side SideAt(int joint) const { return sides_[static_cast<std::size_t>(joint)]; }
  void Set(BodyPart part, int joint) { map_[static_cast<std::size_t>(part)] = joint; }

  /// The joints of the middle, from the root to the head's end.
  std::vector<int> Trunk() const {
    std::vector<int> trunk = {0};
    for (;;) {
      int next = -1;
      std::size_t longest = 0;
      for (const int child : ChildrenOf(trunk.back())) {
        if (IsEnd(child) || SideAt(child) != Side::kMiddle) continue;
        const std::size_t below = Below(child);
        if (next < 0 || below > longest) next = child;
        longest = std::max(longest, below);
      }
      if (next < 0) return trunk;
      trunk.push_back(next);
    }
  }
  std::size_t Below(int joint) const {
    std::size_t count = 1;
    for (std::size_t i = static_cast<std::size_t>(joint) + 1; i < bvh_.joints.size(); ++i) {
      int above = bvh_.joints[i].parent;
      while (above > joint) above = bvh_.joints[static_cast<std::size_t>(above)].parent;
      count += above == joint ? 1 : 0;
    }
    return count;
  }

  /// A chain of joints of one side that begins below `top`; at its forks the first one goes on.
  std::vector<int> ChainBelow(int top, Side side) const {
    std::vector<int> chain;
    for (int at = top;;) {
      int next = -1;
      for (const int child : ChildrenOf(at)) {
        if (next < 0 && !IsEnd(child) && SideAt(child) == side) next = child;
      }
      if (next < 0) return chain;
      chain.push_back(next);
      at = next;
    }
  }

  void FindLeg(Side side, BodyPart thigh) {
    std::vector<int> chain = ChainBelow(0, side);
    // Some rigs have a joint between pelvis and hip: lButtock, LHipJoint.
    if (chain.size() > 4) chain.erase(chain.begin());
    if (chain.size() == 4 && Lower(NameOf(chain[0])).find("joint") != std::string::npos) {
      chain.erase(chain.begin());
    }
    if (chain.size() < 3) {
      throw ImportError(fmt::format(
          "no {} leg of hip, knee and ankle hangs on its root '{}'; names must say the side: "
          "LeftUpLeg, thigh_left, lThigh",
          side == Side::kLeft ? "left" : "right", NameOf(0)));
    }
    for (std::size_t i = 0; i < std::min<std::size_t>(chain.size(), 4); ++i) {
      Set(static_cast<BodyPart>(static_cast<std::size_t>(thigh) + i), chain[i]);
    }
  }

  /// The joint of the trunk on which arms hang; the highest with the longest.
  int Chest(const std::vector<int>& trunk) const {
    int chest = -1;
    for (const int joint : trunk) {
      if (joint == 0) continue;
      if (ChainBelow(joint, Side::kLeft).size() >= 3 && ChainBelow(joint, Side::kRight).size() >= 3)
        chest = joint;
    }
    if (chest < 0) throw ImportError("no joint above its root carries two arms");
    return chest;
  }

  void FindTrunk(const std::vector<int>& trunk, int chest) {
    Set(BodyPart::kChest, chest);
    const auto at = static_cast<std::size_t>(std::ranges::find(trunk, chest) - trunk.begin());
    if (at > 1) Set(BodyPart::kSpine, trunk[(at + 1) / 2]);
    if (at + 1 < trunk.size()) Set(BodyPart::kNeck, trunk[at + 1]);
    if (at + 2 < trunk.size()) Set(BodyPart::kHead, trunk[std::min(at + 3, trunk.size()) - 1]);
  }

  void FindArm(int chest, Side side, BodyPart clavicle) {
    std::vector<int> chain = ChainBelow(chest, side);
    const std::string second = Lower(NameOf(chain[1]));
    bool no_clavicle = chain.size() == 3;
    for (const char* elbow : {"elbow", "fore", "lower", "lowarm"}) {
      no_clavicle = no_clavicle || second.find(elbow) != std::string::npos;
    }
    const std::size_t first = static_cast<std::size_t>(clavicle) + (no_clavicle ? 1 : 0);
    const std::size_t most = no_clavicle ? 3 : 4;
    for (std::size_t i = 0; i < std::min(chain.size(), most); ++i) {
      map_[first + i] = chain[i];
    }
  }

  const std::string& NameOf(int joint) const {
    return bvh_.joints[static_cast<std::size_t>(joint)].name;
  }

  const Bvh& bvh_;
  std::vector<std::vector<int>> children_;
  std::vector<Side> sides_;
  BodyMap map_{};
};

constexpr std::array<const char*, kBodyParts> kNodeNames = {
    "pelvis",          "spine",          "chest",        "neck",       "head",
    "clavicle_left",   "upper_arm_left", "forearm_left", "hand_left",  "clavicle_right",
    "upper_arm_right", "forearm_right",  "hand_right",   "thigh_left", "shin_left",
    "foot_left",       "toes_left",      "thigh_right",  "shin_right", "foot_right",
    "toes_right"};

}  // namespace

BodyMap BodyOf(const Bvh& bvh) { return Finder(bvh).Find(); }

BodyMap BodyOf(const Model& model) {
  BodyMap map{};
  for (std::size_t i = 0; i < kBodyParts; ++i) {
    map[i] = model.FindNode(kNodeNames[i]);
    if (map[i] < 0) {
      throw ImportError(fmt::format("the model '{}' has no node '{}'", model.name, kNodeNames[i]));
    }
  }
  return map;
}

int NextPart(BodyPart part) {
  switch (part) {
    case BodyPart::kPelvis:
    case BodyPart::kSpine:
    case BodyPart::kChest:
    case BodyPart::kNeck:
    case BodyPart::kLeftClavicle:
    case BodyPart::kLeftUpperArm:
    case BodyPart::kLeftForearm:
    case BodyPart::kRightClavicle:
    case BodyPart::kRightUpperArm:
    case BodyPart::kRightForearm:
    case BodyPart::kLeftThigh:
    case BodyPart::kLeftShin:
    case BodyPart::kLeftFoot:
    case BodyPart::kRightThigh:
    case BodyPart::kRightShin:
    case BodyPart::kRightFoot:
      return static_cast<int>(part) + 1;
    default:
      return -1;
  }
}

}  // namespace aisle::sim
