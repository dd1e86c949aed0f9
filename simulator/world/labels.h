#pragma once

#include <span>
#include <string>

#include "simulator/scene/scene.h"
#include "simulator/world/world.h"

namespace aisle::sim {

ObjectClass ClassOfLabel(MeshLabel label);

/// Whether a name matches a pattern, in which * stands for anything and ? for one character; upper
/// case is as lower case.
bool Matches(const std::string& pattern, const std::string& name);

/// What a node of a building is. Its path, "Hall/Racks/Rack_03", is looked through from its own
/// name up: the first name that a rule matches decides, the user's rules before the table's, each
/// in their order; furniture where none does. The table:
///
///   floor      *floor*, *ground*, *boden*, *slab*
///   rack       *rack*, *shel*, *regal*
///   goods      *pallet*, *carton*, *goods*, *crate*, *drum*, *tote*, *kiste*
///   column     *column*, *pillar*, *saeule*, *stuetze*
///   luminaire  *lamp*, *light*, *luminaire*, *leuchte*
///   wall       *wall*, *roof*, *ceiling*, *wand*, *dach*
MeshLabel LabelOfNode(const std::string& path, std::span<const LabelRule> rules);

}  // namespace aisle::sim
