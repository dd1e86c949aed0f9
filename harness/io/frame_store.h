#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "harness/contract/sequence.h"

namespace aisle {

/// What a sequence says of itself before its first frame.
struct SequenceHeader {
  std::string name;
  StereoCalibration calibration;
  double rate_hz = 0;
  std::uint64_t content_hash = 0;
  std::vector<FrameRequest> schedule;
};

/// Frames of one sequence on disk, one checksummed file each, shared by any number of processes: a
/// file is whole or absent. Depth but for its grid, and the right camera's depth and labels, are
/// not kept: no score needs them.
class FrameStore {
 public:
  /// `folder` is made on the first write.
  explicit FrameStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Absent where never written or damaged.
  std::optional<SequenceHeader> ReadHeader() const;
  void WriteHeader(const SequenceHeader& header) const;
  std::optional<SequenceFrame> Read(std::int64_t frame_id) const;
  /// How many frames are there, whole or damaged.
  std::int64_t Count() const;
  void Write(const SequenceFrame& frame) const;

 private:
  std::filesystem::path FramePath(std::int64_t frame_id) const;
  std::filesystem::path folder_;
};

/// Deletes whole sequences below `root`, least recently opened first, until at most `max_bytes`
/// remain; those opened within `grace` stay. Readers of a deleted sequence find its frames absent
/// and make them again; who cannot (a system of others amid a dataset) needs the grace.
void ShrinkStore(const std::filesystem::path& root, std::uintmax_t max_bytes,
                 std::chrono::hours grace = {});

}  // namespace aisle
