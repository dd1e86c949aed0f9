#include "harness/score/masks.h"

#include <map>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <tuple>

#include "harness/score/boundary.h"

namespace aisle {
namespace {

struct Box {
  cv::Rect rect;
  int pixels = 0;
};

std::map<int, Box> DynamicBoxesByInstance(const cv::Mat1b& dynamic, const cv::Mat1w& instance) {
  std::map<int, Box> boxes;
  for (int y = 0; y < dynamic.rows; ++y) {
    for (int x = 0; x < dynamic.cols; ++x) {
      if (dynamic(y, x) == 0) continue;
      Box& box = boxes[instance(y, x)];
      box.rect |= cv::Rect(x, y, 1, 1);
      ++box.pixels;
    }
  }
  return boxes;
}

cv::Mat1b OrEmpty(const cv::Mat1b& mask, cv::Size size, const char* whose) {
  if (mask.empty()) return cv::Mat1b(size, 0);
  if (mask.size() == size) return mask;
  throw std::invalid_argument(fmt::format("{} mask is {}x{}, the image {}x{}", whose, mask.cols,
                                          mask.rows, size.width, size.height));
}

void CountPixels(const cv::Mat1b& truth, const cv::Mat1b& rejected, MaskFacts* facts) {
  cv::Mat1b both;
  cv::bitwise_and(truth, rejected, both);
  facts->true_positives = cv::countNonZero(both);
  facts->false_positives = cv::countNonZero(rejected) - facts->true_positives;
  facts->false_negatives = cv::countNonZero(truth) - facts->true_positives;
}

void CountCorners(const cv::Mat1b& left, const cv::Mat1b& truth, const cv::Mat1b& rejected,
                  const MaskOptions& options, MaskFacts* facts) {
  std::vector<cv::KeyPoint> corners;
  cv::FAST(left, corners, options.corner_threshold);
  for (const cv::KeyPoint& corner : corners) {
    const cv::Point at(cvRound(corner.pt.x), cvRound(corner.pt.y));
    facts->corners_rejected += rejected(at) != 0;
    if (truth(at) != 0) continue;
    ++facts->static_corners;
    facts->static_corners_lost += rejected(at) != 0;
  }
}

void CountOutlines(const cv::Mat1b& truth, const cv::Mat1b& rejected, const BoundaryRule& rule,
                   MaskFacts* facts) {
  const BoundaryCounts counts = CompareBoundaries(truth, rejected, rule);
  facts->outline_truth = counts.truth;
  facts->outline_truth_met = counts.truth_met;
  facts->outline_rejected = counts.rejected;
  facts->outline_rejected_met = counts.rejected_met;
}

/// Share of an instance's moving pixels that were rejected. Where truth names no instances, of
/// those in its box.
double RejectedShare(const FrameTruth& truth, const MovingObject& object,
                     const cv::Mat1b& rejected) {
  const cv::Rect inside = cv::Rect(object.box) & cv::Rect({}, rejected.size());
  if (truth.dynamic.empty() || inside.empty()) return 0;
  cv::Mat moving;
  cv::compare(truth.dynamic(inside), 0, moving, cv::CMP_NE);
  if (truth.instance.size() == truth.dynamic.size()) {
    cv::Mat its_own;
    cv::compare(truth.instance(inside), object.instance, its_own, cv::CMP_EQ);
    cv::bitwise_and(moving, its_own, moving);
  }
  const int all = cv::countNonZero(moving);
  cv::bitwise_and(moving, rejected(inside), moving);
  return all > 0 ? static_cast<double>(cv::countNonZero(moving)) / all : 0;
}

std::vector<ObjectOutcome> Outcomes(const FrameTruth& truth,
                                    const std::vector<MovingObject>& objects,
                                    const std::vector<bool>& found, const cv::Mat1b& rejected) {
  std::vector<ObjectOutcome> outcomes;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const auto known = std::find_if(
        truth.objects.begin(), truth.objects.end(),
        [&](const ObjectTruth& object) { return object.instance == objects[i].instance; });
    if (known == truth.objects.end()) continue;
    outcomes.push_back({.instance = known->instance,
                        .object_class = known->object_class,
                        .pixels = objects[i].pixels,
                        .share = objects[i].pixels /
                                 static_cast<double>(std::max<std::size_t>(1, rejected.total())),
                        .distance_m = (known->center_m - truth.T_world_rig.translation()).norm(),
                        .speed_mps = known->velocity_mps.norm(),
                        .found = found[i],
                        .rejected = RejectedShare(truth, objects[i], rejected)});
  }
  return outcomes;
}

void CountLarge(const std::vector<RejectedRegion>& claims, double large_pixels, MaskFacts* facts) {
  for (const RejectedRegion& claim : claims) {
    if (claim.pixels < large_pixels) continue;
    ++facts->large_regions;
    facts->large_regions_astray += 10 * claim.moving < claim.pixels;
  }
}

}  // namespace

