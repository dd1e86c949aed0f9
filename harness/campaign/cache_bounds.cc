#include "harness/campaign/cache_bounds.h"

#include "harness/io/frame_store.h"

namespace aisle {

void ShrinkCaches(const std::filesystem::path& cache, std::uintmax_t most_frame_bytes) {
  ShrinkStore(cache / "frames", most_frame_bytes);
  ShrinkStore(cache / "taught", most_frame_bytes / 4);
  ShrinkStore(cache / "datasets", most_frame_bytes, std::chrono::hours(24));
}

void CacheBounds::Tick() {
  constexpr double kEvery_ms = 60e3;
  if (now_ms_() - shrunk_ms_ <= kEvery_ms) return;
  ShrinkCaches(cache_, most_frame_bytes_);
  shrunk_ms_ = now_ms_();  // anew: a look at a full cache may take longer than that
}

}  // namespace aisle
