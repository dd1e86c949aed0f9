#include "slam/dynamic/paper/paper_method.h"

#include "slam/common/parallel.h"
#include "slam/common/stopwatch.h"
#include "slam/dynamic/paper/disparity.h"
#include "slam/dynamic/paper/mark_regions.h"
#include "slam/dynamic/paper/spread_features.h"

namespace aisle::slam::dynamic {
namespace {

SegmentedRoi Segment(const cv::Rect& roi, const cv::Mat1b& left, const cv::Mat1f& disparity,
                     double colour_scale, const PaperOptions& options) {
  SegmentedRoi result;
  result.roi = roi;
  result.superpixels = SegmentUnstable(left(roi).clone(), colour_scale, options.superpixel);
  result.planes = FitDisparityPlanes(result.superpixels, disparity(roi), options.plane);
  result.boundaries = LabelBoundaries(result.superpixels.labels, result.planes, options.boundary);
  return result;
}

std::vector<SegmentedRoi> SegmentAll(const std::vector<PointGroup>& groups, const cv::Mat1b& left,
                                     const cv::Mat1f& disparity, const PaperOptions& options) {
  std::vector<SegmentedRoi> rois(groups.size());
  if (groups.empty()) return rois;
  const double colour_scale = ColourScale(left, options.superpixel);
  ParallelFor(std::size_t{0}, groups.size(), [&](std::size_t k) {
    rois[k] = Segment(groups[k].roi, left, disparity, colour_scale, options);
  });
  return rois;
}

DynamicRegions MarkAll(const std::vector<PointGroup>& groups, const std::vector<SegmentedRoi>& rois,
                       cv::Size image, const MarkOptions& options) {
  DynamicRegions dynamic;
  dynamic.mask = cv::Mat1b::zeros(image);
  for (std::size_t k = 0; k < groups.size(); ++k) {
    std::vector<cv::Point> points;
    for (const TestedPoint& point : groups[k].points) {
      points.push_back(cv::Point(cvRound(point.position.x), cvRound(point.position.y)) -
                       rois[k].roi.tl());
    }
    const auto box = MarkRegion(points, rois[k].superpixels.labels, rois[k].boundaries, options);
    if (!box) continue;
    const cv::Rect region = *box + rois[k].roi.tl();
    dynamic.mask(region).setTo(255);
    dynamic.regions.push_back({static_cast<int>(k), region, static_cast<double>(points.size())});
  }
  return dynamic;
}

}  // namespace

PaperResult DetectDynamicRegions(const StereoPair& previous, const StereoPair& current,
                                 const PaperOptions& options) {
  CV_Assert(previous.left.size() == current.left.size());
  PaperResult result;
  PaperStages& s = result.stages;
  double disparity_ms = 0, features_ms = 0, flow_ms = 0, fundamental_ms = 0, group_ms = 0,
         segment_ms = 0, mark_ms = 0;

  ParallelInvoke(
      [&] {
        s.disparity = Timed(disparity_ms, [&] {
          return ComputeDisparity(current.left, current.right, options.disparity);
        });
      },
      [&] {
        s.features =
            Timed(features_ms, [&] { return SpreadFeatures(previous.left, options.spread); });
        s.tracks = Timed(flow_ms, [&] {
          return TrackPoints(previous.left, current.left, s.features, options.flow);
        });
        s.fundamental = Timed(fundamental_ms,
                              [&] { return EstimateFundamental(s.tracks, options.fundamental); });
      });
  s.groups = Timed(group_ms, [&]() -> std::vector<PointGroup> {
    if (!s.fundamental.found) return {};
    s.points = TestAgainstEpipolarLines(s.tracks, s.fundamental, s.disparity, options.epipolar);
    return GroupDynamicPoints(s.points, current.left.size(), options.group);
  });
  s.rois =
      Timed(segment_ms, [&] { return SegmentAll(s.groups, current.left, s.disparity, options); });
  result.dynamic =
      Timed(mark_ms, [&] { return MarkAll(s.groups, s.rois, current.left.size(), options.mark); });

  result.disparity = s.disparity;
  s.stage_ms = {{"disparity", disparity_ms},
                {"features", features_ms},
                {"flow", flow_ms},
                {"fundamental", fundamental_ms},
                {"group", group_ms},
                {"segment", segment_ms},
                {"mark", mark_ms}};
  return result;
}

}  // namespace aisle::slam::dynamic
