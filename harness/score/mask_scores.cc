#include "harness/score/mask_scores.h"

#include "harness/score/boundary.h"
#include "harness/score/continuity.h"
#include "harness/score/masks.h"
#include "harness/score/scorecard.h"

namespace aisle {
namespace {

/// A range of objects that scores are split by.
struct Kind {
  const char* name;
  std::function<bool(const ObjectOutcome&)> holds;
};

/// Bounds by what they mean to a stereo rig at 752x480: 2000 pixels are a person at some six
/// metres; beyond six metres disparity is a few pixels; 0.3 m/s is slower than a stroll, 1.5 m/s
/// faster than a walk.
const std::vector<Kind>& Kinds() {
  using Object = ObjectOutcome;
  static const std::vector<Kind> kinds = {
      {"size_small", [](const Object& o) { return o.pixels < 2000; }},
      {"size_medium", [](const Object& o) { return o.pixels >= 2000 && o.pixels < 20000; }},
      {"size_large", [](const Object& o) { return o.pixels >= 20000; }},
      {"distance_below_3m", [](const Object& o) { return o.distance_m < 3; }},
      {"distance_3_to_6m", [](const Object& o) { return o.distance_m >= 3 && o.distance_m < 6; }},
      {"distance_above_6m", [](const Object& o) { return o.distance_m >= 6; }},
      {"speed_below_0.3mps", [](const Object& o) { return o.speed_mps < 0.3; }},
      {"speed_0.3_to_1.5mps",
       [](const Object& o) { return o.speed_mps >= 0.3 && o.speed_mps < 1.5; }},
      {"speed_above_1.5mps", [](const Object& o) { return o.speed_mps >= 1.5; }},
  };
  return kinds;
}

bool IsFound(const ObjectOutcome& object) { return object.found; }

Score ShareOf(const std::vector<ObjectOutcome>& objects, const ObjectRule& asked_for,
              const ObjectRule& counts) {
  const ObjectCount count = CountObjects(objects, asked_for, counts);
  return RatioScore(count.counted, count.asked, "no such object moved");
}

/// Rows only where there is something to say: an object that never was is no finding.
void AddRecallByKind(const std::vector<ObjectOutcome>& objects, Scorecard* scores) {
  const auto add = [&](const std::string& name, const ObjectRule& asked_for) {
    const Score score = ShareOf(objects, asked_for, IsFound);
    if (score.value) (*scores)["object_recall_" + name] = score;
  };
  for (const Kind& kind : Kinds()) add(kind.name, kind.holds);
  std::set<std::string> classes;
  for (const ObjectOutcome& object : objects) classes.insert(object.object_class);
  for (const std::string& name : classes) {
    add("class_" + name, [&](const ObjectOutcome& object) { return object.object_class == name; });
  }
}

bool IsLarge(const ObjectOutcome& object) { return IsLargeMover(object); }

void AddLargeMovers(const MaskFacts& sum, Scorecard* scores) {
  const Detection large = LargeDetection(sum);
  (*scores)["object_precision_large"] = large.precision;
  (*scores)["object_recall_large"] = large.recall;
  (*scores)["object_covered_large"] = ShareOf(sum.objects, IsLarge, IsCovered);
  (*scores)["object_covered"] = ShareOf(
      sum.objects, [](const ObjectOutcome&) { return true; }, IsCovered);
}

}  // namespace

Detection PixelDetection(const MaskFacts& sum) {
  const auto tp = static_cast<double>(sum.true_positives);
  const auto fp = static_cast<double>(sum.false_positives);
  const auto fn = static_cast<double>(sum.false_negatives);
  return {.precision = RatioScore(tp, tp + fp, "nothing was rejected"),
          .recall = RatioScore(tp, tp + fn, "nothing moved"),
          .iou = RatioScore(tp, tp + fp + fn, "nothing moved, nothing was rejected")};
}

Detection ObjectDetection(const MaskFacts& sum) {
  const double found = sum.objects_found;
  const bool rejected = sum.true_positives + sum.false_positives + sum.parts_of_movers > 0;
  const char* no_region = rejected ? "only specks and parts of moving objects were rejected, which "
                                     "count neither as found nor as invented"
                                   : "nothing was rejected";
  return {.precision = RatioScore(found, found + sum.objects_invented, no_region),
          .recall = RatioScore(found, found + sum.objects_missed, "nothing moved"),
          .iou = RatioScore(sum.iou_sum, found, "no object was found")};
}

ObjectCount CountLargeMovers(const MaskFacts& sum) {
  return CountObjects(sum.objects, IsLarge, IsFound);
}

Detection LargeDetection(const MaskFacts& sum) {
  return {.precision = RatioScore(sum.large_regions - sum.large_regions_astray, sum.large_regions,
                                  "nothing large was rejected"),
          .recall = ShareOf(sum.objects, IsLarge, IsFound),
          .iou = Absent("1", "not asked of large movers")};
}

void AddMasks(const std::vector<FrameFacts>& frames, Scorecard* scores) {
  MaskFacts sum;
  bool any = false;
  for (const FrameFacts& frame : frames) {
    if (!frame.mask) continue;
    any = true;
    sum += *frame.mask;
  }
  if (!any) return;  // the system makes no masks: no row is clearer than nine empty ones
  const Detection pixels = PixelDetection(sum), objects = ObjectDetection(sum);
  (*scores)["mask_precision"] = pixels.precision;
  (*scores)["mask_recall"] = pixels.recall;
  (*scores)["mask_iou"] = pixels.iou;
  const auto count = frames.size();
  (*scores)["objects_moving"] = Present(sum.objects_found + sum.objects_missed, "1", count);
  (*scores)["objects_found"] = Present(sum.objects_found, "1", count);
  (*scores)["objects_missed"] = Present(sum.objects_missed, "1", count);
  (*scores)["objects_invented"] = Present(sum.objects_invented, "1", count);
  (*scores)["object_precision"] = objects.precision;
  (*scores)["object_recall"] = objects.recall;
  (*scores)["object_iou"] = objects.iou;
  (*scores)["static_features_lost"] =
      RatioScore(sum.static_corners_lost, sum.static_corners, "no corner on a static surface");
  const std::optional<double> f = BoundaryF({.truth = sum.outline_truth,
                                             .truth_met = sum.outline_truth_met,
                                             .rejected = sum.outline_rejected,
                                             .rejected_met = sum.outline_rejected_met});
  (*scores)["mask_boundary_f"] =
      f ? Present(*f, "1", static_cast<std::size_t>(sum.outline_truth + sum.outline_rejected))
        : Absent("1", "nothing moved, nothing was rejected");
  if (sum.objects.empty()) {  // nothing moved, or truth names no objects
    if (sum.large_regions > 0) (*scores)["object_precision_large"] = LargeDetection(sum).precision;
    return;
  }
  AddLargeMovers(sum, scores);
  AddRecallByKind(sum.objects, scores);
  AddContinuity(FollowKinds(frames), {}, scores);
}

}  // namespace aisle
