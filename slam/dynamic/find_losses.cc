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
/// A rig that moved by less between two frames stood: its epipolar lines mean nothing.
constexpr double kStandsBelow_m = 1e-4;

/// The epipolar lines of the true motion.
FundamentalEstimate TrueLines(const StereoCamera& camera, const Eigen::Isometry3d& T_now_before) {
  Eigen::Matrix3d K_inverse = Eigen::Matrix3d::Identity();
  K_inverse(0, 0) = 1 / camera.fx;
  K_inverse(1, 1) = 1 / camera.fy;
  K_inverse(0, 2) = -camera.cx / camera.fx;
  K_inverse(1, 2) = -camera.cy / camera.fy;
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

std::string LossOf(const DynamicStages& stages, const FundamentalEstimate& true_lines,
                   const MoverTruth& mover) {
  const dynamic::PaperStages& paper = stages.paper->stages;
  const dynamic::PaperOptions& options = stages.paper->options;
  const int least = options.group.min_points;
  const std::vector<Track> on = TracksOn(paper.tracks, mover.pixels);
  if (static_cast<int>(on.size()) < least) return "few points";
  const auto test = [&](const FundamentalEstimate& lines) {
    return dynamic::TestAgainstEpipolarLines(on, lines, paper.disparity, options.epipolar);
  };
  const std::vector<TestedPoint> tested = test(paper.fundamental);
  if (static_cast<int>(tested.size()) < least) return "no disparity";
  if (!paper.fundamental.found || CountDynamic(tested) < least) {
    return CountDynamic(test(true_lines)) < least ? "along its line" : "wrong lines";
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
  const FundamentalEstimate true_lines = TrueLines(camera, T_now_before);
  std::vector<std::string> losses;
  for (const MoverTruth& mover : movers) losses.push_back(LossOf(stages, true_lines, mover));
  return losses;
}

}  // namespace aisle::slam
