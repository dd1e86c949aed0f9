#include <chrono>
#include <nlohmann/json.hpp>
#include <opencv2/features2d.hpp>

#include "harness/cli/command.h"
#include "harness/cli/places.h"
#include "harness/cli/terminal.h"
#include "harness/io/dataset.h"
#include "harness/io/file.h"
#include "harness/plugs/recorded_sequence.h"
#include "harness/plugs/simulated_sequence.h"
#include "harness/plugs/systems.h"
#include "harness/suite/suite.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string source, format = "euroc", twin = "empty", system = "orbslam2", json;
  int frames = 100, threads = 0;
};

std::unique_ptr<Sequence> Open(const Options& options) {
  if (fs::is_directory(options.source)) {
    return OpenRecording(options.source, DatasetFormatFromName(options.format));
  }
  return OpenSimulation({.scene_file = options.source,
                         .scene_name = SceneName(options.source),
                         .assets_dir = AssetsDir().string(),
                         .twin = options.twin});
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
  const auto sequence = Open(options);
  std::map<std::string, StageTime> stages;
  std::unique_ptr<Estimator> estimator;
  stages["set_up"].Add(MillisecondsOf([&] {  // what it loads: the visual words
    estimator =
        FindSystem(options.system).make(sequence->calibration(), {.threads = options.threads});
  }));
  ProgressLine line;
  for (const FrameRequest& request : sequence->Schedule()) {
    if (stages["frame"].count >= options.frames) break;
    const StereoFrame images = sequence->At(request).images;
    stages["reference"].Add(ReferenceMs(images));
    FrameEstimate estimate;
    stages["frame"].Add(MillisecondsOf([&] { estimate = estimator->Process(images, {}); }));
    for (const auto& [stage, ms] : estimate.stage_ms) stages[stage].Add(ms);
    line.Show(fmt::format("frame {}", stages["frame"].count));
  }
  line.Clear();
  return stages;
}

int BenchSlam(const Options& options) {
  std::map<std::string, StageTime> stages = Measure(options);
  // The front end in the caller's thread: what a camera's rate must leave room for.
  const double front_end_ms =
      stages["extract"].mean_ms() + stages["stereo"].mean_ms() + stages["track"].mean_ms();
  const double reference_ms = stages["reference"].mean_ms();
  fmt::print("{:18} {:>9} {:>9} {:>7}\n", "stage", "mean ms", "worst ms", "frames");
  for (const auto& [stage, time] : stages) {
    fmt::print("{:18} {:9.2f} {:9.2f} {:7}\n", stage, time.mean_ms(), time.worst_ms, time.count);
  }
  fmt::print(
      "extract + stereo + track: {:.2f} ms a frame, {:.2f} times OpenCV's ORB on both eyes\n",
      front_end_ms, front_end_ms / std::max(reference_ms, 1e-9));
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
  options->source = AISLE_SOURCE_DIR "/scenes/paper/scene1.yaml";
  CLI::App* slam = bench->add_subcommand("slam", "milliseconds a frame by stage of the SLAM");
  slam->add_option("SOURCE", options->source,
                   "scene file or folder of a recording; default paper/scene1");
  slam->add_option("--format", options->format, "of a folder: euroc (default) or kitti")
      ->check(CLI::IsMember({"euroc", "kitti"}));
  slam->add_option("--twin", options->twin, "of a scene: empty (default), live or frozen");
  slam->add_option("--system", options->system, "default orbslam2");
  slam->add_option("--frames", options->frames, "at most; default 100")
      ->check(CLI::Range(1, 100000));
  slam->add_option("--threads", options->threads, "0: all");
  slam->add_option("--json", options->json, "write the means there too");
  slam->footer("Example: ./aisle bench slam --json slam.json");
  slam->callback([=] { *action = [=] { return BenchSlam(*options); }; });
}

}  // namespace aisle
