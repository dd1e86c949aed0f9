#include "harness/io/stereo_pairs.h"

#include <algorithm>
#include <cstdlib>

#include "harness/io/input_error.h"

namespace aisle {
namespace {

constexpr std::int64_t kTogetherNs = 1'000'000;  ///< images of one instant, at most

/// The stamp nearest to another; of two as near the earlier.
std::int64_t Nearest(const std::vector<std::int64_t>& stamps_ns, std::int64_t stamp_ns) {
  const auto after = std::ranges::lower_bound(stamps_ns, stamp_ns);
  if (after == stamps_ns.begin()) return *after;
  const std::int64_t before_ns = *std::prev(after);
  const bool is_before = after == stamps_ns.end() || stamp_ns - before_ns <= *after - stamp_ns;
  return is_before ? before_ns : *after;
}

[[noreturn]] void RefuseApart(const StereoStamps& stamps, std::size_t pairs,
                              const std::string& source) {
  if (stamps.left_ns.size() == 1 && stamps.left_ns.front() == 0) {
    throw InputError(source, 0,
                     "its images have no timestamps in their headers and cannot be paired");
  }
  std::vector<std::int64_t> off_ns;
  for (const std::int64_t stamp_ns : stamps.left_ns) {
    off_ns.push_back(std::abs(Nearest(stamps.right_ns, stamp_ns) - stamp_ns));
  }
  std::ranges::nth_element(off_ns, off_ns.begin() + std::ssize(off_ns) / 2);
  throw InputError(
      source, 0,
      fmt::format("only {} of {} left images have a right one within 1 ms of their timestamp "
                  "(median distance {:.3f} ms): the cameras are not triggered together, or one is "
                  "stamped late; correct the recording's timestamps",
                  pairs, stamps.left_ns.size(),
                  static_cast<double>(off_ns[off_ns.size() / 2]) * 1e-6));
}

}  // namespace

std::vector<StampPair> PairStamps(const StereoStamps& stamps, const std::string& source) {
  const auto& [left_ns, right_ns] = stamps;
  if (left_ns.empty() || right_ns.empty()) {
    throw InputError(source, 0, "no stereo pairs: one camera has no images");
  }
  std::vector<StampPair> pairs;
  for (const std::int64_t stamp_ns : left_ns) {
    const std::int64_t partner_ns = Nearest(right_ns, stamp_ns);
    if (std::abs(partner_ns - stamp_ns) > kTogetherNs) continue;
    if (Nearest(left_ns, partner_ns) == stamp_ns) pairs.push_back({stamp_ns, partner_ns});
  }
  if (pairs.empty() || 2 * pairs.size() < std::min(left_ns.size(), right_ns.size())) {
    RefuseApart(stamps, pairs.size(), source);
  }
  CheckEnoughPairs(pairs.size(), left_ns.size(), source);
  return pairs;
}

void CheckEnoughPairs(std::size_t pairs, std::size_t left_images, const std::string& source) {
  if (2 * pairs + 1 >= left_images) return;
  throw InputError(source, 0,
                   fmt::format("only {} of {} left images have a right one: add the missing ones, "
                               "or remove the left ones without",
                               pairs, left_images));
}

std::vector<std::string> NotesOnPairs(std::size_t pairs, std::size_t left_images) {
  if (pairs == left_images) return {};
  return {fmt::format("skipped {} of {} left images, which have no right one", left_images - pairs,
                      left_images)};
}

}  // namespace aisle
