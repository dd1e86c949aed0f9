#include <charconv>

#include "harness/cli/by_name.h"
#include "harness/cli/command.h"
#include "harness/cli/common_options.h"
#include "harness/cli/render_bag.h"
#include "harness/cli/terminal.h"
#include "harness/io/dataset.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/io/odometry_files.h"
#include "harness/io/places.h"
#include "harness/plugs/simulated_drive.h"
#include "harness/plugs/simulated_sequence.h"
#include "harness/plugs/wheel_odometry.h"
#include "harness/run/frames_ahead.h"
#include "harness/suite/suite.h"

namespace aisle {
namespace {

struct Options {
  SimulatedSequenceOptions simulation;
  std::string out, format = "euroc", frames, pair;
  std::vector<std::string> truth;
  bool verify = false, odometry = false;
};

std::size_t FrameNumber(const std::string& text, const std::string& whole) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && end == text.data() + text.size()) return value;
  throw InputError("--frames " + Printable(whole) + ": expected A:B, for example 100:200");
}

/// Half open.
struct FrameRange {
  std::size_t first = 0, last = std::numeric_limits<std::size_t>::max();
};

/// A:B; A or B may be left out, or all.
FrameRange RangeFromText(const std::string& frames) {
  FrameRange range;
  if (frames.empty()) return range;
  const std::size_t colon = frames.find(':');
  if (colon == std::string::npos) FrameNumber("", frames);
  const std::string from = frames.substr(0, colon), to = frames.substr(colon + 1);
  if (!from.empty()) range.first = FrameNumber(from, frames);
  if (!to.empty()) range.last = FrameNumber(to, frames);
  if (range.first >= range.last) {
    throw InputError("--frames " + Printable(frames) + ": selects nothing");
  }
  return range;
}

/// Who names an end has it: a scene that is shorter is told before anything is rendered.
std::vector<FrameRequest> Select(const std::vector<FrameRequest>& schedule, FrameRange range) {
  const bool to_the_end = range.last == std::numeric_limits<std::size_t>::max();
  if (!to_the_end && range.last > schedule.size() && range.first < schedule.size()) {
    throw InputError(fmt::format(
        "--frames: the scene ends before frame {}; it has {} frames: use {}:{} or {}:", range.last,
        schedule.size(), range.first, schedule.size(), range.first));
  }
  range.last = std::min(range.last, schedule.size());
  if (range.first >= range.last) {
    throw InputError(fmt::format("--frames: no frames from {} on; the scene has 0 to {}",
                                 range.first, schedule.size() - 1));
  }
  return {schedule.begin() + static_cast<std::ptrdiff_t>(range.first),
          schedule.begin() + static_cast<std::ptrdiff_t>(range.last)};
}

/// A pose as the 16 numbers of its matrix, row by row.
std::string MatrixText(const Eigen::Isometry3d& pose) {
  std::string text;
  for (int k = 0; k < 16; ++k) {
    text += fmt::format("{}{}", k > 0 ? " " : "", pose.matrix()(k / 4, k % 4));
  }
  return text;
}

std::map<std::string, std::string> ProvenanceOf(const Options& options,
                                                const SimulationForExport& simulation) {
  std::map<std::string, std::string> provenance = {
      {"scene", options.simulation.scene_name},
      {"seed", std::to_string(options.simulation.seed)},
      {"twin", options.simulation.twin},
      {"isa", options.simulation.isa},
      {"content_hash", fmt::format("{:016x}", simulation.content_hash)}};
  if (!simulation.pair.empty()) {
    provenance["pair"] = simulation.pair;
    provenance["T_vehicle_left_camera"] = MatrixText(simulation.T_base_rig);
  }
  return provenance;
}

