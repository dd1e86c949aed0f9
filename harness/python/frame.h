#pragma once

#include <memory>
#include <mutex>

#include "harness/contract/sequence.h"
#include "harness/plugs/simulated_sequence.h"

namespace aisle::python {

/// A scene that is open, shared by its simulator and the frames that came of it.
using Source = std::shared_ptr<const SimulationForExport>;

/// A picture with its truth. What joins it to the next one is made when it is asked for.
struct Frame {
  FrameRequest request;
  SequenceFrame shown;
  Source source = nullptr;  ///< null: of a closed drive, which has no next frame yet
  bool planned = false;     ///< taken at the scene's own time and pose

  mutable std::once_flag once = {};
  mutable FrameMotion motion = {};  ///< to the scene's next frame
};
using FramePtr = std::shared_ptr<Frame>;

}  // namespace aisle::python
