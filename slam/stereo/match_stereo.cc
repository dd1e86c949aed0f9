#include "slam/stereo/match_stereo.h"

#include <algorithm>
#include <cmath>

#include "slam/common/median.h"
#include "slam/stereo/parabola_alignment.h"
#include "slam/stereo/patch_alignment.h"

namespace aisle::slam {
namespace {

/// Right features by the image rows they could be matched from; indices rise within a row.
class RowTable {
 public:
  RowTable(const ImageFeatures& image, double band_px)
      : rows_(static_cast<std::size_t>(Height(image))) {
    for (int i = 0; i < image.features.size(); ++i) {
      const Keypoint& keypoint = image.features.keypoints[static_cast<std::size_t>(i)];
      const double band = band_px * image.pyramid.scales[static_cast<std::size_t>(keypoint.level)];
      const int first = std::max(0, static_cast<int>(std::floor(keypoint.pixel.y - band)));
      const int last =
          std::min(Height(image) - 1, static_cast<int>(std::ceil(keypoint.pixel.y + band)));
      for (int y = first; y <= last; ++y) rows_[static_cast<std::size_t>(y)].push_back(i);
    }
  }

  const std::vector<int>& At(float y) const {
    const auto row = std::clamp<std::ptrdiff_t>(std::lround(y), 0, std::ssize(rows_) - 1);
    return rows_[static_cast<std::size_t>(row)];
  }

 private:
  static int Height(const ImageFeatures& image) {
    return image.pyramid.levels.empty() ? 1 : image.pyramid.levels.front().rows;
  }
  std::vector<std::vector<int>> rows_;
};

/// The right feature most like left feature i within reach, or -1.
int BestRightFeature(const ImageFeatures& left, std::size_t i, const ImageFeatures& right,
                     const RowTable& rows, double largest_disparity, const StereoOptions& options) {
  const Keypoint& keypoint = left.features.keypoints[i];
  int best = -1, least = options.descriptor_distance;
  for (const int candidate : rows.At(keypoint.pixel.y)) {
    const auto c = static_cast<std::size_t>(candidate);
    const Keypoint& other = right.features.keypoints[c];
    const double disparity = keypoint.pixel.x - other.pixel.x;
    // A far point's disparity may come out slightly negative before alignment.
    if (disparity < -1 || disparity > largest_disparity) continue;
    if (std::abs(other.level - keypoint.level) > 1) continue;
    const int distance =
        HammingDistance(left.features.descriptors[i], right.features.descriptors[c]);
    if (distance < least) least = distance, best = candidate;
  }
  return best;
}

struct Candidate {
  Disparity disparity;
  double mismatch = 0;
};

/// Features further apart than a patch's noise allows are wrong however close their descriptors.
void DropMismatched(std::vector<Candidate>& candidates, double worst_to_median) {
  std::vector<double> mismatches;
  for (const Candidate& candidate : candidates) {
    if (candidate.disparity.known()) mismatches.push_back(candidate.mismatch);
  }
  if (mismatches.empty()) return;
  const double worst = worst_to_median * Median(std::move(mismatches));
  for (Candidate& candidate : candidates) {
    if (candidate.mismatch > worst) candidate.disparity = {};
  }
}

}  // namespace

std::vector<Disparity> MatchStereo(const ImageFeatures& left, const ImageFeatures& right,
                                   const StereoCamera& camera, const StereoOptions& options) {
  const double nearest = options.nearest_m > 0 ? options.nearest_m : camera.baseline_m;
  const double largest_disparity = camera.fx * camera.baseline_m / nearest;
  const RowTable rows(right, options.row_band_px);
  const auto align =
      options.refinement == RowRefinement::kParabola ? AlignByParabola : AlignAlongRow;
  std::vector<Candidate> candidates(left.features.keypoints.size());
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const int match = BestRightFeature(left, i, right, rows, largest_disparity, options);
    if (match < 0) continue;
    const Keypoint& keypoint = left.features.keypoints[i];
    const cv::Point2f right_pixel = right.features.keypoints[static_cast<std::size_t>(match)].pixel;
    const auto level = static_cast<std::size_t>(keypoint.level);
    const auto aligned = align(
        left.pyramid.levels[level], left.pyramid.ToLevel(keypoint.pixel, keypoint.level),
        right.pyramid.levels[level], right.pyramid.ToLevel(right_pixel, keypoint.level).x, options);
    if (!aligned) continue;
    const double right_x = right.pyramid.ToFull({aligned->column, 0}, keypoint.level).x;
    const double disparity = keypoint.pixel.x - right_x;
    if (disparity <= 0) continue;  // at infinity: a direction, no depth
    const double sigma =
        left.pyramid.scales[level] * std::hypot(aligned->sigma, options.disparity_noise_px);
    candidates[i] = {{static_cast<float>(disparity), static_cast<float>(sigma)}, aligned->mismatch};
  }
  DropMismatched(candidates, options.worst_to_median);
  std::vector<Disparity> disparities;
  for (const Candidate& candidate : candidates) disparities.push_back(candidate.disparity);
  return disparities;
}

}  // namespace aisle::slam
