#pragma once

#include <optional>
#include <string>
#include <vector>

#include "simulator/scene/issues.h"
#include "simulator/scene/yaml_tree.h"

namespace aisle::sim {

/// A hall as a scene names it.
struct NamedHall {
  std::string name;  ///< as it stands there
  std::string key;   ///< "use" of a hall, or "hall" of what varies
  Mark mark;         ///< of the name
};

/// Whether a key of a scene's top is part of what a hall's file may say.
bool IsHallKey(const std::string& key);

/// Whether a scene's tree takes its hall from files.
bool NamesHalls(const YamlValue& tree);

/// The halls it names, in its order; what is no name goes to `issues`.
std::vector<NamedHall> HallsOf(const YamlValue& tree, Issues* issues);

/// The tree of a hall's file, which is added to the files of `issues`: `use` of its hall is the
/// name, and `about` is left out. The file is sought from the folder of the one that names it, then
/// among the scenes that come with the program. Nothing where there is none, or where it says more
/// than a hall may, with the mistakes in `issues`.
std::optional<YamlValue> ReadHall(const NamedHall& hall, Issues* issues);

/// Takes all that a file says of its hall out of its tree.
void RemoveHall(YamlValue& tree);

/// "cold_store" of "halls/cold_store.yaml": what reports call it.
std::string HallName(const std::string& file);

}  // namespace aisle::sim
