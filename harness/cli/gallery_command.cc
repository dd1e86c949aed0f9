#include <algorithm>
#include <filesystem>
#include <set>

#include "harness/cli/command.h"
#include "harness/io/file.h"
#include "harness/io/image.h"
#include "harness/io/input_error.h"
#include "harness/io/places.h"
#include "harness/plugs/simulated_sequence.h"
#include "harness/report/picture/overlay.h"
#include "harness/suite/suite.h"

namespace aisle {
namespace {

struct Options {
  std::vector<std::string> places;
  std::string output = "reports/gallery";
  int samples = 16;
  std::uint64_t seed = 1;
  double plan_px = 560;
};

/// One frame of a scene: how much of the image people and vehicles take.
struct Sample {
  FrameRequest request;
  double people = 0;  ///< share of the image, 0 to 1
  double actors = 0;  ///< people and vehicles
};

struct Entry {
  std::string name;
  ScenePlan plan;
  std::vector<Sample> samples;
};

std::vector<std::string> ScenesOf(const std::vector<std::string>& places) {
  std::set<std::string> found;
  for (const std::string& place : places) {
    if (!std::filesystem::is_directory(place)) {
      found.insert(place);
      continue;
    }
    for (const auto& entry : std::filesystem::recursive_directory_iterator(place)) {
      const std::string file = entry.path().string();
      if (entry.path().extension() == ".yaml" && !IsSuiteFile(file)) found.insert(file);
    }
  }
  return {found.begin(), found.end()};
}

Sample Measure(const FrameRequest& request, const FrameTruth& truth) {
  Sample sample{request, 0, 0};
  const double pixels = static_cast<double>(truth.instance.total());
  for (const ObjectTruth& object : truth.objects) {
    const double share = object.visible_pixels / pixels;
    sample.actors += share;
    if (object.object_class == "person") sample.people += share;
  }
  return sample;
}

/// Shares as a row of blocks, an eighth of the image a step.
std::string Bars(const std::vector<Sample>& samples) {
  static const std::array<const char*, 9> kBlocks = {"·", "▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
  std::string bars;
  for (const Sample& sample : samples) {
    const double step = std::ceil(sample.people * 8 - 1e-3);
    bars += kBlocks[static_cast<std::size_t>(std::clamp(step, 0.0, 8.0))];
  }
  return bars;
}

/// Photographs the scene through its time; keeps the picture in which actors show most, short of
/// hiding everything else.
Entry Photograph(const std::string& file, const Options& options) {
  SimulatedSequenceOptions simulation;
  simulation.scene_file = file;
  simulation.scene_name = SceneName(file);
  simulation.assets_dir = AssetsDir().string();
  simulation.seed = options.seed;
  Entry entry{simulation.scene_name, DrawScenePlan(simulation, options.plan_px), {}};
  const std::unique_ptr<Sequence> sequence = OpenSimulation(simulation);
  const std::vector<FrameRequest> schedule = sequence->Schedule();
  constexpr double kCrowded = 0.5;
  double best = -1;
  cv::Mat3b picture;
  for (int i = 0; i < options.samples; ++i) {
    const std::size_t index = schedule.size() * static_cast<std::size_t>(2 * i + 1) /
                              static_cast<std::size_t>(2 * options.samples);
    const SequenceFrame frame = sequence->At(schedule[index]);
    entry.samples.push_back(Measure(schedule[index], *frame.truth));
    const double share = entry.samples.back().actors;
    if (share > kCrowded || share <= best) continue;
    best = share;
    const std::string caption =
        fmt::format("{}  frame {}  {:.1f} s", entry.name, schedule[index].id,
                    static_cast<double>(schedule[index].stamp_ns) * 1e-9);
    picture = DrawOverlay(frame.images.left, &*frame.truth, nullptr, caption);
  }
  const std::filesystem::path base = std::filesystem::path(options.output) / entry.name;
  if (picture.empty()) {  // crowded from first to last
    const SequenceFrame frame = sequence->At(schedule.front());
    picture = DrawOverlay(frame.images.left, &*frame.truth, nullptr, entry.name);
  }
  WriteImage(base.string() + ".jpg", picture);
  WriteImage(base.string() + "_plan.png", entry.plan.picture);
  return entry;
}

std::string Describe(const Entry& entry) {
  const auto most = std::ranges::max_element(entry.samples, {}, &Sample::people);
  double mean = 0;
  for (const Sample& sample : entry.samples) {
    mean += sample.people / static_cast<double>(entry.samples.size());
  }
  return fmt::format(
      "## {0}\n\n{1}\n\n"
      "People's share of the image over time `{2}`: {3:.1f} % on average, {4:.1f} % at most, at "
      "{5:.1f} s.\n\n"
      "![{0} with its truth drawn over it]({0}.jpg)\n![{0} from above]({0}_plan.png)\n\n",
      entry.name, entry.plan.about, Bars(entry.samples), 100 * mean, 100 * most->people,
      static_cast<double>(most->request.stamp_ns) * 1e-9);
}

int Gallery(const Options& options) {
  const std::vector<std::string> files = ScenesOf(options.places);
  if (files.empty()) {
    fmt::print(stderr, "no scene file: name scenes or folders of them\n");
    return kNothingToDo;
  }
  std::string page = fmt::format(
      "# Every scene\n\n"
      "Made by `./aisle gallery {} -o {}`. In the pictures, red is what moves now, boxes are "
      "people "
      "and vehicles with their speeds. In the layouts, red is the rig's way, blue the actors'. The "
      "row of blocks is the share of the image that people cover at {} times spread over the "
      "scene, "
      "an eighth of the image a step.\n\n",
      fmt::join(options.places, " "), options.output, options.samples);
  for (const std::string& file : files) {
    page += Describe(Photograph(file, options));
    fmt::print("{}\n", SceneName(file));
    std::fflush(stdout);
  }
  WriteFileAtomically(std::filesystem::path(options.output) / "README.md", page);
  return kAllPassed;
}

}  // namespace

void AddGalleryCommand(CLI::App* app, Action* action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command =
      app->add_subcommand("gallery", "pictures, layouts and people's image share of many scenes");
  command->add_option("SCENE", options->places, "scene files or folders of them")->required();
  command->add_option("-o,--out", options->output, "folder; default reports/gallery");
  command->add_option("--samples", options->samples, "frames looked at in each scene; default 16")
      ->check(CLI::Range(1, 10000));
  command->add_option("--seed", options->seed, "seed of the layout and the sensor");
  command->footer("Example: ./aisle gallery scenes -o reports/gallery");
  command->callback([=] { *action = [=] { return Gallery(*options); }; });
}

}  // namespace aisle
