#include "harness/score/front_end.h"

namespace aisle {

std::optional<FrontEndMs> FrontEndOf(const std::map<std::string, double>& stage_ms) {
  std::optional<FrontEndMs> front_end;
  const auto add = [&](const char* stage, double FrontEndMs::*part) {
    const auto found = stage_ms.find(stage);
    if (found == stage_ms.end()) return;
    if (!front_end) front_end.emplace();
    (*front_end).*part += found->second;
  };
  add("dynamic", &FrontEndMs::dynamic);
  for (const char* stage : {"extract", "stereo", "track", "wait_for_mapping"}) {
    add(stage, &FrontEndMs::tracking);
  }
  return front_end;
}

}  // namespace aisle
