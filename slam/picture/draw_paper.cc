#include "slam/picture/draw_paper.h"

#include <opencv2/imgproc.hpp>
#include <set>

#include "slam/dynamic/paper/disparity.h"
#include "slam/dynamic/paper/flow_tracks.h"
#include "slam/dynamic/paper/mark_regions.h"

namespace aisle::slam::picture {
namespace {

using dynamic::BoundaryType;
using dynamic::PaperStages;
using dynamic::SegmentedRoi;
using dynamic::TestedPoint;

constexpr double kDim = 0.45;  // of what lies outside the regions of interest
const Colour kLost(120, 120, 120), kOutlier(40, 160, 255), kBorder(255, 120, 40);

cv::Point At(const cv::Point2f& p) { return {cvRound(p.x), cvRound(p.y)}; }

StagePicture DrawPoints(const cv::Mat1b& left, const PaperStages& s) {
  cv::Mat3b picture = OnGrey(left);
  std::set<std::pair<float, float>> followed;
  for (const dynamic::Track& track : s.tracks)
    followed.insert({track.previous.x, track.previous.y});
  for (const cv::Point2f& point : s.features) {
    if (followed.count({point.x, point.y}) == 0) {
      cv::drawMarker(picture, At(point), ToScalar(kLost), cv::MARKER_TILTED_CROSS, 5);
    }
  }
  for (std::size_t k = 0; k < s.tracks.size(); ++k) {
    const bool inlier = k < s.fundamental.is_inlier.size() && s.fundamental.is_inlier[k];
    const cv::Scalar colour = ToScalar(inlier ? kStatic : kOutlier);
    cv::line(picture, At(s.tracks[k].previous), At(s.tracks[k].current), colour, 1, cv::LINE_AA);
    cv::circle(picture, At(s.tracks[k].current), 2, colour, cv::FILLED, cv::LINE_AA);
  }
  return {"points",
          Framed(picture, "1  FAST corners spread by a quadtree, tracked by Lucas-Kanade",
                 {{kStatic, "supports F"}, {kOutlier, "does not"}, {kLost, "lost"}},
                 fmt::format("{} points, {} tracked, median flow {:.2f} px", s.features.size(),
                             s.tracks.size(), dynamic::MedianFlow(s.tracks)))};
}

double MostOf(const cv::Mat1f& disparity) {
  double most = 0;
  cv::minMaxLoc(disparity, nullptr, &most);
  return std::max(most, 1.0);
}

std::vector<LegendEntry> DisparityLegend(double most) {
  return {{HeatColour(0, most), "0 px (far)"},
          {HeatColour(most / 2, most), fmt::format("{:.0f} px", most / 2)},
          {HeatColour(most, most), fmt::format("{:.0f} px (near)", most)},
          {{0, 0, 0}, "unknown"}};
}

StagePicture DrawDisparity(const PaperStages& s) {
  const double most = MostOf(s.disparity);
  const double known = cv::countNonZero(s.disparity >= 0);
  return {"disparity",
          Framed(HeatOf(s.disparity, most), "2  Disparity by SGBM", DisparityLegend(most),
                 fmt::format("{:.0f} % of the pixels known",
                             100 * known / static_cast<double>(s.disparity.total())))};
}

/// A ring as wide as the threshold and a disc as wide as the distance, both magnified.
StagePicture DrawEpipolar(const cv::Mat1b& left, const PaperStages& s) {
  constexpr double kMagnified = 5, kLargestPx = 24;
  cv::Mat3b picture = OnGrey(left, 0.7);
  std::ptrdiff_t dynamic = 0;
  for (const TestedPoint& point : s.points) {
    const Colour& colour = point.IsDynamic() ? kDynamic : kStatic;
    const double disc = std::min(kMagnified * point.epipolar_px, kLargestPx);
    cv::circle(picture, At(point.position), cvRound(disc), ToScalar(colour), cv::FILLED,
               cv::LINE_AA);
    cv::circle(picture, At(point.position), cvRound(kMagnified * point.threshold_px),
               ToScalar(kNote), 1, cv::LINE_AA);
    dynamic += point.IsDynamic() ? 1 : 0;
  }
  const std::string geometry =
      !s.fundamental.found ? "no fundamental matrix found: nothing is tested"
      : s.fundamental.standing
          ? "the camera stands: distance from the point itself"
          : fmt::format("F from {} of {} tracks, {} samples", s.fundamental.inliers,
                        s.tracks.size(), s.fundamental.iterations);
  return {
      "epipolar",
      Framed(
          picture, "3  Distance from the epipolar line, eqs (1) to (3), drawn 5 times larger",
          {{kStatic, "D_epi within"}, {kDynamic, "D_epi beyond: dynamic"}, {kNote, "ring: T_epi"}},
          fmt::format("{}; {} of {} points dynamic", geometry, dynamic, s.points.size()))};
}

StagePicture DrawGroups(const cv::Mat1b& left, const PaperTrace& trace) {
  const PaperStages& s = trace.stages;
  cv::Mat3b picture = OnGrey(left, 0.8);
  std::size_t dynamic = 0, grouped = 0;
  for (const TestedPoint& point : s.points) {
    if (!point.IsDynamic()) continue;
    ++dynamic;
    cv::circle(picture, At(point.position), 3, ToScalar(kUnsure), 1, cv::LINE_AA);
  }
  for (std::size_t k = 0; k < s.groups.size(); ++k) {
    const Colour colour = ColourOf(static_cast<int>(k));
    for (const TestedPoint& point : s.groups[k].points) {
      cv::circle(picture, At(point.position), 3, ToScalar(colour), cv::FILLED, cv::LINE_AA);
    }
    grouped += s.groups[k].points.size();
    cv::rectangle(picture, s.groups[k].roi, ToScalar(colour), 2, cv::LINE_8);
    Plate(fmt::format("group {}: {} points", k, s.groups[k].points.size()), s.groups[k].roi.tl(),
          colour, picture);
  }
  return {"groups",
          Framed(picture, "4  Groups of dynamic points, eq (4), and their regions of interest",
                 {{ColourOf(0), "a colour per group"}, {kUnsure, "dynamic, in no group"}},
                 fmt::format("groups of {} points or more: {}; {} of {} dynamic points in none",
                             trace.options.group.min_points, s.groups.size(), dynamic - grouped,
                             dynamic))};
}

/// The image, bright inside the regions of interest alone.
cv::Mat3b Spotlight(const cv::Mat1b& left, const std::vector<SegmentedRoi>& rois,
                    double inside = 0.9) {
  cv::Mat3b picture = OnGrey(left, kDim);
  for (const SegmentedRoi& roi : rois) OnGrey(left(roi.roi), inside).copyTo(picture(roi.roi));
  return picture;
}

/// Calls paint(pixel, neighbour) for each pixel of a ROI whose right or lower neighbour belongs to
/// another superpixel.
template <typename Paint>
void ForBorders(const SegmentedRoi& roi, const Paint& paint) {
  const cv::Mat1i& labels = roi.superpixels.labels;
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) {
      const int here = labels(y, x);
      if (x + 1 < labels.cols && labels(y, x + 1) != here)
        paint(cv::Point(x, y), cv::Point(x + 1, y));
      if (y + 1 < labels.rows && labels(y + 1, x) != here)
        paint(cv::Point(x, y), cv::Point(x, y + 1));
    }
  }
}

