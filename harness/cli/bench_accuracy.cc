#include <nlohmann/json.hpp>

#include "harness/cli/bench_source.h"
#include "harness/cli/command.h"
#include "harness/cli/terminal.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/plugs/systems.h"
#include "harness/run/drive.h"
#include "harness/score/scorecard.h"
#include "harness/score/statistics.h"

namespace aisle {
namespace {

struct Options {
  std::vector<std::string> views;
  BenchSource source{.twin = "empty"};
  std::string system = "orbslam2", json;
  int starts = 9, step = 1;
};

/// Some frames of another sequence.
class Stretch : public Sequence {
 public:
  Stretch(const Sequence& whole, int from, int to) : whole_(whole), from_(from), to_(to) {}

  std::string name() const override { return whole_.name(); }
  StereoCalibration calibration() const override { return whole_.calibration(); }
  double rate_hz() const override { return whole_.rate_hz(); }
  std::vector<FrameRequest> Schedule() const override {
    const std::vector<FrameRequest> all = whole_.Schedule();
    const auto clamp = [&](int i) { return std::min<std::ptrdiff_t>(i, std::ssize(all)); };
    return {all.begin() + clamp(from_), all.begin() + clamp(to_)};
  }
  SequenceFrame At(const FrameRequest& request) const override { return whole_.At(request); }

 private:
  const Sequence& whole_;
  int from_, to_;
};

/// What became of one view: a value per start.
struct Outcome {
  std::string name;
  std::size_t frames = 0;
  std::vector<double> live_m, final_m, lost;

  void Add(const RunResult& run) {
    const Scorecard scores = ScoreRun(run).scores;
    const auto add = [&](const char* score, std::vector<double>* values) {
      const auto found = scores.find(score);
      if (found != scores.end() && found->second.value) {
        values->push_back(*found->second.value);
      }
    };
    add("ate_live_rmse_m", &live_m);
    add("ate_rmse_m", &final_m);
    frames = std::max(frames, run.facts.size());
    lost.push_back(static_cast<double>(run.facts.size()) -
                   static_cast<double>(run.trajectory.live.size()));
  }
};

/// Throws InputError where the last start would show no frame before `end`.
void CheckStarts(const std::string& text, std::int64_t from, std::int64_t end,
                 const Options& options) {
  const std::int64_t last = from + std::int64_t{options.starts - 1} * options.step;
  if (last < end) return;
  throw InputError(
      fmt::format("{}: its last start would be frame {}, and it ends before frame {}: fewer "
                  "--starts or a smaller --step",
                  Printable(text), last, end));
}

Outcome Measure(const std::string& text, const Options& options) {
  const BenchView view = ParseView(text);
  const auto whole = OpenSource(view.source, options.source);
  CheckStarts(text, view.from, std::ssize(whole->Schedule()), options);
  Outcome outcome;
  outcome.name = text;
  ProgressLine line;
  for (int start = 0; start < options.starts; ++start) {
    const Stretch stretch(*whole, view.from + start * options.step, view.to);
    const auto estimator =
        FindSystem(options.system).make(whole->calibration(), {.threads = options.source.threads});
    outcome.Add(Drive(stretch, *estimator, MasksFromTruth(FindSystem(options.system).mask_source),
                      {}, [&](const DrivenFrame& frame) {
                        line.Show(fmt::format("{}: start {} of {}, frame {} of {}", text, start + 1,
                                              options.starts, frame.index + 1, frame.count));
                      }));
  }
  return outcome;
}

std::string Cell(const std::vector<double>& values, double unit) {
  if (values.empty()) return fmt::format("{:>24}", "-");
  const Statistics over = Summarize(values);
  return fmt::format("{:>24}", fmt::format("{:.2f} ({:.2f} to {:.2f})", over.median / unit,
                                           over.min / unit, over.max / unit));
}

int BenchAccuracy(const Options& options) {
  for (const std::string& text : options.views) {  // all, before the first drives
    const BenchView view = ParseView(text);
    CheckStarts(text, view.from, view.to, options);
  }
  fmt::print("{}, {} starts, {} frames apart: median (least to most)\n", options.system,
             options.starts, options.step);
  fmt::print("{:28}{:>7}{:>24}{:>24}{:>24}\n", "view", "frames", "live ATE cm", "final ATE cm",
             "frames lost");
  nlohmann::json rows = nlohmann::json::array();
  for (const std::string& view : options.views) {
    const Outcome outcome = Measure(view, options);
    fmt::print("{:28}{:7}{}{}{}\n", Abridged(view, 27), outcome.frames, Cell(outcome.live_m, 0.01),
               Cell(outcome.final_m, 0.01), Cell(outcome.lost, 1));
    std::fflush(stdout);
    rows.push_back({{"view", view},
                    {"frames", outcome.frames},
                    {"ate_live_rmse_m", outcome.live_m},
                    {"ate_rmse_m", outcome.final_m},
                    {"frames_lost", outcome.lost}});
  }
  if (!options.json.empty()) WriteFileAtomically(options.json, rows.dump(2) + "\n");
  return kAllPassed;
}

}  // namespace

void AddBenchAccuracy(CLI::App* bench, Action* action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = bench->add_subcommand(
      "accuracy",
      "trajectory error on the same pictures from several first frames: what of a difference "
      "between two versions is luck");
  command
      ->add_option("VIEWS", options->views,
                   "scene or folder of a recording, :FROM-TO for some frames")
      ->required();
  AddSourceOptions(command, &options->source);
  command->add_option("--system", options->system, "default orbslam2");
  command->add_option("--starts", options->starts, "drives per view; default 9")
      ->check(CLI::Range(1, 1000));
  command->add_option("--step", options->step, "frames from one start to the next; default 1")
      ->check(CLI::Range(1, 1000));
  command->add_option("--json", options->json, "write every value there too");
  command->footer(
      "Example: ./aisle bench accuracy paper/scene2 weakness/plain_coat --frames-dir frames");
  command->callback([=] { *action = [=] { return BenchAccuracy(*options); }; });
}

}  // namespace aisle