/// Proves the truth of the frames; the numbers go to truth/proofs.csv.
int Verify(const SimulationForExport& simulation, const std::vector<FrameRequest>& frames,
           const DatasetWriter& writer, const std::filesystem::path& out) {
  std::string table =
      "image,scene_frame,raster_agreement,stereo_median_px,flow_median_px,static_change_grey,"
      "mover_flicker_grey,shadow_flicker_grey,failure\n";
  FrameProof worst{.raster_agreement = 1, .failure = ""};
  std::size_t failures = 0;
  ProgressLine line;
  for (const FrameRequest& frame : frames) {
    const FrameProof proof = simulation.prove(frame);
    table += fmt::format("{},{},{},{},{},{:.3f},{:.3f},{:.3f},{}\n", writer.NameOf(frame), frame.id,
                         proof.raster_agreement, proof.stereo_median_px, proof.flow_median_px,
                         proof.static_change_grey, proof.mover_flicker_grey,
                         proof.shadow_flicker_grey, proof.failure);
    worst.static_change_grey = std::max(worst.static_change_grey, proof.static_change_grey);
    worst.mover_flicker_grey = std::max(worst.mover_flicker_grey, proof.mover_flicker_grey);
    worst.shadow_flicker_grey = std::max(worst.shadow_flicker_grey, proof.shadow_flicker_grey);
    worst.raster_agreement = std::min(worst.raster_agreement, proof.raster_agreement);
    worst.stereo_median_px = std::max(worst.stereo_median_px, proof.stereo_median_px);
    worst.flow_median_px = std::max(worst.flow_median_px, proof.flow_median_px);
    if (!proof.failure.empty()) {
      line.Clear();
      fmt::print(stderr, "frame {}: {}\n", frame.id, proof.failure);
      ++failures;
    }
    line.Show(fmt::format("checked frame {}", frame.id));
  }
  line.Clear();
  WriteFileAtomically(out / "truth/proofs.csv", table);
  fmt::print(
      "checked {} frames: {} failed; worst values: the rasteriser agrees on {:.3f} % of the "
      "pixels, left warps to right within {:.4f} px and to the next frame within {:.4f} px "
      "(medians); along the flow, static surfaces change by {:.2f}, moving ones flicker by {:.2f} "
      "and moving shadows by {:.2f} grey levels\n",
      frames.size(), failures, 100 * worst.raster_agreement, worst.stereo_median_px,
      worst.flow_median_px, worst.static_change_grey, worst.mover_flicker_grey,
      worst.shadow_flicker_grey);
  return failures == 0 ? kAllPassed : kVerdictFailed;
}

/// Of the frames of the dataset; where these begin later, the wheels have slipped before.
void AddOdometry(const Sequence& sequence, const std::vector<FrameRequest>& frames,
                 const SimulatedSequenceOptions& simulation, const ExportOptions& options,
                 const std::filesystem::path& out) {
  const WheelMotions all =
      MeasureByWheels(sequence, simulation.seed, WheelsOfScene(simulation.scene_file));
  const auto first = all.begin() + frames.front().id;
  const auto count = static_cast<std::ptrdiff_t>(frames.size()) - 1;
  WriteOdometry(out, JoinMotions(frames, {first, first + count}), options);
}

int RenderAsBag(const Options& options) {
  if (!options.truth.empty() || options.verify) {
    throw InputError(
        "--format ros2: a bag always holds poses, depth, dynamic masks and boxes; --truth and "
        "--verify are not supported");
  }
  const FrameRange range = RangeFromText(options.frames);
  SimulationForExport simulation = OpenForExport(options.simulation, options.pair);
  if (options.odometry) {
    simulation.sequence = WithOdometry(std::move(simulation.sequence), options.simulation.seed,
                                       WheelsOfScene(options.simulation.scene_file));
  }
  RenderBag(simulation, Select(simulation.sequence->Schedule(), range),
            options.simulation.scene_file, ProvenanceOf(options, simulation), options.odometry,
            options.out);
  return kAllPassed;
}

