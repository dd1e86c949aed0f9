#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <vector>

namespace aisle::sim {

/// Direct light of a solution that is still computed, kept piece by piece in their order, so that
/// who comes after an interruption goes on where it stopped. For the one who holds the LightLock.
/// A folder that cannot be written is no error: nothing is kept.
class UnfinishedLight {
 public:
  /// Reads the pieces that an earlier one left whole; what stands behind them in the file goes.
  UnfinishedLight(const std::filesystem::path& folder, std::uint64_t key);

  /// Light of the first points, one value each; empties it.
  std::vector<float> TakeBegun() { return std::move(begun_); }
  /// Keeps the light of the points that come next.
  void Append(std::span<const float> light);

 private:
  std::uint64_t key_, points_ = 0;
  std::vector<float> begun_;
  std::ofstream out_;
};

}  // namespace aisle::sim
