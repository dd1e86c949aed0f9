#include <unistd.h>

#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/features2d.hpp>

#include "harness/cli/bench_source.h"
#include "harness/cli/command.h"
#include "harness/cli/terminal.h"
#include "harness/io/file.h"
#include "harness/plugs/systems.h"
#include "harness/score/front_end.h"

namespace aisle {
namespace {

struct Options {
  std::string name = "paper/scene1", system = "orbslam2", json;
  BenchSource source{.twin = "empty"};
  int frames = 100, laps = 1;
};

/// What this process holds in memory now; 0 where the system does not say.
double ResidentMib() {
  std::ifstream statm("/proc/self/statm");
  double pages = 0, resident_pages = 0;
  statm >> pages >> resident_pages;
  return resident_pages * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

/// What a lap has left behind: a map grows with the place explored, not with the time spent in it.
void PrintLap(int lap, const FrameEstimate& last, int lost) {
  if (lap == 0) {
    fmt::print("{:>4} {:>10} {:>10} {:>10} {:>6}\n", "lap", "keyframes", "landmarks", "MiB",
               "lost");
  }
  const auto count = [&](const char* name) {
    const auto found = last.counts.find(name);
    return found == last.counts.end() ? 0 : found->second;
  };
  fmt::print("{:4} {:10} {:10} {:10.1f} {:6}\n", lap + 1, count("map_keyframes"),
             count("map_landmarks"), ResidentMib(), lost);
  std::fflush(stdout);  // hours may pass between two lines
}

/// Mean and worst of one stage, milliseconds, over the frames in which it ran.
struct StageTime {
  double sum_ms = 0, worst_ms = 0;
  int count = 0;

  void Add(double ms) {
    sum_ms += ms;
    worst_ms = std::max(worst_ms, ms);
    ++count;
  }
  double mean_ms() const { return count == 0 ? 0 : sum_ms / count; }
};

double MillisecondsOf(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
  return took.count();
}

/// OpenCV's own ORB on both eyes, one after the other: what the same machine, as busy as it is at
/// that moment, makes of work that everybody knows.
double ReferenceMs(const StereoFrame& frame) {
  const cv::Ptr<cv::ORB> orb = cv::ORB::create(1200);
  std::vector<cv::KeyPoint> keypoints;
  cv::Mat descriptors;
  return MillisecondsOf([&] {
    orb->detectAndCompute(frame.left, cv::noArray(), keypoints, descriptors);
    orb->detectAndCompute(frame.right, cv::noArray(), keypoints, descriptors);
  });
}

std::map<std::string, StageTime> Measure(const Options& options) {
  const auto sequence = OpenSource(options.name, options.source);
  std::map<std::string, StageTime> stages;
  std::unique_ptr<Estimator> estimator;
  stages["set_up"].Add(MillisecondsOf([&] {  // what it loads: the visual words
    estimator = FindSystem(options.system)
                    .make(sequence->calibration(), {.threads = options.source.threads});
  }));
  std::vector<FrameRequest> schedule = sequence->Schedule();
  schedule.resize(std::min(schedule.size(), static_cast<std::size_t>(options.frames)));
  const std::int64_t lap_ns = schedule.empty()
                                  ? 0
                                  : schedule.back().stamp_ns - schedule.front().stamp_ns +
                                        static_cast<std::int64_t>(1e9 / sequence->rate_hz());
  ProgressLine line;
  for (int lap = 0; lap < options.laps; ++lap) {
    FrameEstimate estimate;
    int lost = 0;
    for (const FrameRequest& request : schedule) {
      StereoFrame images = sequence->At(request).images;
      images.id += lap * std::ssize(schedule);
      images.stamp_ns += lap * lap_ns;
      if (options.laps == 1) stages["reference"].Add(ReferenceMs(images));
      stages["frame"].Add(MillisecondsOf([&] { estimate = estimator->Process(images, {}); }));
      for (const auto& [stage, ms] : estimate.stage_ms) stages[stage].Add(ms);
      lost += estimate.state == TrackingState::kTracking ? 0 : 1;
      line.Show(fmt::format("frame {}", stages["frame"].count));
    }
    line.Clear();
    if (options.laps > 1) PrintLap(lap, estimate, lost);
  }
  return stages;
}

int BenchSlam(const Options& options) {
  std::map<std::string, StageTime> stages = Measure(options);
  std::map<std::string, double> mean_ms;
  for (const auto& [stage, time] : stages) mean_ms[stage] = time.mean_ms();
  const double front_end_ms = FrontEndOf(mean_ms).value_or(FrontEndMs{}).total();
  const double reference_ms = stages["reference"].mean_ms();
  fmt::print("{:18} {:>9} {:>9} {:>7}\n", "stage", "mean ms", "worst ms", "frames");
  for (const auto& [stage, time] : stages) {
    fmt::print("{:18} {:9.2f} {:9.2f} {:7}\n", stage, time.mean_ms(), time.worst_ms, time.count);
  }
  fmt::print("front end: {:.2f} ms a frame", front_end_ms);
  if (reference_ms > 0) {
    fmt::print(", {:.2f} times OpenCV's ORB on both eyes", front_end_ms / reference_ms);
  }
  fmt::print("\n");
  if (!options.json.empty()) {
    const nlohmann::json result = {{"extract_ms", stages["extract"].mean_ms()},
                                   {"stereo_ms", stages["stereo"].mean_ms()},
                                   {"track_ms", stages["track"].mean_ms()},
                                   {"map_ms", stages["mapping"].mean_ms()},
                                   {"front_end_ms", front_end_ms},
                                   {"reference_orb_ms", reference_ms},
                                   {"ratio", front_end_ms / std::max(reference_ms, 1e-9)},
                                   {"frames", stages["frame"].count}};
    WriteFileAtomically(options.json, result.dump(2) + "\n");
  }
  return kAllPassed;
}

}  // namespace

void AddBenchSlam(CLI::App* bench, Action* action) {
  const auto options = std::make_shared<Options>();
  CLI::App* slam = bench->add_subcommand("slam", "milliseconds a frame by stage of the SLAM");
  slam->add_option("SOURCE", options->name,
                   "scene file or folder of a recording; default paper/scene1");
  AddSourceOptions(slam, &options->source);
  slam->add_option("--system", options->system, "default orbslam2");
  slam->add_option("--frames", options->frames, "at most; default 100")
      ->check(CLI::Range(1, 100000));
  slam->add_option(
          "--laps", options->laps,
          "drive the frames so often, one after the other, and say what each lap leaves in "
          "memory; for a source that ends where it begins")
      ->check(CLI::Range(1, 100000));
  slam->add_option("--json", options->json, "write the means there too");
  slam->footer(
      "Example: ./aisle bench slam --json slam.json\n"
      "         ./aisle bench slam paper/scene4 --laps 20 --frames 900 --frames-dir f");
  slam->callback([=] { *action = [=] { return BenchSlam(*options); }; });
}

}  // namespace aisle
