#include "slam/dynamic/find_losses.h"

#include "slam/dynamic/dynamic_stages.h"
#include "slam/dynamic/paper/disparity.h"

namespace aisle::slam {
namespace {

using dynamic::FundamentalEstimate;
using dynamic::PointGroup;
using dynamic::TestedPoint;
using dynamic::Track;

constexpr double kFits = 0.5;  // overlap from which on a rectangle is that of the mover
/// A rig that went less far between two frames stood, or turned on the spot: its epipolar lines
/// mean nothing.
constexpr double kStandsBelow_m = 1e-4;

Eigen::Matrix3d InverseIntrinsics(const StereoCamera& camera) {
  Eigen::Matrix3d K_inverse = Eigen::Matrix3d::Identity();
  K_inverse(0, 0) = 1 / camera.fx;
  K_inverse(1, 1) = 1 / camera.fy;
  K_inverse(0, 2) = -camera.cx / camera.fx;
  K_inverse(1, 2) = -camera.cy / camera.fy;
  return K_inverse;
}

/// Tracks as a rig would have that had not turned: each begins where the rotation takes what stood
/// there, however far (the homography of infinity, Hartley and Zisserman 2004, 13.4).
std::vector<Track> WithoutRotation(std::vector<Track> tracks, const StereoCamera& camera,
                                   const Eigen::Matrix3d& R_now_before) {
  const Eigen::Matrix3d K_inverse = InverseIntrinsics(camera);
  const Eigen::Matrix3d H = K_inverse.inverse() * R_now_before * K_inverse;
  for (Track& track : tracks) {
    const Eigen::Vector3d to = H * Eigen::Vector3d(track.previous.x, track.previous.y, 1);
    track.previous = {static_cast<float>(to.x() / to.z()), static_cast<float>(to.y() / to.z())};
  }
  return tracks;
}

/// The epipolar lines of the true motion.
FundamentalEstimate TrueLines(const StereoCamera& camera, const Eigen::Isometry3d& T_now_before) {
  const Eigen::Matrix3d K_inverse = InverseIntrinsics(camera);
  const Eigen::Vector3d t = T_now_before.translation();
  Eigen::Matrix3d t_cross;
  t_cross << 0, -t.z(), t.y(), t.z(), 0, -t.x(), -t.y(), t.x(), 0;
  FundamentalEstimate lines;
  lines.found = true;
  lines.F = K_inverse.transpose() * t_cross * T_now_before.linear() * K_inverse;
  lines.standing = t.norm() < kStandsBelow_m;
  return lines;
}

bool IsOn(const cv::Mat1b& pixels, const cv::Point2f& point) {
  const cv::Point at(cvRound(point.x), cvRound(point.y));
  return cv::Rect({0, 0}, pixels.size()).contains(at) && pixels(at) != 0;
}

std::vector<Track> TracksOn(const std::vector<Track>& tracks, const cv::Mat1b& pixels) {
  std::vector<Track> on;
  std::copy_if(tracks.begin(), tracks.end(), std::back_inserter(on),
               [&](const Track& track) { return IsOn(pixels, track.current); });
  return on;
}

int CountDynamic(const std::vector<TestedPoint>& points) {
  return static_cast<int>(std::count_if(points.begin(), points.end(),
                                        [](const TestedPoint& p) { return p.IsDynamic(); }));
}

bool Touches(const PointGroup& group, const cv::Mat1b& pixels) {
  return std::any_of(group.points.begin(), group.points.end(),
                     [&](const TestedPoint& p) { return IsOn(pixels, p.position); });
}

double Overlap(const cv::Rect& a, const cv::Rect& b) {
  const double both = (a & b).area();
  return both / std::max(1.0, a.area() + b.area() - both);
}

/// Of what came of the groups with points on the mover; a region's id is that of its group.
std::string LostByOutline(const DynamicStages& stages, const std::vector<bool>& is_its_group,
                          const MoverTruth& mover) {
  cv::Rect together, best;
  int regions = 0;
  for (const DynamicRegion& region : stages.regions.regions) {
    if (!is_its_group.at(static_cast<std::size_t>(region.id))) continue;
    ++regions;
    together = together.empty() ? region.box : together | region.box;
    if (best.empty() || Overlap(region.box, mover.box) > Overlap(best, mover.box)) {
      best = region.box;
    }
  }
  if (regions == 0) return "no outline";
  if (regions > 1 && Overlap(together, mover.box) >= kFits) return "in parts";
  return best.area() < mover.box.area() ? "outline too small" : "outline too large";
}

std::string LossOf(const DynamicStages& stages, const StereoCamera& camera, const MoverTruth& mover,
                   const Eigen::Isometry3d& T_now_before) {
  const dynamic::PaperStages& paper = stages.paper->stages;
  const dynamic::PaperOptions& options = stages.paper->options;
  const int least = options.group.min_points;
  const std::vector<Track> on = TracksOn(paper.tracks, mover.pixels);
  if (static_cast<int>(on.size()) < least) return "few points";
  const auto test = [&](const std::vector<Track>& tracks, const FundamentalEstimate& lines) {
    return dynamic::TestAgainstEpipolarLines(tracks, lines, paper.disparity, options.epipolar);
  };
  const std::vector<TestedPoint> tested = test(on, paper.fundamental);
  if (static_cast<int>(tested.size()) < least) return "no disparity";
  if (!paper.fundamental.found || CountDynamic(tested) < least) {
    const FundamentalEstimate lines = TrueLines(camera, T_now_before);
    const auto tracks = lines.standing ? WithoutRotation(on, camera, T_now_before.linear()) : on;
    return CountDynamic(test(tracks, lines)) < least ? "along its line" : "wrong lines";
  }
  std::vector<bool> is_its_group;
  for (const PointGroup& group : paper.groups) is_its_group.push_back(Touches(group, mover.pixels));
  if (std::count(is_its_group.begin(), is_its_group.end(), true) == 0) return "not one group";
  return LostByOutline(stages, is_its_group, mover);
}

}  // namespace

std::vector<std::string> FindLosses(const DynamicStages& stages, const StereoCamera& camera,
                                    const std::vector<MoverTruth>& movers,
                                    const Eigen::Isometry3d& T_now_before) {
  if (!stages.paper) return {};
  std::vector<std::string> losses;
  for (const MoverTruth& mover : movers) {
    losses.push_back(LossOf(stages, camera, mover, T_now_before));
  }
  return losses;
}

}  // namespace aisle::slam
