#include <cmath>

#include "harness/cli/by_name.h"
#include "harness/cli/command.h"
#include "harness/cli/common_options.h"
#include "harness/common/seconds.h"
#include "harness/io/image.h"
#include "harness/io/input_error.h"
#include "harness/io/places.h"
#include "harness/plugs/simulated_sequence.h"
#include "harness/report/picture/overlay.h"
#include "harness/suite/suite.h"

namespace aisle {
namespace {

struct Options {
  SimulatedSequenceOptions simulation;
  double time_s = -1;
  int frame = -1;
  std::string output = "preview.png";
  std::string plan;  ///< file for the layout from above; empty: none
  bool plain = false;
};

FrameRequest Choose(const std::vector<FrameRequest>& schedule, const Options& options) {
  if (schedule.empty()) throw InputError(options.simulation.scene_file, 0, "has no frames");
  if (options.frame >= 0) {
    const auto index = static_cast<std::size_t>(options.frame);
    if (index < schedule.size()) return schedule[index];
    throw InputError(fmt::format("--frame: expected a frame in [0, {1}], got {0}", options.frame,
                                 schedule.size() - 1));
  }
  if (options.time_s < 0) return schedule[schedule.size() / 2];
  const double time_ns = std::trunc(options.time_s * 1e9);  // may be later than any stamp
  const auto at = std::find_if(schedule.begin(), schedule.end(), [&](const FrameRequest& r) {
    return static_cast<double>(r.stamp_ns) >= time_ns;
  });
  if (at != schedule.end()) return *at;
  throw InputError(fmt::format("--time {}: the scene ends at {:.2f} s", options.time_s,
                               ToSeconds(schedule.back().stamp_ns)));
}

int Preview(Options options) {
  CheckAreThere({options.simulation.scene_file});
  CheckImageName(options.output);
  if (!options.plan.empty()) CheckImageName(options.plan);
  options.simulation.assets_dir = AssetsDir().string();
  options.simulation.scene_name = SceneName(options.simulation.scene_file);
  options.simulation.any_lens = true;
  const std::unique_ptr<Sequence> sequence = OpenSimulation(options.simulation);
  const FrameRequest request = Choose(sequence->Schedule(), options);
  const SequenceFrame frame = sequence->At(request);
  const FrameTruth* truth = frame.truth && !options.plain ? &*frame.truth : nullptr;
  const std::string caption = fmt::format("{}  frame {}  {:.2f} s", sequence->name(), request.id,
                                          ToSeconds(request.stamp_ns));
  WriteImage(options.output,
             options.plain ? cv::Mat(frame.images.left)
                           : cv::Mat(DrawOverlay(frame.images.left, truth, nullptr, caption)));
  fmt::print("{}\n", options.output);
  if (!options.plan.empty()) {
    constexpr int kPlanWidth_px = 900;
    WriteImage(options.plan, DrawScenePlan(options.simulation, kPlanWidth_px).picture);
    fmt::print("{}\n", options.plan);
  }
  return kAllPassed;
}

}  // namespace

void AddPreviewCommand(CLI::App* app, Action* action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command =
      app->add_subcommand("preview", "Render one picture with its truth drawn over it");
  command->add_option("SCENE", options->simulation.scene_file, "Scene file or name")
      ->required()
      ->transform(ByName());
  auto* time = command->add_option("--time", options->time_s, "Time of the picture in seconds")
                   ->check(CLI::NonNegativeNumber);
  command->add_option("--frame", options->frame, "Number of the frame; default: the middle one")
      ->check(CLI::NonNegativeNumber)
      ->excludes(time);
  AddTwin(command, &options->simulation.twin);
  AddSeed(command, &options->simulation.seed);
  command->add_flag("--plain", options->plain, "Draw the picture alone, without truth");
  command->add_option("--plan", options->plan, "Also write the layout from above to this file");
  AddOutput(command, &options->output, "File to write, PNG or JPEG; default: preview.png");
  command->footer("Example: ./aisle preview scenes/paper/scene2.yaml --time 6 -o scene2.png");
  command->callback([=] { *action = [=] { return Preview(*options); }; });
}

}  // namespace aisle
