#include "harness/run/mask_makers.h"

#include <deque>
#include <memory>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "harness/common/mix.h"

namespace aisle {
namespace {

/// A network that misses an object misses it for about this long.
constexpr std::int64_t kMissFrames = 10;
/// Widest shift between the cameras: a blob of the right mask belongs to the object whose box,
/// moved left by at most this much, covers it best.
constexpr int kMaxDisparityPx = 200;

/// Uniform in (0, 1), from its content alone.
double Uniform(std::uint64_t seed, std::uint64_t stream, std::int64_t frame, int instance) {
  std::uint64_t z = seed;
  for (const std::uint64_t part :
       {stream, static_cast<std::uint64_t>(frame), static_cast<std::uint64_t>(instance)}) {
    z = Mix(z + kGolden + part * 0xD1B54A32D192ED03u);
  }
  return (static_cast<double>(z >> 11) + 0.5) * 0x1.0p-53;
}

double Normal(std::uint64_t seed, std::int64_t frame, int instance) {
  return std::sqrt(-2 * std::log(Uniform(seed, 1, frame, instance))) *
         std::cos(2 * std::numbers::pi * Uniform(seed, 2, frame, instance));
}

/// The mask swollen (or shrunk, below zero) by so many pixels.
cv::Mat1b Shifted(const cv::Mat1b& mask, int by_px) {
  if (by_px == 0) return mask;
  const int size = 2 * std::abs(by_px) + 1;
  const cv::Mat disc = cv::getStructuringElement(cv::MORPH_ELLIPSE, {size, size});
  cv::Mat1b shifted;
  if (by_px > 0) {
    cv::dilate(mask, shifted, disc);
  } else {
    cv::erode(mask, shifted, disc);
  }
  return shifted;
}

/// What becomes of one object in one frame.
struct Fate {
  bool missed = false;
  int shift_px = 0;
  cv::Rect box;  ///< left camera
};

Fate FateOf(const cv::Mat1b& object, int instance, std::int64_t frame, const MaskErrors& errors,
            std::uint64_t seed) {
  Fate fate;
  fate.box = cv::boundingRect(object);
  fate.missed = cv::countNonZero(object) < errors.miss_below_px ||
                Uniform(seed, 3, frame / kMissFrames, instance) < errors.miss_share;
  fate.shift_px = static_cast<int>(std::lround(errors.boundary_px * Normal(seed, frame, instance)));
  return fate;
}

/// The right camera has no labels: a blob shares the fate of the object it must belong to.
const Fate* FateOfRightBlob(const cv::Rect& blob, const std::vector<Fate>& fates) {
  const Fate* best = nullptr;
  int most = 0;
  for (const Fate& fate : fates) {
    const cv::Rect swept(fate.box.x - kMaxDisparityPx, fate.box.y, fate.box.width + kMaxDisparityPx,
                         fate.box.height);
    const int shared = (swept & blob).area();
    if (shared <= most) continue;
    most = shared;
    best = &fate;
  }
  return best;
}

cv::Mat1b SpoilLeft(const cv::Mat1b& mask, const cv::Mat1w& instance, std::int64_t frame,
                    const MaskErrors& errors, std::uint64_t seed, std::vector<Fate>* fates) {
  std::set<int> ids;
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      if (mask(y, x) != 0) ids.insert(instance(y, x));
    }
  }
  cv::Mat1b spoilt(mask.size(), 0);
  for (const int id : ids) {
    cv::Mat1b object;
    cv::compare(instance, id, object, cv::CMP_EQ);
    cv::bitwise_and(object, mask, object);
    fates->push_back(FateOf(object, id, frame, errors, seed));
    if (!fates->back().missed) {
      cv::bitwise_or(spoilt, Shifted(object, fates->back().shift_px), spoilt);
    }
  }
  return spoilt;
}

cv::Mat1b SpoilRight(const cv::Mat1b& mask, const std::vector<Fate>& fates) {
  cv::Mat labels, stats, centroids;
  const int count = cv::connectedComponentsWithStats(mask, labels, stats, centroids, 8);
  cv::Mat1b spoilt(mask.size(), 0);
  for (int i = 1; i < count; ++i) {
    const cv::Rect box(stats.at<int>(i, cv::CC_STAT_LEFT), stats.at<int>(i, cv::CC_STAT_TOP),
                       stats.at<int>(i, cv::CC_STAT_WIDTH), stats.at<int>(i, cv::CC_STAT_HEIGHT));
    const Fate* fate = FateOfRightBlob(box, fates);
    if (fate != nullptr && fate->missed) continue;
    cv::Mat1b blob;
    cv::compare(labels, i, blob, cv::CMP_EQ);
    cv::bitwise_or(spoilt, Shifted(blob, fate == nullptr ? 0 : fate->shift_px), spoilt);
  }
  return spoilt;
}

ExternalMask Truth(MaskSource source, const SequenceFrame& frame) {
  if (!frame.truth || source == MaskSource::kNone) return {};
  const FrameTruth& truth = *frame.truth;
  if (source == MaskSource::kDynamic) return {truth.dynamic, truth.dynamic_right};
  return {truth.actor, truth.actor_right};
}

ExternalMask Spoil(const ExternalMask& mask, const SequenceFrame& frame, const MaskErrors& errors,
                   std::uint64_t seed) {
  if (mask.left.empty() || frame.truth->instance.size() != mask.left.size()) return mask;
  std::vector<Fate> fates;
  ExternalMask spoilt;
  spoilt.left = SpoilLeft(mask.left, frame.truth->instance, frame.images.id, errors, seed, &fates);
  if (!mask.right.empty()) spoilt.right = SpoilRight(mask.right, fates);
  return spoilt;
}

}  // namespace

MaskMaker MasksFromTruth(MaskSource source) {
  return [source](const SequenceFrame& frame) { return Truth(source, frame); };
}

MaskMaker MasksWithErrors(MaskSource source, const MaskErrors& errors, std::uint64_t seed) {
  if (errors == MaskErrors{}) return MasksFromTruth(source);
  // The queue is the latency: what comes out is as old as the network is slow.
  const auto late = std::make_shared<std::deque<ExternalMask>>();
  return [=](const SequenceFrame& frame) {
    late->push_back(Spoil(Truth(source, frame), frame, errors, seed));
    if (static_cast<int>(late->size()) <= errors.latency_frames) return ExternalMask{};
    ExternalMask ready = std::move(late->front());
    late->pop_front();
    return ready;
  };
}

void AdoptMask(const ExternalMask& mask, FrameEstimate* estimate) {
  if (estimate->regions.mask.empty() && estimate->regions.regions.empty()) {
    estimate->regions.mask = mask.left;
  }
}

}  // namespace aisle
