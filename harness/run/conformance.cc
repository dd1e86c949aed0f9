#include "harness/run/conformance.h"

#include <set>

#include "harness/contract/map_id.h"
#include "harness/contract/rigid.h"

namespace aisle {
namespace {

using Make = std::function<std::unique_ptr<Estimator>()>;

/// Rules that were broken, each once, with the frame where it first showed.
class Findings {
 public:
  void Hold(bool good, std::int64_t frame, const std::string& rule) {
    if (!good && broken_.insert(rule).second) {
      sentences_.push_back(fmt::format("frame {}: {}", frame, rule));
    }
  }
  void HoldAtEnd(bool good, const std::string& rule) {
    if (!good && broken_.insert(rule).second) sentences_.push_back("Finish: " + rule);
  }
  std::vector<std::string> Take() { return std::move(sentences_); }

 private:
  std::set<std::string> broken_;
  std::vector<std::string> sentences_;
};

constexpr double kRigidToConform = 1e-6;

bool IsBinary(const cv::Mat1b& mask) {
  if (mask.empty()) return true;  // its iterators divide by its width
  return std::all_of(mask.begin(), mask.end(),
                     [](std::uint8_t pixel) { return pixel == 0 || pixel == 255; });
}

bool IsInside(const std::vector<cv::Point2f>& points, const cv::Mat1b& image) {
  const auto width = static_cast<float>(image.cols), height = static_cast<float>(image.rows);
  return std::all_of(points.begin(), points.end(), [&](const cv::Point2f& p) {
    return p.x >= -0.5F && p.y >= -0.5F && p.x <= width - 0.5F && p.y <= height - 0.5F;
  });
}

bool SamePixels(const cv::Mat1b& a, const cv::Mat1b& b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin());
}

void HoldEstimate(const FrameEstimate& said, const StereoFrame& frame, Findings* findings) {
  const std::int64_t id = frame.id;
  findings->Hold(said.id == frame.id && said.stamp_ns == frame.stamp_ns, id,
                 "id and stamp_ns are not the frame's");
  const bool tracks = said.state == TrackingState::kTracking;
  findings->Hold(said.T_world_rig.has_value() == tracks, id,
                 "T_world_rig must be present exactly where the state is kTracking");
  findings->Hold(!said.T_world_rig || IsRigid(*said.T_world_rig, kRigidToConform), id,
                 "T_world_rig is not a finite rigid motion");
  const cv::Mat1b& mask = said.regions.mask;
  findings->Hold(mask.empty() || mask.size() == frame.left.size(), id,
                 "the mask and the image differ in size");
  findings->Hold(IsBinary(mask), id, "the mask holds values other than 0 and 255");
  findings->Hold(IsInside(said.keypoints, frame.left), id, "keypoints lie outside the left image");
  findings->Hold(
      said.keypoint_is_inlier.empty() || said.keypoint_is_inlier.size() == said.keypoints.size(),
      id, "keypoint_is_inlier must be empty or as long as keypoints");
}

/// What two drives are compared by.
struct Said {
  std::vector<std::optional<Eigen::Isometry3d>> live;
  Trajectory final;
};

bool SameBits(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return a.matrix() == b.matrix();
}

bool SameBits(const Said& a, const Said& b) {
  const auto same_live = [](const auto& x, const auto& y) {
    return x.has_value() == y.has_value() && (!x || SameBits(*x, *y));
  };
  const auto same_final = [](const StampedPose& x, const StampedPose& y) {
    return x.stamp_ns == y.stamp_ns && SameBits(x.T_world_rig, y.T_world_rig);
  };
  return a.live.size() == b.live.size() && a.final.size() == b.final.size() &&
         std::equal(a.live.begin(), a.live.end(), b.live.begin(), same_live) &&
         std::equal(a.final.begin(), a.final.end(), b.final.begin(), same_final);
}

std::vector<StereoFrame> FirstFrames(const Sequence& sequence, std::size_t count) {
  std::vector<StereoFrame> frames;
  for (const FrameRequest& request : sequence.Schedule()) {
    if (frames.size() == count) break;
    frames.push_back(sequence.At(request).images);
  }
  return frames;
}

StereoFrame Clone(const StereoFrame& frame) {
  return {frame.id, frame.stamp_ns, frame.left.clone(), frame.right.clone()};
}

void HoldFinal(const Trajectory& final, const std::vector<StereoFrame>& frames,
               Findings* findings) {
  std::set<std::int64_t> stamps;
  for (const StereoFrame& frame : frames) stamps.insert(frame.stamp_ns);
  std::int64_t last = std::numeric_limits<std::int64_t>::min();
  for (const StampedPose& pose : final) {
    findings->HoldAtEnd(pose.stamp_ns > last, "timestamps must increase");
    findings->HoldAtEnd(stamps.contains(pose.stamp_ns), "a timestamp does not belong to any frame");
    findings->HoldAtEnd(IsRigid(pose.T_world_rig, kRigidToConform),
                        "a pose is not a finite rigid motion");
    last = pose.stamp_ns;
  }
}

/// Drives one instance and holds every answer to the rules.
Said DriveAndHold(const Make& make, const std::vector<StereoFrame>& frames, Findings* findings) {
  const std::unique_ptr<Estimator> estimator = make();
  Said said;
  int map_id = std::numeric_limits<int>::min();
  for (const StereoFrame& original : frames) {
    const StereoFrame frame = Clone(original);
    const FrameEstimate estimate = estimator->Process(frame, {});
    findings->Hold(SamePixels(frame.left, original.left) && SamePixels(frame.right, original.right),
                   frame.id, "it writes to the caller's images");
    HoldEstimate(estimate, frame, findings);
    findings->Hold(MapIdOf(estimate) >= map_id, frame.id, "map_id falls");
    map_id = MapIdOf(estimate);
    said.live.push_back(estimate.T_world_rig);
  }
  said.final = estimator->Finish();
  HoldFinal(said.final, frames, findings);
  findings->HoldAtEnd(!said.final.empty(), "the final track is empty");
  return said;
}

/// Two instances in turn, whose images are painted over as soon as Process has returned.
std::pair<Said, Said> DriveSideBySide(const Make& make, const std::vector<StereoFrame>& frames) {
  const std::unique_ptr<Estimator> one = make(), other = make();
  std::pair<Said, Said> said;
  for (const StereoFrame& original : frames) {
    for (const auto& [estimator, into] :
         {std::pair(one.get(), &said.first), std::pair(other.get(), &said.second)}) {
      StereoFrame frame = Clone(original);
      into->live.push_back(estimator->Process(frame, {}).T_world_rig);
      frame.left.setTo(0);
      frame.right.setTo(255);
    }
  }
  said.first.final = one->Finish();
  said.second.final = other->Finish();
  return said;
}

/// Frames that show nothing, between frames that do: no error.
void HoldHardFrames(const Make& make, const std::vector<StereoFrame>& frames, Findings* findings) {
  const std::unique_ptr<Estimator> estimator = make();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    StereoFrame frame = Clone(frames[i]);
    ExternalMask mask;
    if (i % 4 == 1) {
      frame.left.setTo(0);
      frame.right.setTo(0);
    }
    if (i % 4 == 3) {
      mask.left = cv::Mat1b(frame.left.size(), std::uint8_t{255});
      mask.right = mask.left.clone();
    }
    try {
      HoldEstimate(estimator->Process(frame, mask), frame, findings);
    } catch (const std::exception& error) {
      return findings->Hold(
          false, frame.id,
          fmt::format("a black or wholly masked frame must not be an error: {}", error.what()));
    }
  }
  HoldFinal(estimator->Finish(), frames, findings);
}

}  // namespace

std::vector<std::string> CheckEstimator(const Make& make, const Sequence& sequence,
                                        const ConformanceOptions& options) {
  const std::vector<StereoFrame> frames = FirstFrames(sequence, options.frames);
  Findings findings;
  const Said said = DriveAndHold(make, frames, &findings);
  HoldHardFrames(make, frames, &findings);
  if (options.repeatable) {
    const auto [one, other] = DriveSideBySide(make, frames);
    findings.HoldAtEnd(SameBits(one, other), "two instances side by side give different results");
    findings.HoldAtEnd(SameBits(said, one),
                       "a second drive over the same frames, whose images were overwritten after "
                       "each Process, gives different results");
  }
  return findings.Take();
}

}  // namespace aisle