StagePicture DrawSuperpixels(const cv::Mat1b& left, const PaperStages& s) {
  cv::Mat3b picture = Spotlight(left, s.rois);
  double asked = 0, full = 0;
  std::size_t count = 0;
  for (const SegmentedRoi& roi : s.rois) {
    ForBorders(roi, [&](cv::Point at, cv::Point) { picture(at + roi.roi.tl()) = kBorder; });
    asked += static_cast<double>(roi.superpixels.pixels_classified);
    full += static_cast<double>(roi.roi.area()) * roi.superpixels.iterations;
    count += roi.superpixels.centres.size();
  }
  const std::string caption =
      s.rois.empty() ? "no region of interest"
                     : fmt::format(
                           "{} superpixels; {:.0f} % of full SLIC's pixel visits inside, "
                           "none outside",
                           count, 100 * asked / std::max(full, 1.0));
  return {"superpixels",
          Framed(picture, "5  SLIC of the unstable pixels, eqs (5) to (7), in the regions alone",
                 {{kBorder, "superpixel border"}}, caption)};
}

StagePicture DrawPlanes(const cv::Mat1b& left, const PaperStages& s) {
  const double most = MostOf(s.disparity);
  cv::Mat3b picture = Spotlight(left, s.rois);
  std::size_t fitted = 0, all = 0;
  for (const SegmentedRoi& roi : s.rois) {
    const cv::Mat1i& labels = roi.superpixels.labels;
    for (int y = 0; y < labels.rows; ++y) {
      for (int x = 0; x < labels.cols; ++x) {
        const auto& plane = roi.planes[static_cast<std::size_t>(labels(y, x))];
        picture(cv::Point(x, y) + roi.roi.tl()) =
            plane.valid ? HeatColour(std::max(plane.At(x, y), 0.0), most) : Colour(0, 0, 0);
      }
    }
    all += roi.planes.size();
    for (const auto& plane : roi.planes) fitted += plane.valid ? 1 : 0;
  }
  const std::string caption = all == 0
                                  ? "no region of interest"
                                  : fmt::format("{} of {} superpixels have a plane", fitted, all);
  return {"planes", Framed(picture, "6  Disparity plane of each superpixel, eq (8)",
                           DisparityLegend(most), caption)};
}

