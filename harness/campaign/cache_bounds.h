#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

namespace aisle {

/// What the frames of a cache may take. Datasets of guests may take as much again, what detectors
/// were taught a quarter of it.
inline constexpr std::uintmax_t kMostFrameBytes = std::uintmax_t{12} << 30;

/// Deletes what was least recently used below `cache` until its frames, its datasets and what was
/// taught are within their bounds. A dataset that was opened within a day stays.
void ShrinkCaches(const std::filesystem::path& cache,
                  std::uintmax_t most_frame_bytes = kMostFrameBytes);

/// Keeps a cache from filling the disk while a campaign runs.
class CacheBounds {
 public:
  /// Milliseconds of a clock that never goes back.
  using Clock = std::function<double()>;

  CacheBounds(std::filesystem::path cache, Clock now_ms,
              std::uintmax_t most_frame_bytes = kMostFrameBytes)
      : cache_(std::move(cache)),
        now_ms_(std::move(now_ms)),
        most_frame_bytes_(most_frame_bytes),
        shrunk_ms_(now_ms_()) {}

  /// Shrinks it where that was last done, or this made, more than a minute ago: the caches are
  /// looked at file by file, while others that run want to be guarded.
  void Tick();

 private:
  std::filesystem::path cache_;
  Clock now_ms_;
  std::uintmax_t most_frame_bytes_;
  double shrunk_ms_;
};

}  // namespace aisle
