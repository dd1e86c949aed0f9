#include "slam/picture/draw_robust.h"

#include <opencv2/imgproc.hpp>

#include "slam/common/median.h"
#include "slam/picture/canvas.h"

namespace aisle::slam::picture {
namespace {

using dynamic::RobustStages;

constexpr double kFullLogOdds = 6;     // of full colour
constexpr double kFullOfOneFrame = 3;  // which alone says less

/// A half-size picture in full size, pixels kept square.
cv::Mat3b Enlarged(const cv::Mat3b& half, cv::Size size) {
  cv::Mat3b picture;
  cv::resize(half, picture, size, 0, 0, cv::INTER_NEAREST);
  return picture;
}

cv::Mat1f Enlarged(const cv::Mat1f& half, cv::Size size) {
  cv::Mat1f values;
  cv::resize(half, values, size, 0, 0, cv::INTER_NEAREST);
  return values;
}

std::vector<LegendEntry> LogOddsLegend(double limit) {
  return {{LogOddsColour(-limit, limit), fmt::format("static (log-odds -{:g})", limit)},
          {LogOddsColour(0, limit), "not known"},
          {LogOddsColour(limit, limit), fmt::format("moving (+{:g})", limit)}};
}

StagePicture DrawLogOdds(const cv::Mat1b& left, const std::string& name, const std::string& title,
                         const cv::Mat1f& log_odds, double limit) {
  cv::Mat3b picture = OnGrey(left);
  TintByLogOdds(Enlarged(log_odds, left.size()), limit, picture);
  const auto pixels = static_cast<double>(log_odds.total());
  const double moving = cv::countNonZero(log_odds > 0), still = cv::countNonZero(log_odds < 0);
  return {name, Framed(picture, title, LogOddsLegend(limit),
                       fmt::format("leaning to moving {:.1f} %, to static {:.1f} % of the pixels",
                                   100 * moving / pixels, 100 * still / pixels))};
}

StagePicture DrawDisparity(const cv::Mat1b& left, const RobustStages& s) {
  const Colour floor_colour(120, 200, 120);
  double most = 1;
  cv::minMaxLoc(s.half_disparity, nullptr, &most);
  most = std::max(most, 1.0);
  cv::Mat3b half = HeatOf(s.half_disparity, most);
  Tint(s.floor_mask, floor_colour, 0.45, half);
  const double known = cv::countNonZero(s.half_disparity > 0);
  return {"disparity",
          Framed(Enlarged(half, left.size()), "1  Disparity at half size, and the floor",
                 {{HeatColour(0, most), "far"},
                  {HeatColour(most, most), fmt::format("near ({:.0f} px)", 2 * most)},
                  {{0, 0, 0}, "unknown"},
                  {floor_colour, "floor: does not belong to what stands on it"}},
                 fmt::format("{:.0f} % of the pixels known; {}",
                             100 * known / static_cast<double>(s.half_disparity.total()),
                             s.floor ? "floor found" : "no floor found"))};
}

/// From the earlier frame to this one, half-size pixels.
cv::Mat2f MotionOf(const cv::Mat2f& came_from) {
  cv::Mat2f motion(came_from.size());
  for (int y = 0; y < motion.rows; ++y) {
    for (int x = 0; x < motion.cols; ++x) {
      motion(y, x) = cv::Vec2f(static_cast<float>(x), static_cast<float>(y)) - came_from(y, x);
    }
  }
  return motion;
}

std::vector<LegendEntry> WheelLegend(double most) {
  std::vector<LegendEntry> legend;
  const std::pair<cv::Vec2f, const char*> directions[] = {
      {{1, 0}, "right"}, {{0, 1}, "down"}, {{-1, 0}, "left"}, {{0, -1}, "up"}};
  for (const auto& [direction, text] : directions) {
    const cv::Mat2f one(1, 1, direction);
    legend.push_back({WheelOf(one, 1)(0, 0), text});
  }
  legend.push_back({{128, 128, 128}, fmt::format("full colour: {:.1f} px", 2 * most)});
  return legend;
}

double MedianLength(const cv::Mat2f& vectors) {
  std::vector<float> lengths;
  for (const cv::Vec2f& v : vectors) lengths.push_back(std::hypot(v[0], v[1]));
  return Median(std::move(lengths));
}

StagePicture DrawFlow(const cv::Mat1b& left, const RobustTrace& trace) {
  const cv::Mat2f motion = MotionOf(trace.stages.gaps.front().way.flow);
  const double median = MedianLength(motion), most = std::max(2.0, 3 * median);
  const auto& ego = trace.stages.gaps.front().motion;
  const Eigen::Vector3d t = ego.T_now_before.inverse().translation();
  const double turn_deg = Eigen::AngleAxisd(ego.T_now_before.linear()).angle() * 180 / CV_PI;
  return {
      "flow",
      Framed(Enlarged(WheelOf(motion, most), left.size()),
             "2  Flow since the last frame, whatever moved", WheelLegend(most),
             fmt::format("median {:.2f} px; rig {}: {:.1f} mm right, {:.1f} down, {:.1f} ahead, "
                         "{:.3f} deg in {:.0f} ms",
                         2 * median, ego.standing ? "stands" : "moved", 1e3 * t.x(), 1e3 * t.y(),
                         1e3 * t.z(), turn_deg, 1e3 * trace.gap_s))};
}

/// By how much arrows are stretched so that all but the very longest end before the next begins.
double ArrowScale(const cv::Mat2f& residual, int step_px) {
  std::vector<double> lengths;
  for (const cv::Vec2f& r : residual) lengths.push_back(2.0 * std::hypot(r[0], r[1]));
  const auto long_one = lengths.begin() + std::ssize(lengths) * 99 / 100;
  std::nth_element(lengths.begin(), long_one, lengths.end());
  double scale = 0.5;
  for (const double candidate : {1.0, 2.0, 5.0, 10.0}) {
    if (candidate * *long_one <= step_px) scale = candidate;
  }
  return scale;
}

/// What the static world leaves unexplained, in units of the flow's measured noise.
StagePicture DrawResidual(const cv::Mat1b& left, const RobustTrace& trace) {
  constexpr double kMost = 12;  // deviations of full colour
  constexpr int kArrowStep = 28;
  constexpr double kWorthAnArrow = 4;
  const double noise = std::max(trace.flow_noise, 1e-3);
  cv::Mat1f sigmas(trace.residual.size());
  for (int k = 0; k < static_cast<int>(sigmas.total()); ++k) {
    const cv::Vec2f& r = trace.residual(k);
    sigmas(k) = static_cast<float>(std::hypot(r[0], r[1]) / noise);
  }
  const double scale = ArrowScale(trace.residual, kArrowStep);
  cv::Mat3b heat = Enlarged(HeatOf(sigmas, kMost), left.size()), picture;
  cv::addWeighted(OnGrey(left), 0.35, heat, 0.65, 0, picture);
  for (int y = kArrowStep / 2; y < left.rows; y += kArrowStep) {
    for (int x = kArrowStep / 2; x < left.cols; x += kArrowStep) {
      const cv::Point half(std::min(x / 2, sigmas.cols - 1), std::min(y / 2, sigmas.rows - 1));
      if (sigmas(half) < kWorthAnArrow) continue;
      const cv::Vec2f& r = trace.residual(half);  // backwards in time: the arrow shows forwards
      const cv::Point to(x - cvRound(2 * scale * r[0]), y - cvRound(2 * scale * r[1]));
      cv::arrowedLine(picture, {x, y}, to, ToScalar(kNote), 1, cv::LINE_AA, 0, 0.3);
    }
  }
  return {"residual",
          Framed(picture, "3  What the predicted static view leaves of the flow",
                 {{HeatColour(0, kMost), "0"},
                  {HeatColour(kMost / 2, kMost), fmt::format("{:g}", kMost / 2)},
                  {HeatColour(kMost, kMost), fmt::format("{:g} deviations or more", kMost)},
                  {kNote, fmt::format("arrows: {:g} times as long", scale)}},
                 fmt::format("one deviation: {:.2f} px, as measured; median {:.2f} px", 2 * noise,
                             2 * MedianLength(trace.residual)))};
}

/// A tile for each gap, as far as the past reaches.
StagePicture DrawGaps(const cv::Mat1b& left, const RobustStages& s) {
  cv::Mat3b picture(left.size(), Colour(30, 26, 24));
  cv::Mat1b small;
  const cv::Size tile(left.cols / 2, left.rows / 2);
  cv::resize(left, small, tile, 0, 0, cv::INTER_AREA);
  std::string support;
  for (std::size_t k = 0; k < s.gaps.size() && k < 4; ++k) {
    cv::Mat3b one = OnGrey(small);
    if (!s.gaps[k].evidence.log_odds.empty()) {
      TintByLogOdds(Enlarged(s.gaps[k].evidence.log_odds, tile), kFullLogOdds, one);
    }
    Plate(fmt::format("over {} frame{}", s.gaps[k].way.gap, s.gaps[k].way.gap == 1 ? "" : "s"),
          {4, 22}, kNote, one);
    const int column = static_cast<int>(k % 2), row = static_cast<int>(k / 2);
    one.copyTo(picture(cv::Rect({column * tile.width, row * tile.height}, tile)));
    support += fmt::format("{}{}: {:.0f}", k == 0 ? "" : ", ", s.gaps[k].way.gap,
                           s.gaps[k].motion.support);
  }
  return {"gaps", Framed(picture, "4  Evidence of each gap alone", LogOddsLegend(kFullLogOdds),
                         s.gaps.empty() ? "no past to compare with"
                                        : "matches behind the rig's motion, by gap: " + support)};
}

StagePicture DrawProbability(const cv::Mat1b& left, const RobustTrace& trace,
                             const DynamicRegions& regions) {
  cv::Mat3b picture = OnGrey(left, 0.8);
  for (int y = 0; y < left.rows; ++y) {
    for (int x = 0; x < left.cols; ++x) {
      const double p = trace.probability(y, x);
      const Colour heat = HeatColour(p, 1);
      const double share = 0.7 * p;
      for (int c = 0; c < 3; ++c) {
        picture(y, x)[c] =
            cv::saturate_cast<unsigned char>(picture(y, x)[c] * (1 - share) + heat[c] * share);
      }
    }
  }
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(regions.mask.clone(), outlines, cv::RETR_LIST, cv::CHAIN_APPROX_NONE);
  cv::drawContours(picture, outlines, -1, ToScalar(kNote), 1, cv::LINE_8);
  for (const DynamicRegion& region : regions.regions) {
    cv::rectangle(picture, region.box, ToScalar(ColourOf(region.id)), 1, cv::LINE_8);
    Plate(fmt::format("#{}  log-odds {:.1f}", region.id, region.evidence), region.box.tl(),
          ColourOf(region.id), picture);
  }
  return {"probability",
          Framed(picture, "8  Probability of moving, and the regions with ids that last",
                 {{HeatColour(0.5, 1), "p = 0.5"},
                  {HeatColour(1, 1), "p = 1"},
                  {kNote, "outline of the mask"},
                  {ColourOf(0), "a colour per id"}},
                 fmt::format("regions: {}; log-odds: mean of the region's pixels",
                             regions.regions.size()))};
}

}  // namespace

std::vector<StagePicture> DrawRobust(const cv::Mat1b& left, const RobustTrace& trace,
                                     const DynamicRegions& regions) {
  const RobustStages& s = trace.stages;
  return {
      DrawDisparity(left, s),
      DrawFlow(left, trace),
      DrawResidual(left, trace),
      DrawGaps(left, s),
      DrawLogOdds(left, "evidence", "5  Evidence of this frame, all gaps together", s.evidence,
                  kFullLogOdds),
      DrawLogOdds(left, "memory", "6  The same with what was known before", s.memory, kFullLogOdds),
      DrawLogOdds(left, "field", "7  The field's answer: neighbours of one surface agree",
                  s.log_odds, kFullLogOdds),
      DrawProbability(left, trace, regions)};
}

}  // namespace aisle::slam::picture