StagePicture DrawBoundaries(const cv::Mat1b& left, const PaperStages& s) {
  cv::Mat3b picture = Spotlight(left, s.rois, 0.6);
  std::map<BoundaryType, int> counts;
  for (const SegmentedRoi& roi : s.rois) {
    const cv::Mat1i& labels = roi.superpixels.labels;
    ForBorders(roi, [&](cv::Point at, cv::Point other) {
      const auto type = roi.boundaries.find(std::minmax(int(labels(at)), int(labels(other))));
      if (type == roi.boundaries.end()) return;
      picture(at + roi.roi.tl()) = ColourOf(type->second);
      // Twice as wide as the rest: these are what the rays look for.
      if (dynamic::IsOcclusion(roi.boundaries, type->first.first, type->first.second)) {
        picture(other + roi.roi.tl()) = ColourOf(type->second);
      }
    });
    for (const auto& [key, type] : roi.boundaries) ++counts[type];
  }
  const auto entry = [&](BoundaryType type, const char* text) {
    return LegendEntry{ColourOf(type), fmt::format("{} {}", counts[type], text)};
  };
  return {"boundaries",
          Framed(picture, "7  Boundary types of least energy, eqs (9) to (11)",
                 {entry(BoundaryType::kCoplanar, "co-planar"), entry(BoundaryType::kHinge, "hinge"),
                  entry(BoundaryType::kLeftOcclusion, "left occl."),
                  entry(BoundaryType::kRightOcclusion, "right occl."),
                  entry(BoundaryType::kUnknown, "unknown")},
                 s.rois.empty() ? "no region of interest"
                                : "of superpixels i < j: left = i lies before j, right = j before "
                                  "i, unknown = one has no plane")};
}

StagePicture DrawRays(const cv::Mat1b& left, const PaperTrace& trace,
                      const std::vector<DynamicRegion>& regions) {
  cv::Mat3b picture = Spotlight(left, trace.stages.rois);
  std::size_t counted = 0, all = 0;
  for (std::size_t k = 0; k < trace.stages.rois.size(); ++k) {
    const SegmentedRoi& roi = trace.stages.rois[k];
    for (const TestedPoint& point : trace.stages.groups[k].points) {
      const cv::Point from = At(point.position);
      const auto ends =
          dynamic::SearchOcclusions(from - roi.roi.tl(), roi.superpixels.labels, roi.boundaries);
      const bool counts = static_cast<int>(ends.size()) >= trace.options.mark.min_rays;
      const cv::Scalar colour = ToScalar(counts ? kFound : kLost);
      for (const cv::Point& end : ends) {
        cv::line(picture, from, end + roi.roi.tl(), colour, 1, cv::LINE_8);
        if (counts) cv::circle(picture, end + roi.roi.tl(), 2, ToScalar(kDynamic), cv::FILLED);
      }
      cv::circle(picture, from, 3, colour, cv::FILLED, cv::LINE_AA);
      counted += counts ? 1 : 0;
      ++all;
    }
  }
  for (const DynamicRegion& region : regions) {
    cv::rectangle(picture, region.box, ToScalar(kNote), 2, cv::LINE_8);
  }
  return {"rays",
          Framed(picture, "8  Search along the axes for occlusions, and the rectangles around them",
                 {{kFound, "ray of a surrounded point"},
                  {kDynamic, "its end"},
                  {kLost, "too few rays end"},
                  {kNote, "region"}},
                 fmt::format("{} of {} points have {} rays or more that end", counted, all,
                             trace.options.mark.min_rays))};
}

}  // namespace

Colour ColourOf(BoundaryType type) {
  switch (type) {
    case BoundaryType::kCoplanar:
      return {130, 95, 45};
    case BoundaryType::kHinge:
      return {60, 220, 240};
    case BoundaryType::kLeftOcclusion:
      return {50, 50, 255};
    case BoundaryType::kRightOcclusion:
      return {255, 90, 230};
    case BoundaryType::kUnknown:
      break;
  }
  return {130, 130, 130};
}

std::vector<StagePicture> DrawPaper(const cv::Mat1b& left, const PaperTrace& trace,
                                    const std::vector<DynamicRegion>& regions) {
  const PaperStages& s = trace.stages;
  return {DrawPoints(left, s),      DrawDisparity(s),
          DrawEpipolar(left, s),    DrawGroups(left, trace),
          DrawSuperpixels(left, s), DrawPlanes(left, s),
          DrawBoundaries(left, s),  DrawRays(left, trace, regions)};
}

}  // namespace aisle::slam::picture
