#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "harness/cli/by_name.h"
#include "harness/cli/command.h"
#include "harness/cli/common_options.h"
#include "harness/cli/files_below.h"
#include "harness/cli/page_block.h"
#include "harness/common/seconds.h"
#include "harness/io/file.h"
#include "harness/io/image.h"
#include "harness/io/input_error.h"
#include "harness/io/places.h"
#include "harness/io/shell_word.h"
#include "harness/plugs/simulated_sequence.h"
#include "harness/record/record_json.h"
#include "harness/report/picture/overlay.h"
#include "harness/suite/recording.h"
#include "harness/suite/suite.h"

namespace aisle {
namespace {

struct Options {
  std::vector<std::string> places;
  std::string output = "reports/gallery";
  int samples = 16;
  std::uint64_t seed = 1;
  int plan_px = 560;
  bool shares = false, json = false;
  PageBlock into{"shares"};
};

/// One frame of a scene: how much of the image is taken by what may move.
struct Sample {
  FrameRequest request;
  double actors = 0;  ///< what may move; share of the image, 0 to 1
  double moving = 0;  ///< what moves now, whoever it belongs to
};

struct Entry {
  std::string name;
  ScenePlan plan;
  std::vector<Sample> samples;
  std::size_t frames = 0;
};

/// Folders stand for the scenes below them.
std::vector<std::string> ScenesOf(const std::vector<std::string>& places) {
  std::set<std::string> found;
  for (const std::string& place : places) {
    if (!std::filesystem::is_directory(place)) {
      found.insert(place);
      continue;
    }
    for (const std::string& file : FilesBelow(place)) {
      if (!IsSuiteFile(file) && !IsRecording(file)) found.insert(file);
    }
  }
  return {found.begin(), found.end()};
}

Sample Measure(const FrameRequest& request, const FrameTruth& truth) {
  Sample sample{.request = request};
  const double pixels = static_cast<double>(truth.instance.total());
  for (const ObjectTruth& object : truth.objects) sample.actors += object.visible_pixels / pixels;
  sample.moving = cv::countNonZero(truth.dynamic) / pixels;
  return sample;
}

/// Shares as a row of blocks, an eighth of the image a step.
std::string Bars(const std::vector<Sample>& samples, double Sample::*share) {
  static const std::array<const char*, 9> kBlocks = {"·", "▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
  std::string bars;
  for (const Sample& sample : samples) {
    const double step = std::ceil(sample.*share * 8 - 1e-3);
    bars += kBlocks[static_cast<std::size_t>(std::clamp(step, 0.0, 8.0))];
  }
  return bars;
}

double Mean(const std::vector<Sample>& samples, double Sample::*share) {
  double mean = 0;
  for (const Sample& sample : samples) {
    mean += sample.*share / static_cast<double>(samples.size());
  }
  return mean;
}

double Seconds(const Sample& sample) { return ToSeconds(sample.request.stamp_ns); }

SimulatedSequenceOptions SimulationOf(const std::string& file, const Options& options) {
  return {.scene_file = file,
          .scene_name = SceneName(file),
          .assets_dir = AssetsDir().string(),
          .seed = options.seed,
          .any_lens = true};
}

/// Frames spread over the scene.
std::vector<FrameRequest> Moments(const Sequence& sequence, int samples) {
  const std::vector<FrameRequest> schedule = sequence.Schedule();
  std::vector<FrameRequest> moments;
  for (int i = 0; i < samples; ++i) {
    moments.push_back(schedule[schedule.size() * static_cast<std::size_t>(2 * i + 1) /
                               static_cast<std::size_t>(2 * samples)]);
  }
  return moments;
}

/// So many frames at most make a sheet: the views of a hall.
constexpr std::size_t kViews = 6;

/// All frames, one below the other.
cv::Mat3b Sheet(const Sequence& sequence, const std::string& name) {
  cv::Mat sheet;
  for (const FrameRequest& moment : sequence.Schedule()) {
    const SequenceFrame frame = sequence.At(moment);
    const std::string caption = fmt::format("{}  view {}", name, moment.id + 1);
    const cv::Mat3b picture = DrawOverlay(frame.images.left, &*frame.truth, nullptr, caption);
    if (sheet.empty()) {
      sheet = picture;
    } else {
      cv::vconcat(sheet, picture, sheet);
    }
  }
  return sheet;
}

/// Photographs the scene through its time; keeps the picture of which actors have most nearly half.
Entry Photograph(const std::string& file, const Options& options) {
  const SimulatedSequenceOptions simulation = SimulationOf(file, options);
  Entry entry{simulation.scene_name, DrawScenePlan(simulation, options.plan_px), {}, 0};
  const std::unique_ptr<Sequence> sequence = OpenSimulation(simulation);
  entry.frames = sequence->Schedule().size();
  constexpr double kBestShare = 0.5;
  double off_best = 1;
  cv::Mat3b picture;
  const int samples = entry.frames <= kViews ? 0 : options.samples;
  for (const FrameRequest& moment : Moments(*sequence, samples)) {
    const SequenceFrame frame = sequence->At(moment);
    entry.samples.push_back(Measure(moment, *frame.truth));
    const double off = std::abs(entry.samples.back().actors - kBestShare);
    if (off >= off_best) continue;
    off_best = off;
    const std::string caption =
        fmt::format("{}  frame {}  {:.1f} s", entry.name, moment.id, Seconds(entry.samples.back()));
    picture = DrawOverlay(frame.images.left, &*frame.truth, nullptr, caption);
  }
  const std::filesystem::path base = std::filesystem::path(options.output) / entry.name;
  if (sequence->Schedule().size() <= kViews) {
    picture = Sheet(*sequence, entry.name);
  }
  WriteImage(base.string() + ".jpg", picture);
  WriteImage(base.string() + "_plan.png", entry.plan.picture);
  return entry;
}

std::string Describe(const Entry& entry) {
  if (entry.frames <= kViews) {
    return fmt::format(
        "## {0}\n\n{1}\n\n![{0} from its views]({0}.jpg)\n![{0} from above]({0}_plan.png)\n\n",
        entry.name, entry.plan.about);
  }
  const auto most = std::ranges::max_element(entry.samples, {}, &Sample::actors);
  return fmt::format(
      "## {0}\n\n{1}\n\n"
      "Actors' share of the image over time `{2}`: {3:.1f} % on average, {4:.1f} % at most, at "
      "{5:.1f} s.\n\n"
      "![{0} with its truth drawn over it]({0}.jpg)\n![{0} from above]({0}_plan.png)\n\n",
      entry.name, entry.plan.about, Bars(entry.samples, &Sample::actors),
      100 * Mean(entry.samples, &Sample::actors), 100 * most->actors, Seconds(*most));
}

/// How the page begins that lists the scenes.
constexpr const char* kPageHead = "# Every scene\n\nMade by `";

std::filesystem::path PageOf(const Options& options) {
  return std::filesystem::path(options.output) / "README.md";
}

/// Throws InputError where the page would take the place of one that somebody else wrote.
void CheckPage(const std::filesystem::path& page) {
  if (!std::filesystem::exists(page) || ReadFile(page).starts_with(kPageHead)) return;
  throw InputError(page.string(), 0, "not a gallery page; choose another folder (-o)");
}

/// What was asked for beside the defaults and decides the pictures.
std::string Departures(const Options& options) {
  const Options usual;
  std::string departures;
  if (options.samples != usual.samples) departures += fmt::format(" --samples {}", options.samples);
  if (options.seed != usual.seed) departures += fmt::format(" --seed {}", options.seed);
  return departures;
}

/// How much of the image moves now, over the time of each scene: no picture is written.
int PrintShares(const std::vector<std::string>& files, const Options& options) {
  options.into.Check();
  nlohmann::ordered_json scenes = nlohmann::ordered_json::array();
  std::string table = fmt::format(
      "| scene | share of the image that moves, {} times | mean, % | most, % | at, s |\n"
      "|---|---|---:|---:|---:|\n",
      options.samples);
  for (const std::string& file : files) {
    const std::unique_ptr<Sequence> sequence = OpenSimulation(SimulationOf(file, options));
    std::vector<Sample> samples;
    nlohmann::ordered_json shares = nlohmann::ordered_json::array();
    for (const FrameRequest& moment : Moments(*sequence, options.samples)) {
      samples.push_back(Measure(moment, *sequence->At(moment).truth));
      shares.push_back({{"frame", moment.id}, {"moving", samples.back().moving}});
    }
    const double mean = Mean(samples, &Sample::moving);
    const Sample& most = *std::ranges::max_element(samples, {}, &Sample::moving);
    table +=
        fmt::format("| {} | `{}` | {:.1f} | {:.1f} | {:.1f} |\n", sequence->name(),
                    Bars(samples, &Sample::moving), 100 * mean, 100 * most.moving, Seconds(most));
    if (options.json) {
      scenes.push_back({{"scene", sequence->name()}, {"mean", mean}, {"frames", shares}});
      continue;
    }
    fmt::print("{:28} {}  {:5.1f} % on average, {:5.1f} % at most, at {:.1f} s\n", sequence->name(),
               Bars(samples, &Sample::moving), 100 * mean, 100 * most.moving, Seconds(most));
    std::fflush(stdout);
  }
  options.into.Write(fmt::format("{}\nSeed {}, twin live, left camera.\n", table, options.seed));
  if (options.json) fmt::print("{}", Dump({{"seed", options.seed}, {"scenes", scenes}}));
  return kAllPassed;
}

int Gallery(const Options& options) {
  CheckAreThere(options.places);
  const std::vector<std::string> files = ScenesOf(options.places);
  if (files.empty()) {
    fmt::print(stderr, "no scene files: name scenes or folders of them\n");
    return kNothingToDo;
  }
  if (options.shares) return PrintShares(files, options);
  CheckPage(PageOf(options));
  std::vector<std::string> places;
  for (const std::string& place : options.places) places.push_back(ShellWord(place));
  std::string page = fmt::format(
      "{}{} gallery {}{} -o {}`. In the pictures, red is what moves now, boxes are "
      "what may move, with its speed. In the layouts, red is the rig's way, blue the actors'. The "
      "row of blocks is the share of the image that actors cover at {} times spread over the "
      "scene, an eighth of the image a step.\n\n",
      kPageHead, OwnCommand(), fmt::join(places, " "), Departures(options),
      ShellWord(options.output), options.samples);
  for (const std::string& file : files) {
    page += Describe(Photograph(file, options));
    fmt::print("{}\n", SceneName(file));
    std::fflush(stdout);
  }
  WriteFileAtomically(PageOf(options), page);
  return kAllPassed;
}

}  // namespace

void AddGalleryCommand(CLI::App* app, Action* action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app->add_subcommand(
      "gallery", "Draw pictures, layouts and actors' share of the image for many scenes");
  command->add_option("SCENE", options->places, "Scene files, or folders of them")
      ->required()
      ->transform(ByName());
  AddOutput(command, &options->output, "Folder of the gallery; default: reports/gallery");
  command->add_option("--samples", options->samples, "Frames to look at in each scene; default: 16")
      ->check(CLI::Range(1, 10000));
  AddSeed(command, &options->seed);
  CLI::Option* shares =
      command->add_flag("--shares", options->shares,
                        "Print how much of the image moves over time, and draw no pictures");
  AddJson(command, &options->json, "Print the shares as JSON")->needs(shares);
  options->into.AddTo(command)->needs(shares);
  command->footer(
      "Example: ./aisle gallery scenes -o reports/gallery\n"
      "         ./aisle gallery scenes/paper_narrow --shares");
  command->callback([=] { *action = [=] { return Gallery(*options); }; });
}

}  // namespace aisle
