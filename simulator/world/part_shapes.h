#pragma once

#include "simulator/world/mechanism.h"

namespace aisle::sim {

/// The shape of one copy of a part, in its joint's frame. Every second link of a chain is turned.
TriangleMesh DrawPart(const PartSpec& part, int copy, AssetLibrary* assets, Wardrobe* wardrobe,
                      PartPaints* paints, Dice dice);

}  // namespace aisle::sim
