#pragma once

#include <memory>

#include "harness/io/frame_store.h"
#include "harness/loop/drive_scene.h"

namespace aisle {

/// The pictures of a drive that many are shown in the same way (one that is led, not steered), kept
/// in a store by their number: read where one was taken from the same pose at the same time, made
/// and kept where not. Pictures come without depth, whichever way they came.
std::unique_ptr<DriveScene> WithKeptFrames(std::unique_ptr<DriveScene> scene, FrameStore store);

}  // namespace aisle
