#pragma once

#include <cstdint>
#include <functional>

#include "harness/contract/drive_log.h"
#include "harness/contract/run.h"
#include "harness/contract/steering.h"
#include "harness/loop/closed_drive.h"
#include "harness/run/drive.h"

namespace aisle {

struct ClosedRun {
  RunResult result;
  DriveLog drive;
};

/// Drives a vehicle through a scene, steered by what the system says, and its truth-steered twin
/// beside it, which needs no teaching. Frames that the busy system never saw are in no list of the
/// result. Sets everything in the result but spec, scene_hash and threads.
ClosedRun RunClosed(const DriveScene& scene, Estimator& estimator, const MaskMaker& masks,
                    const Steering& steering, std::uint64_t seed,
                    const FrameObserver& observer = {},
                    const std::optional<TaughtCourse>& taught = {});

}  // namespace aisle
