#pragma once

#include <functional>

#include "harness/contract/sequence.h"
#include "harness/io/frame_store.h"

namespace aisle {

/// A frame as a store has it, without depth, whichever way it came: what `make` gives is made so
/// and kept, where the store can be written.
SequenceFrame MakeAndKeep(const FrameStore& store, const std::function<SequenceFrame()>& make);

}  // namespace aisle
