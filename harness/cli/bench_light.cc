#include "harness/bench/light.h"
#include "harness/cli/bench_foreign.h"
#include "harness/cli/command.h"
#include "harness/cli/common_options.h"
#include "harness/cli/early_checks.h"
#include "harness/cli/page_block.h"
#include "harness/io/file.h"
#include "harness/io/image.h"
#include "harness/io/input_error.h"
#include "harness/io/places.h"
#include "harness/suite/suite.h"

namespace aisle {
namespace {

struct LightOptions {
  SimulatedSequenceOptions simulation;
  std::vector<std::string> views;
  std::string out = "bench_light";
  PageBlock into{"views"};
  LightComparisonOptions comparison;
  ForeignOptions foreign;
};

/// Quiet views, busy ones, and each kind of light: "scene:frame".
const std::vector<std::string> kViews = {
    "paper/scene1:90",
    "paper/scene2:170",
    "paper/scene3:110",
    "weakness/bump:120",
    "weakness/forklift_pallet:150",
    "weakness/glossy_floor:130",
    "weakness/fill_60:100",
};

struct LightView {
  std::string file;
  int frame = -1;  ///< -1: the middle one
};

/// "scene:frame", or a scene alone.
LightView ParseLightView(const std::string& view) {
  const std::size_t colon = view.rfind(':');
  if (colon == std::string::npos) return {SceneFile(view)};
  const std::string digits = view.substr(colon + 1);
  if (digits.empty() || digits.size() > 6 ||
      digits.find_first_not_of("0123456789") != std::string::npos) {
    throw InputError(Printable(view) + ": expected SCENE:FRAME, for example paper/scene2:170");
  }
  return {SceneFile(view.substr(0, colon)), std::stoi(digits)};
}

/// All of them, before the first is traced. Throws InputError.
std::vector<LightView> ViewsOf(const LightOptions& options) {
  const std::vector<std::string>& texts = options.views.empty() ? kViews : options.views;
  std::vector<LightView> views;
  std::vector<std::string> files;
  for (const std::string& text : texts) {
    views.push_back(ParseLightView(text));
    files.push_back(views.back().file);
  }
  CheckSceneFiles(files);
  for (const LightView& view : views) {
    const std::int64_t frames = CountSceneFrames(view.file);
    if (view.frame < frames) continue;
    throw InputError(view.file, 0,
                     fmt::format("has frames 0 to {}, not {}", frames - 1, view.frame));
  }
  return views;
}

std::string ChangeHeading() {
  return "| view | frames | where | pixels | rms of the change, nightly | reference | rms between "
         "| "
         "of it noise | correlation |\n|---|---|---|---|---|---|---|---|---|\n";
}

std::string ChangeLine(const std::string& scene, int frame, const char* where,
                       const LightComparison::Change& change) {
  return fmt::format("| {} | {}-{} | {} | {} | {:.5f} | {:.5f} | {:.5f} | {:.5f} | {:.4f} |\n",
                     scene, frame, frame + 1, where, change.pixels, change.rms_nightly,
                     change.rms_reference, change.rms_between, change.rms_noise,
                     change.correlation);
}

int BenchLight(LightOptions options) {
  options.simulation.assets_dir = AssetsDir().string();
  const std::filesystem::path out = options.out;
  std::filesystem::create_directories(out);
  options.into.Check();
  const std::vector<LightView> views = ViewsOf(options);
  std::string table =
      "| view | frame | median relative error | SSIM | mean, nightly / reference "
      "| two half references: median | SSIM |\n"
      "|---|---|---|---|---|---|---|\n";
  std::string changes;
  bool good = true;
  for (const LightView& view : views) {
    options.simulation.scene_file = view.file;
    options.simulation.scene_name = SceneName(options.simulation.scene_file);
    options.comparison.frame = view.frame;
    const LightComparison light = CompareLight(options.simulation, options.comparison);
    const std::string line = fmt::format(
        "| {} | {} | {:.2f} % | {:.4f} | {:.3f} | {:.2f} % | {:.4f} |\n",
        options.simulation.scene_name, light.frame, 100 * light.median_relative_error, light.ssim,
        light.mean_ratio, 100 * light.noise_median_relative, light.noise_ssim);
    fmt::print("{}", line);
    table += line;
    for (const auto& [where, change] :
         {std::pair("everywhere", light.everywhere), std::pair("on movers", light.on_movers)}) {
      if (!change) continue;
      const std::string text =
          ChangeLine(options.simulation.scene_name, light.frame, where, *change);
      fmt::print("{}", text);
      changes += text;
    }
    std::fflush(stdout);
    std::string name = options.simulation.scene_name;
    std::ranges::replace(name, '/', '_');
    WriteImage(out / fmt::format("{}_{}.png", name, light.frame), LightSheet(light));
    good &= Keeps(light);
  }
  if (!changes.empty()) table += "\n" + ChangeHeading() + changes;
  WriteFileAtomically(out / "light.md", table);
  options.into.Write(table);
  fmt::print("pictures and the table: {}\n", out.string());
  return good ? kAllPassed : kVerdictFailed;
}

}  // namespace

void AddBenchLight(CLI::App* bench, Action* action) {
  const auto options = std::make_shared<LightOptions>();
  CLI::App* command = bench->add_subcommand(
      "light",
      "Compare the renderer's light with path tracing: a table and pictures, minutes per view");
  command->add_option("VIEWS", options->views,
                      "SCENE or SCENE:FRAME; default: seven views with moving objects");
  command->add_option("--out", options->out,
                      "Folder for the table and the pictures; default: bench_light");
  CLI::Option* into = options->into.AddTo(command);
  command->add_option("--samples", options->comparison.samples, "Paths per pixel; default: 256")
      ->check(CLI::Range(1, 65536));
  CLI::Option* reduce = command
                            ->add_option("--reduce", options->comparison.reduce,
                                         "Compare at 1/N of the camera's resolution; default: 2")
                            ->check(CLI::Range(1, 16));
  CLI::Option* next =
      command->add_flag("--next", options->comparison.next,
                        "Also compare the change from each frame to the next, in shares of white");
  CLI::Option* seed = AddSeed(command, &options->simulation.seed);
  AddThreads(command, &options->simulation.threads, "never changes a pixel");
  command->option_defaults()->group("Scenes of another renderer");
  CLI::Option* foreign = command
                             ->add_option("--foreign", options->foreign.scene,
                                          "Path-trace this JSON scene of another renderer instead")
                             ->excludes("VIEWS")
                             ->excludes(into)
                             ->excludes(reduce)
                             ->excludes(next)
                             ->excludes(seed);
  command
      ->add_option("--reference", options->foreign.reference,
                   "Image that renderer made of it, .exr or .pfm, to compare with")
      ->needs(foreign);
  command
      ->add_option("--depth", options->foreign.depth,
                   "Most surfaces that a path touches; default: 8")
      ->check(CLI::Range(1, 1000))
      ->needs(foreign);
  command->footer(
      "Exit code 1 if a view misses 5 % median relative error or an SSIM of 0.95, or a scene of "
      "another\nrenderer its bounds.\n"
      "Example: ./aisle bench light paper/scene2:90 --samples 64 --reduce 4 --out out/light");
  command->callback([=] {
    *action = [=] {
      if (options->foreign.scene.empty()) return BenchLight(*options);
      ForeignOptions chosen = options->foreign;
      chosen.out = options->out;
      chosen.samples = options->comparison.samples;
      chosen.threads = options->simulation.threads;
      return BenchForeign(chosen);
    };
  });
}

}  // namespace aisle