int Render(Options options) {
  CheckAreThere({options.simulation.scene_file});
  options.simulation.assets_dir = AssetsDir().string();
  options.simulation.scene_name = SceneName(options.simulation.scene_file);
  if (options.format == "ros2") return RenderAsBag(options);
  ExportOptions export_options{.format = DatasetFormatFromName(options.format),
                               .truth = TruthSelectionFromNames(options.truth)};
  const FrameRange range = RangeFromText(options.frames);
  SimulationForExport simulation = OpenForExport(options.simulation, options.pair);
  const Sequence& sequence = *simulation.sequence;
  const std::vector<FrameRequest> wanted = Select(sequence.Schedule(), range);
  export_options.lens = simulation.lens;
  export_options.colour = static_cast<bool>(simulation.colour);
  export_options.labels = simulation.labels;
  export_options.provenance = ProvenanceOf(options, simulation);
  DatasetWriter writer(options.out, sequence.calibration(), sequence.rate_hz(), wanted,
                       export_options);
  writer.Begin();

  std::vector<FrameRequest> missing;
  for (const FrameRequest& request : wanted) {
    if (!writer.Has(request)) missing.push_back(request);
  }
  FramesAhead frames(sequence, missing, 3);
  ProgressLine line;
  for (std::size_t i = 0; i < missing.size(); ++i) {
    const SequenceFrame frame = frames.Next().frame;
    std::optional<FrameMotion> motion;
    if (export_options.truth.NeedsMotion()) motion = simulation.motion(missing[i]);
    std::optional<ColourPair> colour;
    if (export_options.colour) colour = simulation.colour(missing[i]);
    writer.Add(frame, motion ? &*motion : nullptr, colour ? &*colour : nullptr);
    line.Show(fmt::format("frame {} of {}", i + 1, missing.size()));
  }
  line.Clear();
  writer.Finish(simulation.path);
  if (options.odometry) {
    AddOdometry(sequence, wanted, options.simulation, export_options, options.out);
  }
  fmt::print("{}: {} frames, {} of them rendered now\n", options.out, wanted.size(),
             missing.size());
  return options.verify ? Verify(simulation, wanted, writer, options.out) : kAllPassed;
}

}  // namespace

void AddRenderCommand(CLI::App* app, Action* action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command =
      app->add_subcommand("render", "Write a scene as a dataset, with its truth beside it");
  command->add_option("SCENE", options->simulation.scene_file, "Scene file or name")
      ->required()
      ->transform(ByName());
  AddTwin(command, &options->simulation.twin);
  AddSeed(command, &options->simulation.seed);
  command->add_option("--frames", options->frames,
                      "Only render frames A:B, of which B is the first left out");
  command->add_option(
      "--pair", options->pair,
      "Pair of the rig's cameras to render; default: the one that systems are shown");
  command->option_defaults()->group("Dataset");
  AddOutput(command, &options->out, "Folder of the dataset")->required();
  command
      ->add_option("--format", options->format,
                   "Layout of the dataset; ros2 is a bag, drive.mcap; default: euroc")
      ->check(CLI::IsMember({"euroc", "kitti", "tum", "ros2"}));
  command
      ->add_option("--truth", options->truth,
                   "Truth to write, separated by commas: depth, labels, dynamic, boxes, flow, "
                   "stereo, shadows or all")
      ->delimiter(',');
  command->add_flag("--odometry", options->odometry,
                    "Also write what the vehicle's wheels measure, with errors drawn by --seed");
  command->add_flag("--verify", options->verify,
                    "Check every frame: the truth against a rasteriser and by warping, the light "
                    "over time");
  command->option_defaults()->group("Machine");
  AddIsa(command, &options->simulation.isa);
  AddThreads(command, &options->simulation.threads, "never changes a pixel");
  command->footer(
      "If it was stopped, the same command continues where it was; frames A:C after A:B add to "
      "the\n"
      "folder; a bag is always written from the start.\n"
      "Example: ./aisle render scenes/paper/scene2.yaml --out scene2 --truth depth,dynamic");
  command->callback([=] { *action = [=] { return Render(*options); }; });
}

}  // namespace aisle
