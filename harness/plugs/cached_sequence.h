#pragma once

#include <functional>
#include <memory>

#include "harness/contract/sequence.h"
#include "harness/io/frame_store.h"

namespace aisle {

/// A sequence whose frames are kept in a store: what is there is read, what is not is made by the
/// original and kept; in a store that cannot be written nothing is, and every frame is made. The
/// original is opened when the first frame is missing, and not at all when none is. Frames come
/// without depth, whichever way they came. `name` is the sequence's own: who filled the store may
/// have had another for the same frames.
std::unique_ptr<Sequence> OpenCached(
    const FrameStore& store, const std::string& name,
    std::function<std::unique_ptr<Sequence>(std::uint64_t* content_hash)> open_original,
    std::uint64_t* content_hash = nullptr);

}  // namespace aisle
