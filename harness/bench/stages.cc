#include "harness/bench/stages.h"

#include <unistd.h>

#include <fstream>
#include <numeric>
#include <opencv2/features2d.hpp>

#include "harness/bench/shown.h"
#include "harness/common/stopwatch.h"
#include "harness/io/input_error.h"
#include "harness/plugs/systems.h"
#include "harness/score/statistics.h"

namespace aisle {
namespace {

double ResidentMib() {
  std::ifstream statm("/proc/self/statm");
  double pages = 0, resident_pages = 0;
  statm >> pages >> resident_pages;
  return resident_pages * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

double MillisecondsOf(const std::function<void()>& work) {
  const Stopwatch watch;
  work();
  return watch.ElapsedMs();
}

double ReferenceMs(const StereoFrame& frame) {
  const cv::Ptr<cv::ORB> orb = cv::ORB::create(1200);
  std::vector<cv::KeyPoint> keypoints;
  cv::Mat descriptors;
  return MillisecondsOf([&] {
    orb->detectAndCompute(frame.left, cv::noArray(), keypoints, descriptors);
    orb->detectAndCompute(frame.right, cv::noArray(), keypoints, descriptors);
  });
}

/// From the first frame of a lap to the first of the next. Throws InputError where a lap has none
/// that goes on.
std::int64_t LapNs(const BenchView& view, const std::vector<FrameRequest>& schedule, double rate_hz,
                   int laps) {
  if (laps == 1 || schedule.empty()) return 0;
  if (schedule.size() == 1) {
    throw InputError(Printable(view.text) + ": laps of one frame; expected two at least");
  }
  return schedule.back().stamp_ns - schedule.front().stamp_ns +
         static_cast<std::int64_t>(1e9 / rate_hz);
}

}  // namespace

double StageTime::mean_ms() const {
  return ms.empty() ? 0
                    : std::accumulate(ms.begin(), ms.end(), 0.0) / static_cast<double>(ms.size());
}

double StageTime::quantile_ms(double share) const { return ms.empty() ? 0 : Quantile(ms, share); }

std::vector<double> LatencyProfile(const StageTime& time, int times) {
  std::vector<double> profile;
  for (int i = 0; i < times && !time.ms.empty(); ++i) {
    profile.push_back(time.quantile_ms((i + 0.5) / times));
  }
  return profile;
}

std::map<std::string, StageTime> MeasureStages(const BenchView& view,
                                               const StageBenchOptions& options,
                                               const BenchProgress& progress,
                                               const std::function<void(const BenchLap&)>& lapped) {
  const auto sequence = OpenSourceFor(options.system, view, options.source);
  const int end =
      static_cast<int>(std::min<std::int64_t>(view.to, std::int64_t{view.from} + options.frames));
  const Excerpt stretch(*sequence, view.from, end);
  const std::vector<FrameRequest> schedule = stretch.Schedule();
  const std::int64_t lap_ns = LapNs(view, schedule, sequence->rate_hz(), options.laps);
  const MaskMaker masks = MasksFor(options.system, view, options.source);
  std::map<std::string, StageTime> stages;
  std::unique_ptr<Estimator> estimator;
  stages["set_up"].ms.push_back(MillisecondsOf([&] {  // what it loads: the visual words
    estimator =
        MakeSystem(options.system, sequence->calibration(), {.threads = options.source.threads});
  }));
  for (int lap = 0; lap < options.laps; ++lap) {
    FrameEstimate estimate;
    int lost = 0;
    for (const FrameRequest& request : schedule) {
      const SequenceFrame shown = stretch.At(request);
      const ExternalMask mask = masks(shown);
      StereoFrame images = shown.images;
      images.id += lap * std::ssize(schedule);
      images.stamp_ns += lap * lap_ns;
      if (options.laps == 1) stages["reference"].ms.push_back(ReferenceMs(images));
      stages["frame"].ms.push_back(
          MillisecondsOf([&] { estimate = estimator->Process(images, mask); }));
      for (const auto& [stage, ms] : estimate.stage_ms) stages[stage].ms.push_back(ms);
      lost += estimate.state == TrackingState::kTracking ? 0 : 1;
      if (progress) progress(fmt::format("frame {}", stages["frame"].ms.size()));
    }
    if (lapped) {
      lapped({.index = lap, .last = estimate, .lost = lost, .resident_mib = ResidentMib()});
    }
  }
  return stages;
}

}  // namespace aisle
