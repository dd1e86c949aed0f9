#include "harness/report/picture/overlay.h"

#include <opencv2/imgproc.hpp>

namespace aisle {
namespace {

// BGR; readable on grey and apart for colour-blind cameras.
const cv::Scalar kMoving(60, 70, 255), kStanding(255, 170, 80), kRejected(240, 220, 40);
const cv::Scalar kUsed(110, 220, 90), kUnused(170, 170, 170), kOnMover(30, 220, 255);
const cv::Scalar kText(240, 240, 240), kBar(38, 34, 30);
constexpr double kFontScale = 0.42;
constexpr int kBarHeight = 24;

void Tint(const cv::Mat1b& mask, const cv::Scalar& color, cv::Mat3b* picture) {
  constexpr double kStrength = 0.38;
  if (mask.empty()) return;
  cv::Mat3b tinted;
  cv::addWeighted(*picture, 1 - kStrength,
                  cv::Mat3b(picture->size(), cv::Vec3b(static_cast<unsigned char>(color[0]),
                                                       static_cast<unsigned char>(color[1]),
                                                       static_cast<unsigned char>(color[2]))),
                  kStrength, 0, tinted);
  tinted.copyTo(*picture, mask);
}

void Outline(const cv::Mat1b& mask, const cv::Scalar& color, cv::Mat3b* picture) {
  if (mask.empty()) return;
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(mask, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  cv::drawContours(*picture, contours, -1, color, 1, cv::LINE_8);
}

void Label(const std::string& text, cv::Point at, const cv::Scalar& color, cv::Mat3b* picture) {
  int baseline = 0;
  const cv::Size size = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, kFontScale, 1, &baseline);
  at.x = std::clamp(at.x, 0, std::max(0, picture->cols - size.width - 6));
  at.y = std::clamp(at.y, size.height + 6, picture->rows - 2);
  const cv::Rect plate(at.x, at.y - size.height - 6, size.width + 6, size.height + 6);
  cv::rectangle(*picture, plate & cv::Rect({}, picture->size()), color, cv::FILLED);
  cv::putText(*picture, text, {at.x + 3, at.y - 3}, cv::FONT_HERSHEY_SIMPLEX, kFontScale,
              cv::Scalar(20, 20, 20), 1, cv::LINE_AA);
}

void DrawObjects(const std::vector<ObjectTruth>& objects, cv::Mat3b* picture) {
  constexpr double kStillMps = 0.02;
  constexpr int kWorthALabel = 60;  // pixels seen
  for (const ObjectTruth& object : objects) {
    if (object.visible_pixels < kWorthALabel) continue;
    const bool moving = object.dynamic_pixels > 0;
    const cv::Scalar& color = moving ? kMoving : kStanding;
    cv::rectangle(*picture, cv::Rect(object.box_visible), color, 1, cv::LINE_8);
    const double speed_mps = object.velocity_mps.norm();
    const std::string motion = speed_mps > kStillMps ? fmt::format("{:.1f} m/s", speed_mps)
                               : moving              ? "moving in place"
                                                     : "standing";
    Label(object.object_class + " " + motion, cv::Rect(object.box_visible).tl(), color, picture);
  }
}

void DrawKeypoints(const FrameEstimate& estimate, const FrameTruth* truth, cv::Mat3b* picture) {
  for (std::size_t i = 0; i < estimate.keypoints.size(); ++i) {
    const cv::Point at(cvRound(estimate.keypoints[i].x), cvRound(estimate.keypoints[i].y));
    if (!cv::Rect({}, picture->size()).contains(at)) continue;
    const bool used = i < estimate.keypoint_is_inlier.size() && estimate.keypoint_is_inlier[i];
    const bool on_mover = truth != nullptr && !truth->dynamic.empty() && truth->dynamic(at) != 0;
    cv::circle(*picture, at, used ? 2 : 1,
               on_mover ? kOnMover
               : used   ? kUsed
                        : kUnused,
               used ? cv::FILLED : 1, cv::LINE_AA);
  }
}

cv::Mat3b WithCaption(const cv::Mat3b& picture, const std::string& caption) {
  cv::Mat3b framed;
  cv::copyMakeBorder(picture, framed, 0, kBarHeight, 0, 0, cv::BORDER_CONSTANT, kBar);
  cv::putText(framed, caption, {8, framed.rows - 8}, cv::FONT_HERSHEY_SIMPLEX, kFontScale, kText, 1,
              cv::LINE_AA);
  return framed;
}

}  // namespace

cv::Mat3b DrawOverlay(const cv::Mat1b& left, const FrameTruth* truth, const FrameEstimate* estimate,
                      const std::string& caption) {
  cv::Mat3b picture;
  cv::cvtColor(left, picture, cv::COLOR_GRAY2BGR);
  if (truth != nullptr) Tint(truth->dynamic, kMoving, &picture);
  if (estimate != nullptr) {
    Outline(estimate->regions.mask, kRejected, &picture);
    for (const DynamicRegion& region : estimate->regions.regions) {
      cv::rectangle(picture, cv::Rect(region.box), kRejected, 1, cv::LINE_8);
    }
    DrawKeypoints(*estimate, truth, &picture);
  }
  if (truth != nullptr) DrawObjects(truth->objects, &picture);
  return WithCaption(picture, caption);
}

}  // namespace aisle
