#include "simulator/world/labels.h"

#include <array>
#include <cctype>
#include <utility>

namespace aisle::sim {
namespace {

constexpr std::array<std::pair<const char*, MeshLabel>, 28> kTable = {{
    {"*floor*", MeshLabel::kFloor},       {"*ground*", MeshLabel::kFloor},
    {"*boden*", MeshLabel::kFloor},       {"*slab*", MeshLabel::kFloor},
    {"*rack*", MeshLabel::kRack},         {"*shelf*", MeshLabel::kRack},
    {"*shelv*", MeshLabel::kRack},        {"*regal*", MeshLabel::kRack},
    {"*pallet*", MeshLabel::kGoods},      {"*carton*", MeshLabel::kGoods},
    {"*goods*", MeshLabel::kGoods},       {"*crate*", MeshLabel::kGoods},
    {"*drum*", MeshLabel::kGoods},        {"*tote*", MeshLabel::kGoods},
    {"*kiste*", MeshLabel::kGoods},       {"*column*", MeshLabel::kColumn},
    {"*pillar*", MeshLabel::kColumn},     {"*saeule*", MeshLabel::kColumn},
    {"*stuetze*", MeshLabel::kColumn},    {"*lamp*", MeshLabel::kLuminaire},
    {"*light*", MeshLabel::kLuminaire},   {"*luminaire*", MeshLabel::kLuminaire},
    {"*leuchte*", MeshLabel::kLuminaire}, {"*wall*", MeshLabel::kWall},
    {"*roof*", MeshLabel::kWall},         {"*ceiling*", MeshLabel::kWall},
    {"*wand*", MeshLabel::kWall},         {"*dach*", MeshLabel::kWall},
}};

char Lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

/// The label of one name; none where nothing matches.
std::optional<MeshLabel> LabelOfName(const std::string& name, std::span<const LabelRule> rules) {
  for (const LabelRule& rule : rules) {
    if (Matches(rule.nodes, name)) return rule.label;
  }
  for (const auto& [pattern, label] : kTable) {
    if (Matches(pattern, name)) return label;
  }
  return std::nullopt;
}

}  // namespace

ObjectClass ClassOfLabel(MeshLabel label) {
  return static_cast<ObjectClass>(static_cast<int>(ObjectClass::kFloor) + static_cast<int>(label));
}

bool Matches(const std::string& pattern, const std::string& name) {
  // The last * met may swallow one character more whenever what follows it does not fit.
  std::size_t p = 0, n = 0, star = std::string::npos, after = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      after = n;
    } else if (p < pattern.size() && (pattern[p] == '?' || Lower(pattern[p]) == Lower(name[n]))) {
      ++p;
      ++n;
    } else if (star != std::string::npos) {
      p = star + 1;
      n = ++after;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string::npos;
}

MeshLabel LabelOfNode(const std::string& path, std::span<const LabelRule> rules) {
  for (std::size_t end = path.size();;) {
    const std::size_t slash = end == 0 ? std::string::npos : path.rfind('/', end - 1);
    const std::size_t begin = slash == std::string::npos ? 0 : slash + 1;
    if (const auto label = LabelOfName(path.substr(begin, end - begin), rules)) return *label;
    if (slash == std::string::npos) return MeshLabel::kFurniture;
    end = slash;
  }
}

}  // namespace aisle::sim
