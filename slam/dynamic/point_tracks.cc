#include "slam/dynamic/point_tracks.h"

#include <tbb/parallel_for.h>

#include <utility>

#include "slam/dynamic/disparity.h"
#include "slam/dynamic/flow_tracks.h"
#include "slam/dynamic/spread_features.h"
#include "slam/stereo/patch_alignment.h"

namespace aisle::slam::dynamic {
namespace {

constexpr int kDisparityRadius = 1;  // half-size pixels around a point for its first disparity

/// Disparity of a point in pixels: the dense one of half size, refined on the full images; 0 where
/// the one is unknown or the other disagrees.
double PreciseDisparity(const cv::Point2f& point, const cv::Mat1b& left, const cv::Mat1b& right,
                        const cv::Mat1f& half_disparity, const PointTrackOptions& options) {
  const cv::Point2f half((point.x - 0.5F) / 2, (point.y - 0.5F) / 2);
  const double coarse = 2 * DisparityNear(half_disparity, half, kDisparityRadius);
  if (coarse <= 0) return 0;
  StereoOptions search;
  search.search_px = 2;
  const auto aligned = AlignAlongRow(left, point, right, point.x - coarse, search);
  if (!aligned) return 0;
  const double disparity = point.x - aligned->column;
  return std::abs(disparity - coarse) <= options.disparity_gate_px ? std::max(disparity, 0.0) : 0;
}

}  // namespace

const Eigen::Vector3d* PointTrack::Before(int gap) const {
  if (static_cast<int>(seen.size()) <= gap || !(now().z() > 0)) return nullptr;
  const Eigen::Vector3d& then = seen[seen.size() - 1 - static_cast<std::size_t>(gap)];
  return then.z() > 0 ? &then : nullptr;
}

std::vector<PointTrack> FollowTracks(const std::vector<PointTrack>& tracks,
                                     const cv::Mat1b& previous_left, const cv::Mat1b& left,
                                     const PointTrackOptions& options) {
  std::vector<cv::Point2f> points;
  for (const PointTrack& track : tracks) {
    points.emplace_back(static_cast<float>(track.now().x()), static_cast<float>(track.now().y()));
  }
  const auto found = FollowPoints(previous_left, left, points, options.flow);
  std::vector<PointTrack> followed;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (!found[i]) continue;
    PointTrack track = tracks[i];
    track.seen.emplace_back(found[i]->x, found[i]->y, 0);
    if (static_cast<int>(track.seen.size()) > kLongestGap + 1) track.seen.erase(track.seen.begin());
    ++track.age;
    followed.push_back(std::move(track));
  }
  return followed;
}

void StartTracks(std::vector<PointTrack>& tracks, const std::vector<cv::Point2f>& corners,
                 cv::Size image, int& next_id, const PointTrackOptions& options) {
  const int spacing = std::max(1, cvRound(options.spacing_px));
  const cv::Size cells(image.width / spacing + 1, image.height / spacing + 1);
  cv::Mat1b taken(cells, 0);
  const auto cell = [&](double x, double y) -> unsigned char& {
    return taken(std::clamp(static_cast<int>(y) / spacing, 0, cells.height - 1),
                 std::clamp(static_cast<int>(x) / spacing, 0, cells.width - 1));
  };
  // Tracks are in order of their age: where two have come together, the older one stays.
  std::erase_if(tracks, [&](const PointTrack& track) {
    return std::exchange(cell(track.now().x(), track.now().y()), static_cast<unsigned char>(1)) !=
           0;
  });
  for (const cv::Point2f& corner : corners) {
    if (cell(corner.x, corner.y) != 0) continue;
    cell(corner.x, corner.y) = 1;
    PointTrack track;
    track.id = next_id++;
    track.seen.emplace_back(corner.x, corner.y, 0);
    tracks.push_back(std::move(track));
  }
}

void MeasureDisparities(std::vector<PointTrack>& tracks, const cv::Mat1b& left,
                        const cv::Mat1b& right, const cv::Mat1f& half_disparity,
                        const PointTrackOptions& options) {
  tbb::parallel_for(std::size_t{0}, tracks.size(), [&](std::size_t i) {
    Eigen::Vector3d& now = tracks[i].seen.back();
    const cv::Point2f point(static_cast<float>(now.x()), static_cast<float>(now.y()));
    now.z() = PreciseDisparity(point, left, right, half_disparity, options);
  });
}

}  // namespace aisle::slam::dynamic
