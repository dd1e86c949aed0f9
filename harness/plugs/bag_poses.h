#pragma once

namespace aisle {

/// Has the simulator read bags, whose format it does not know, by our reader.
void ReadBagsForScenes();

}  // namespace aisle
