#include "harness/campaign/progress.h"

#include <algorithm>
#include <cstdio>
#include <string_view>

namespace aisle {

bool TakeFrameCount(const std::string& line, Progress* progress) {
  int done = 0, total = 0;
  if (std::sscanf(line.c_str(), "@progress %d %d", &done, &total) != 2) return false;
  progress->total = std::max(total, 0);
  progress->done = std::clamp(done, 0, progress->total);
  return true;
}

bool TakeProgress(const std::string& line, Progress* progress) {
  if (TakeFrameCount(line, progress)) return true;
  constexpr std::string_view kStage = "@stage ";
  if (!line.starts_with(kStage)) return false;
  progress->stage = line.substr(kStage.size());
  return true;
}

void TellProgress(std::size_t done, std::size_t total) {
  fmt::print("@progress {} {}\n", done, total);
  std::fflush(stdout);
}

void TellStage(const std::string& what) {
  fmt::print("@stage {}\n", what);
  std::fflush(stdout);
}

}  // namespace aisle
