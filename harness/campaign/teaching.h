#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "harness/contract/estimator.h"
#include "harness/loop/closed_drive.h"
#include "harness/run/mask_makers.h"
#include "harness/vehicle/taught_way.h"

namespace aisle {

/// What a system made of being led along a way, its map apart.
struct Teaching {
  std::vector<TaughtPose> poses;  ///< by time
  Eigen::Isometry3d T_site_slam = Eigen::Isometry3d::Identity();
};

/// Leads a vehicle along its course by its true pose while the system looks on, as who commissions
/// it does; writes the system's finished map to `map_file` for the system that drives by it.
///
/// Ends the estimator's run. The noise of the pictures is not that of a later drive. Throws
/// SystemFault where the system has poses for less than half of the frames, or its map cannot be
/// written, and what the estimator throws.
Teaching Teach(const DriveScene& scene, Estimator& estimator, const MaskMaker& masks,
               std::uint64_t seed, const std::filesystem::path& map_file);

/// The course's way as the map has it.
TaughtCourse TaughtBy(const Teaching& teaching, const Course& course);

/// Keeps a teaching and its map in a folder that any number of processes share.
void KeepTeaching(const Teaching& teaching, const std::filesystem::path& map_file,
                  const std::filesystem::path& folder);

/// What was kept there, its map copied to `map_file`; nothing where it is absent or damaged.
std::optional<Teaching> ReadTeaching(const std::filesystem::path& folder,
                                     const std::filesystem::path& map_file);

}  // namespace aisle
