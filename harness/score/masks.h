#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <vector>

#include "harness/contract/run.h"
#include "harness/score/boundary.h"

namespace aisle {

/// How rejected regions are compared with truth.
struct MaskOptions {
  /// Smallest overlap of two rectangles that counts as the same object. The paper's equations
  /// (12)-(14) leave the rule open; 0.5 is the usual one.
  double match_iou = 0.5;
  int min_object_pixels = 200;  ///< moving objects with fewer dynamic pixels are not asked for
  int min_region_pixels = 50;   ///< blobs of a mask smaller than this are no detection
  /// From this share of the image on, an object or what was rejected is large. What was rejected
  /// there is astray where less than a tenth of it moves: it covers no mover, however wide.
  double large_share = 0.01;
  double large_speed_mps = 0.15;  ///< a large mover is at least so fast
  double slow_speed_mps = 0.05;   ///< a slow one of that share at least so, and slower than a large
  /// Gaps of a mask narrower than this, in pixels, do not part a blob: a strap or a rail in front
  /// of a person does not make two of them.
  int close_gap_px = 15;
  int corner_threshold = 20;  ///< FAST's, grey levels: what counts as a static corner
};

/// Intersection over union of two rectangles, in [0, 1]; 0 where both are empty.
double Iou(const cv::Rect2d& a, const cv::Rect2d& b);

/// Picks objects out of a frame.
using ObjectRule = std::function<bool(const ObjectOutcome&)>;

/// What must be found by all means: large, and on its way.
bool IsLargeMover(const ObjectOutcome& object, const MaskOptions& options = {});

/// As large in the image, but creeping: what a rule that waits for motion finds late.
bool IsSlowMover(const ObjectOutcome& object, const MaskOptions& options = {});

/// At least half of its moving pixels were rejected, whatever the rectangles: two people who touch
/// make one rectangle, which is neither's.
bool IsCovered(const ObjectOutcome& object);

/// Of the objects that one rule asks for, how many another holds for.
struct ObjectCount {
  int asked = 0, counted = 0;
};
ObjectCount CountObjects(const std::vector<ObjectOutcome>& objects, const ObjectRule& asked_for,
                         const ObjectRule& counts);

/// Something that moves now and must be found.
struct MovingObject {
  cv::Rect2d box;
  int instance = 0;
  int pixels = 0;  ///< that move and show
};

/// What moves now: per object the box of its dynamic pixels (of its visible box where
/// no instance labels are known), for objects with at least min_object_pixels of them.
std::vector<MovingObject> MovingObjects(const FrameTruth& truth, const MaskOptions& options);

/// What the system says moves: its regions' boxes, or the boxes of the mask's connected blobs.
std::vector<cv::Rect2d> RejectedBoxes(const DynamicRegions& regions, const MaskOptions& options);

/// What was rejected in one of RejectedBoxes.
struct RejectedRegion {
  cv::Rect2d box;
  int pixels = 0;  ///< rejected in it; all of the box where there is no mask
  int moving = 0;  ///< of these, how many move in truth

  bool on_moving() const { return pixels > 0 && 2 * moving >= pixels; }
};
std::vector<RejectedRegion> RejectedRegions(const std::vector<cv::Rect2d>& boxes,
                                            const cv::Mat1b& dynamic, const cv::Mat1b& mask);

/// Pairs rectangles one to one, largest overlap first. Fills the object counts and iou_sum, and in
/// `found`, where given, which of the true ones have a partner. A rejected rectangle without
/// partner is invented, unless it lies on something that does move: a part of an object, several
/// that touch, or one too small to be asked for.
MaskFacts MatchBoxes(const std::vector<cv::Rect2d>& truth,
                     const std::vector<RejectedRegion>& rejected, const MaskOptions& options,
                     std::vector<bool>* found = nullptr);

/// Pixels and outlines alone, of masks of one size.
MaskFacts CompareMaskImages(const cv::Mat1b& truth, const cv::Mat1b& rejected,
                            const BoundaryRule& rule = {});

/// The same, and objects where nobody labelled them: each is a blob of moving pixels.
MaskFacts CompareMaskBlobs(const cv::Mat1b& truth, const cv::Mat1b& rejected,
                           const BoundaryRule& rule = {});

/// All comparisons of one frame. `truth.dynamic` and `regions.mask` have the size of `left`, or are
/// empty (nothing moves, nothing is rejected). Throws std::invalid_argument on other sizes.
MaskFacts CompareMasks(const cv::Mat1b& left, const FrameTruth& truth,
                       const DynamicRegions& regions, const MaskOptions& options = {});

/// The rule by which objects are counted, in words.
std::string Describe(const MaskOptions& options);

/// tp / (tp + fp) and its kin; absent where nothing was there to be counted.
std::optional<double> Ratio(double part, double whole);

}  // namespace aisle
