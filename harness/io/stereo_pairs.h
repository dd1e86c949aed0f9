#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace aisle {

/// When each of two cameras took the images it left, in rising order.
struct StereoStamps {
  std::vector<std::int64_t> left_ns, right_ns;
};

template <typename Image>
std::vector<std::int64_t> StampsOf(const std::map<std::int64_t, Image>& images) {
  std::vector<std::int64_t> stamps_ns;
  for (const auto& [stamp_ns, image] : images) stamps_ns.push_back(stamp_ns);
  return stamps_ns;
}

struct StampPair {
  std::int64_t left_ns = 0, right_ns = 0;
};

/// The images of one instant, 1 ms apart at most: each with the one that is nearest to it and to
/// which it is nearest. Throws InputError, with how far they are apart and the cure, where fewer
/// than half of the images find another; `source` is what the message calls the recording.
std::vector<StampPair> PairStamps(const StereoStamps& stamps, const std::string& source);

/// A left image of fewer than half of which has its right one is no whole drive: throws InputError.
/// One alone does not count: the right camera may have half the rate.
void CheckEnoughPairs(std::size_t pairs, std::size_t left_images, const std::string& source);

/// "3 of 200 left images have no right one ..." where some have none.
std::vector<std::string> NotesOnPairs(std::size_t pairs, std::size_t left_images);

}  // namespace aisle
