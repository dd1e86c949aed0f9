#include <charconv>

#include "harness/cli/command.h"
#include "harness/cli/places.h"
#include "harness/cli/terminal.h"
#include "harness/io/dataset.h"
#include "harness/io/input_error.h"
#include "harness/plugs/simulated_sequence.h"
#include "harness/run/frames_ahead.h"
#include "harness/suite/suite.h"

namespace aisle {
namespace {

struct Options {
  SimulatedSequenceOptions simulation;
  std::string out, format = "euroc", frames;
  std::vector<std::string> truth;
};

std::size_t FrameNumber(const std::string& text, const std::string& whole) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && end == text.data() + text.size()) return value;
  throw InputError("--frames " + Printable(whole) + ": expected A:B, for example 100:200");
}

/// A:B is half open; A or B may be left out.
std::vector<FrameRequest> Select(const std::vector<FrameRequest>& schedule,
                                 const std::string& frames) {
  if (frames.empty()) return schedule;
  const std::size_t colon = frames.find(':');
  if (colon == std::string::npos) FrameNumber("", frames);
  const std::string from = frames.substr(0, colon), to = frames.substr(colon + 1);
  const std::size_t first = from.empty() ? 0 : FrameNumber(from, frames);
  const std::size_t last =
      to.empty() ? schedule.size() : std::min(FrameNumber(to, frames), schedule.size());
  if (first >= last) {
    throw InputError(fmt::format("--frames {}: selects nothing of the frames 0 to {}", frames,
                                 schedule.size() - 1));
  }
  return {schedule.begin() + static_cast<std::ptrdiff_t>(first),
          schedule.begin() + static_cast<std::ptrdiff_t>(last)};
}

int Render(Options options) {
  options.simulation.assets_dir = AssetsDir().string();
  options.simulation.scene_name = SceneName(options.simulation.scene_file);
  const ExportOptions export_options{.format = DatasetFormatFromName(options.format),
                                     .truth = TruthSelectionFromNames(options.truth)};
  PathOfRig path;
  const auto sequence = OpenSimulation(options.simulation, nullptr, &path);
  const std::vector<FrameRequest> wanted = Select(sequence->Schedule(), options.frames);
  DatasetWriter writer(options.out, sequence->calibration(), sequence->rate_hz(), export_options);

  std::vector<FrameRequest> missing;
  for (const FrameRequest& request : wanted) {
    if (!writer.Has(request)) missing.push_back(request);
  }
  FramesAhead frames(*sequence, missing, 3);
  ProgressLine line;
  for (std::size_t i = 0; i < missing.size(); ++i) {
    writer.Add(frames.Next().frame);
    line.Show(fmt::format("frame {} of {}", i + 1, missing.size()));
  }
  line.Clear();
  writer.Finish(wanted, path);
  fmt::print("{}: {} frames, {} of them made now\n", options.out, wanted.size(), missing.size());
  return kAllPassed;
}

}  // namespace

void AddRenderCommand(CLI::App* app, Action* action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app->add_subcommand("render", "a dataset on disk, with its truth beside it");
  command->add_option("SCENE", options->simulation.scene_file, "scene file")->required();
  command->add_option("--out", options->out, "folder of the dataset")->required();
  command->add_option("--format", options->format, "euroc (default), kitti or tum")
      ->check(CLI::IsMember({"euroc", "kitti", "tum"}));
  command->add_option("--frames", options->frames, "A:B, B not included");
  command->add_option("--truth", options->truth, "depth,labels,dynamic,boxes or all")
      ->delimiter(',');
  command->add_option("--twin", options->simulation.twin, "live, empty or frozen");
  command->add_option("--seed", options->simulation.seed, "seed of the layout and the sensor");
  command->add_option("--isa", options->simulation.isa,
                      "instruction set of the tracer; avx2 (default) or native");
  command->add_option("--threads", options->simulation.threads, "0: all; never changes a pixel");
  command->footer(
      "Stopped, the same command goes on where it was.\n"
      "Example: ./aisle render scenes/paper/scene2.yaml --out scene2 --truth depth,dynamic");
  command->callback([=] { *action = [=] { return Render(*options); }; });
}

}  // namespace aisle
