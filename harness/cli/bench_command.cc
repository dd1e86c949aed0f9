#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "harness/cli/command.h"
#include "harness/cli/places.h"
#include "harness/io/file.h"
#include "harness/io/image.h"
#include "harness/io/input_error.h"
#include "harness/plugs/render_cost.h"
#include "harness/suite/suite.h"

namespace aisle {
namespace {

constexpr double kMaxMedian = 0.05, kMinSsim = 0.95;

struct RenderOptions {
  SimulatedSequenceOptions simulation;
  int frames = 20;
  std::string json;
};

void WriteJson(const RenderCost& cost, const RenderOptions& options) {
  nlohmann::ordered_json json = {{"scene", options.simulation.scene_name},
                                 {"seed", options.simulation.seed},
                                 {"isa", options.simulation.isa},
                                 {"frames", cost.frames},
                                 {"pair_ms", cost.pair_ms},
                                 {"bare_primary_ms", cost.bare_primary_ms},
                                 {"ratio", cost.ratio}};
  for (const auto& [stage, ms] : cost.stage_ms) json["stage_ms"][stage] = ms;
  WriteFileAtomically(options.json, json.dump(2) + "\n");
}

int BenchRender(RenderOptions options) {
  if (options.simulation.scene_file.empty()) {
    const std::filesystem::path tree = AssetsDir().parent_path();
    options.simulation.scene_file = (tree / "scenes/paper/scene3.yaml").string();
  }
  options.simulation.assets_dir = AssetsDir().string();
  options.simulation.scene_name = SceneName(options.simulation.scene_file);
  const RenderCost cost = MeasureRender(options.simulation, options.frames);

  const Provenance own = OwnProvenance();
  fmt::print("{}, isa {}, {}, median of {} frames\n", options.simulation.scene_name,
             options.simulation.isa, own.cpu, cost.frames);
  for (const auto& [stage, ms] : cost.stage_ms) {
    fmt::print("  {:<16}{:8.2f} ms{:7.2f} x\n", stage, ms, ms / cost.bare_primary_ms);
  }
  fmt::print("stereo pair with all truth   {:8.2f} ms\n", cost.pair_ms);
  fmt::print("bare primary rays            {:8.2f} ms\n", cost.bare_primary_ms);
  fmt::print("ratio                        {:8.2f}\n", cost.ratio);
  if (!options.json.empty()) WriteJson(cost, options);
  return kAllPassed;
}

void AddBenchRender(CLI::App* bench, Action* action) {
  const auto options = std::make_shared<RenderOptions>();
  CLI::App* command =
      bench->add_subcommand("render", "milliseconds a stereo pair, beside its bare primary rays");
  command->add_option("SCENE", options->simulation.scene_file,
                      "scene file (default: scenes/paper/scene3.yaml)");
  command->add_option("--frames", options->frames, "frames spread over the scene (default 20)")
      ->check(CLI::Range(2, 10000));
  command->add_option("--seed", options->simulation.seed, "of the scene; default 1");
  command->add_option("--isa", options->simulation.isa,
                      "instruction set of the tracer; avx2 (default) or native");
  command->add_option("--threads", options->simulation.threads, "0: all");
  command->add_option("--json", options->json, "write the medians there too");
  command->callback([=] { *action = [=] { return BenchRender(*options); }; });
}

struct LightOptions {
  SimulatedSequenceOptions simulation;
  std::vector<std::string> views;
  std::string out = "bench_light";
  int samples = 256;
  int reduce = 2;
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

/// "scene:frame", or a scene alone: its middle frame, -1.
std::pair<std::string, int> SceneAndFrame(const std::string& view) {
  const std::size_t colon = view.rfind(':');
  if (colon == std::string::npos) return {view, -1};
  const std::string digits = view.substr(colon + 1);
  if (digits.empty() || digits.size() > 6 ||
      digits.find_first_not_of("0123456789") != std::string::npos) {
    throw InputError(Printable(view) + ": expected SCENE:FRAME, for example paper/scene2:170");
  }
  return {view.substr(0, colon), std::stoi(digits)};
}

/// Nightly above, reference in the middle, and below how they differ: mid grey none, white and
/// black 20 % too bright and too dark.
cv::Mat1b Sheet(const LightComparison& light) {
  const auto grey = [](const cv::Mat1f& linear) {
    cv::Mat1f encoded;
    cv::pow(cv::min(linear, 1.0), 1 / 2.2, encoded);
    return encoded;
  };
  cv::Mat1f difference;
  cv::divide(light.nightly - light.reference, cv::max(light.reference, 1e-3), difference);
  cv::Mat1f sheet;
  cv::vconcat(std::vector<cv::Mat>{grey(light.nightly), grey(light.reference),
                                   0.5 + difference * (0.5 / 0.2)},
              sheet);
  cv::Mat1b bytes;
  sheet.convertTo(bytes, CV_8U, 255);
  return bytes;
}

int BenchLight(LightOptions options) {
  options.simulation.assets_dir = AssetsDir().string();
  const std::filesystem::path out = options.out;
  std::filesystem::create_directories(out);
  std::string table =
      "| view | frame | median relative error | SSIM | mean, nightly / reference "
      "| two half references: median | SSIM |\n"
      "|---|---|---|---|---|---|---|\n";
  bool good = true;
  for (const std::string& view : options.views.empty() ? kViews : options.views) {
    auto [scene, frame] = SceneAndFrame(view);
    options.simulation.scene_file = SceneFile(scene);
    options.simulation.scene_name = SceneName(options.simulation.scene_file);
    const LightComparison light =
        CompareLight(options.simulation, frame, options.samples, options.reduce);
    const std::string line = fmt::format(
        "| {} | {} | {:.2f} % | {:.4f} | {:.3f} | {:.2f} % | {:.4f} |\n",
        options.simulation.scene_name, light.frame, 100 * light.median_relative_error, light.ssim,
        light.mean_ratio, 100 * light.noise_median_relative, light.noise_ssim);
    fmt::print("{}", line);
    std::fflush(stdout);
    table += line;
    std::string name = options.simulation.scene_name;
    std::ranges::replace(name, '/', '_');
    WriteImage(out / fmt::format("{}_{}.png", name, light.frame), Sheet(light));
    good &= light.median_relative_error <= kMaxMedian && light.ssim >= kMinSsim;
  }
  WriteFileAtomically(out / "light.md", table);
  fmt::print("pictures and the table: {}\n", out.string());
  return good ? kAllPassed : kVerdictFailed;
}

void AddBenchLight(CLI::App* bench, Action* action) {
  const auto options = std::make_shared<LightOptions>();
  CLI::App* command = bench->add_subcommand(
      "light", "the nightly light beside path tracing: table and pictures; minutes a view");
  command->add_option("VIEWS", options->views,
                      "SCENE or SCENE:FRAME (default: seven views with movers)");
  command->add_option("--out", options->out, "folder of the table and pictures (bench_light)");
  command->add_option("--samples", options->samples, "paths a pixel (default 256)")
      ->check(CLI::Range(1, 65536));
  command->add_option("--reduce", options->reduce, "compare at 1/N of the camera's size (2)")
      ->check(CLI::Range(1, 16));
  command->add_option("--seed", options->simulation.seed, "of the scenes; default 1");
  command->add_option("--threads", options->simulation.threads, "0: all");
  command->footer("Exit code 1 where a view misses 5 % median relative error or 0.95 SSIM.");
  command->callback([=] { *action = [=] { return BenchLight(*options); }; });
}

}  // namespace

void AddBenchCommand(CLI::App* app, Action* action) {
  CLI::App* bench = app->add_subcommand("bench", "what things cost on this machine");
  bench->require_subcommand(1);
  bench->footer("Example: ./aisle bench render --frames 20");
  AddBenchRender(bench, action);
  AddBenchLight(bench, action);
  AddBenchSlam(bench, action);
  AddBenchAccuracy(bench, action);
  AddBenchDynamic(bench, action);
  AddBenchRealism(bench, action);
}

}  // namespace aisle
