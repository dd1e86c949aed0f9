#pragma once

#include <optional>

#include "harness/loop/drive_scene.h"

namespace aisle {

/// Who tells the vehicle where it is.
class Localiser {
 public:
  virtual ~Localiser() = default;
  /// T_world_rig in a world of its own, or nothing: lost. Called once for each frame it takes, in
  /// their order.
  virtual std::optional<Eigen::Isometry3d> Locate(const Exposure& exposure) = 0;
  /// Which world of its own the pose told last is of: another number, another world.
  virtual int map_id() const { return 0; }
  /// It crashed or spoke nonsense: the drive ends.
  virtual bool failed() const { return false; }
};

/// Told the truth: steers the twin beside every drive.
class TruthLocaliser : public Localiser {
 public:
  std::optional<Eigen::Isometry3d> Locate(const Exposure& exposure) override {
    return exposure.T_world_rig;
  }
};

}  // namespace aisle