double Iou(const cv::Rect2d& a, const cv::Rect2d& b) {
  const double shared = (a & b).area();
  const double whole = a.area() + b.area() - shared;
  return whole > 0 ? shared / whole : 0;
}

bool IsLargeMover(const ObjectOutcome& object, const MaskOptions& options) {
  return object.share >= options.large_share && object.speed_mps >= options.large_speed_mps;
}

bool IsSlowMover(const ObjectOutcome& object, const MaskOptions& options) {
  return object.share >= options.large_share && object.speed_mps >= options.slow_speed_mps &&
         object.speed_mps < options.large_speed_mps;
}

bool IsCovered(const ObjectOutcome& object) { return object.rejected >= 0.5; }

ObjectCount CountObjects(const std::vector<ObjectOutcome>& objects, const ObjectRule& asked_for,
                         const ObjectRule& counts) {
  ObjectCount count;
  for (const ObjectOutcome& object : objects) {
    if (!asked_for(object)) continue;
    ++count.asked;
    count.counted += counts(object) ? 1 : 0;
  }
  return count;
}

std::vector<MovingObject> MovingObjects(const FrameTruth& truth, const MaskOptions& options) {
  std::vector<MovingObject> objects;
  if (!truth.instance.empty() && truth.instance.size() == truth.dynamic.size()) {
    for (const auto& [instance, box] : DynamicBoxesByInstance(truth.dynamic, truth.instance)) {
      if (box.pixels < options.min_object_pixels) continue;
      objects.push_back({cv::Rect2d(box.rect), instance, box.pixels});
    }
    return objects;
  }
  for (const ObjectTruth& object : truth.objects) {
    if (object.dynamic_pixels < options.min_object_pixels) continue;
    objects.push_back({object.box_visible, object.instance, object.dynamic_pixels});
  }
  return objects;
}

std::vector<cv::Rect2d> RejectedBoxes(const DynamicRegions& regions, const MaskOptions& options) {
  std::vector<cv::Rect2d> boxes;
  for (const DynamicRegion& region : regions.regions) boxes.push_back(region.box);
  if (!boxes.empty() || regions.mask.empty()) return boxes;
  cv::Mat1b closed;
  const cv::Size gap(options.close_gap_px, options.close_gap_px);
  cv::morphologyEx(regions.mask, closed, cv::MORPH_CLOSE,
                   cv::getStructuringElement(cv::MORPH_RECT, gap));
  cv::Mat labels, stats, centroids;
  const int count = cv::connectedComponentsWithStats(closed, labels, stats, centroids, 8);
  for (int i = 1; i < count; ++i) {
    if (stats.at<int>(i, cv::CC_STAT_AREA) < options.min_region_pixels) continue;
    boxes.emplace_back(stats.at<int>(i, cv::CC_STAT_LEFT), stats.at<int>(i, cv::CC_STAT_TOP),
                       stats.at<int>(i, cv::CC_STAT_WIDTH), stats.at<int>(i, cv::CC_STAT_HEIGHT));
  }
  return boxes;
}

MaskFacts MatchBoxes(const std::vector<cv::Rect2d>& truth,
                     const std::vector<RejectedRegion>& rejected, const MaskOptions& options,
                     std::vector<bool>* found) {
  std::vector<std::tuple<double, std::size_t, std::size_t>> candidates;
  for (std::size_t t = 0; t < truth.size(); ++t) {
    for (std::size_t r = 0; r < rejected.size(); ++r) {
      const double iou = Iou(truth[t], rejected[r].box);
      if (iou >= options.match_iou) candidates.emplace_back(-iou, t, r);
    }
  }
  std::sort(candidates.begin(), candidates.end());
  std::vector<bool> truth_taken(truth.size()), rejected_taken(rejected.size());
  MaskFacts facts;
  for (const auto& [negative_iou, t, r] : candidates) {
    if (truth_taken[t] || rejected_taken[r]) continue;
    truth_taken[t] = rejected_taken[r] = true;
    ++facts.objects_found;
    facts.iou_sum -= negative_iou;
  }
  facts.objects_missed = static_cast<int>(truth.size()) - facts.objects_found;
  for (std::size_t r = 0; r < rejected.size(); ++r) {
    if (rejected_taken[r]) continue;
    ++(rejected[r].on_moving() ? facts.parts_of_movers : facts.objects_invented);
  }
  if (found != nullptr) *found = std::move(truth_taken);
  return facts;
}

std::vector<RejectedRegion> RejectedRegions(const std::vector<cv::Rect2d>& boxes,
                                            const cv::Mat1b& dynamic, const cv::Mat1b& mask) {
  std::vector<RejectedRegion> regions;
  for (const cv::Rect2d& box : boxes) {
    const cv::Rect inside = cv::Rect(box) & cv::Rect({}, dynamic.size());
    cv::Mat1b moving = dynamic(inside).clone();
    int asked = inside.area();
    if (!mask.empty()) {
      asked = cv::countNonZero(mask(inside));
      cv::bitwise_and(moving, mask(inside), moving);
    }
    regions.push_back({box, asked, cv::countNonZero(moving)});
  }
  return regions;
}

MaskFacts CompareMaskImages(const cv::Mat1b& truth, const cv::Mat1b& rejected,
                            const BoundaryRule& rule) {
  MaskFacts facts;
  CountPixels(truth, rejected, &facts);
  CountOutlines(truth, rejected, rule, &facts);
  return facts;
}

MaskFacts CompareMaskBlobs(const cv::Mat1b& truth, const cv::Mat1b& rejected,
                           const BoundaryRule& rule) {
  MaskFacts facts = CompareMaskImages(truth, rejected, rule);
  const std::vector<cv::Rect2d> claims = RejectedBoxes({.mask = rejected, .regions = {}}, {});
  const std::vector<cv::Rect2d> blobs = RejectedBoxes({.mask = truth, .regions = {}}, {});
  const MaskFacts objects = MatchBoxes(blobs, RejectedRegions(claims, truth, rejected), {});
  facts.objects_found = objects.objects_found;
  facts.objects_missed = objects.objects_missed;
  facts.objects_invented = objects.objects_invented;
  facts.parts_of_movers = objects.parts_of_movers;
  facts.iou_sum = objects.iou_sum;
  return facts;
}

MaskFacts CompareMasks(const cv::Mat1b& left, const FrameTruth& truth,
                       const DynamicRegions& regions, const MaskOptions& options) {
  const cv::Mat1b dynamic = OrEmpty(truth.dynamic, left.size(), "truth's dynamic");
  const cv::Mat1b rejected = OrEmpty(regions.mask, left.size(), "the system's");
  const std::vector<cv::Rect2d> boxes = RejectedBoxes(regions, options);
  const std::vector<MovingObject> objects = MovingObjects(truth, options);
  std::vector<cv::Rect2d> true_boxes;
  for (const MovingObject& object : objects) true_boxes.push_back(object.box);
  const std::vector<RejectedRegion> claims = RejectedRegions(boxes, dynamic, regions.mask);
  std::vector<bool> found;
  MaskFacts facts = MatchBoxes(true_boxes, claims, options, &found);
  CountLarge(claims, options.large_share * static_cast<double>(left.total()), &facts);
  facts.objects = Outcomes(truth, objects, found, rejected);
  CountPixels(dynamic, rejected, &facts);
  CountOutlines(dynamic, rejected, {}, &facts);
  CountCorners(left, dynamic, rejected, options, &facts);
  return facts;
}

std::string Describe(const MaskOptions& options) {
  return fmt::format(
      "rectangles of connected blobs of {} px or more (gaps narrower than {} px closed), one to "
      "one, largest overlap first, found from IoU {:g} on; without a partner invented where less "
      "than half of what was rejected in them moves, else a part of a mover and not counted; "
      "object_iou is the mean over those found",
      options.min_region_pixels, options.close_gap_px, options.match_iou);
}

std::optional<double> Ratio(double part, double whole) {
  return whole > 0 ? std::optional(part / whole) : std::nullopt;
}

}  // namespace aisle
