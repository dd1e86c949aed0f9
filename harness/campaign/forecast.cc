#include "harness/campaign/forecast.h"

#include <nlohmann/json.hpp>
#include <set>

#include "harness/campaign/equal_runs.h"
#include "harness/common/counted.h"
#include "harness/io/duration.h"
#include "harness/io/system_spec_json.h"
#include "harness/plugs/steering_options.h"
#include "harness/record/record.h"
#include "harness/suite/recording.h"
#include "harness/systems/traits.h"

namespace aisle {
namespace {

// Of one core, measured with the suite `paper` on two cores, two runs at a time: a pair with its
// truth; a frame through a system, with what is drawn of it and scored, by its base and by what it
// finds itself (120 runs over four seeds).
constexpr double kPairCoreS = 0.40;
constexpr double kPlainFrameCoreS = 0.032, kOrbSlam2FrameCoreS = 0.055;
constexpr double kRobustFrameCoreS = 0.040, kPaperFrameCoreS = 0.070;
constexpr double kFrameBytes = 0.7e6;  ///< of a kept frame of 752x480

double FrameCoreS(const SystemSpec& system) {
  const SystemTraits traits = TraitsOf(system);
  const double base = traits.base == "orbslam2" ? kOrbSlam2FrameCoreS : kPlainFrameCoreS;
  if (traits.method == "robust") return base + kRobustFrameCoreS;
  if (traits.method == "paper") return base + kPaperFrameCoreS;
  return base;
}

/// The frames of scenes and recordings, each counted once.
class FrameCounts {
 public:
  explicit FrameCounts(const FramesOfRuns& ahead) : count_(ahead.count) {}
  std::int64_t Of(const RunSpec& spec) { return SourceOf(spec).frames; }
  /// Whether they are files already.
  bool AreRecorded(const RunSpec& spec) { return SourceOf(spec).recorded; }
  std::size_t scenes() const { return sources_.size(); }

 private:
  struct Source {
    std::int64_t frames = 0;
    bool recorded = false;
  };
  const Source& SourceOf(const RunSpec& spec) {
    const auto [at, is_new] = sources_.try_emplace(spec.scene_file);
    if (is_new) at->second = {count_(spec.scene_file), IsRecording(spec.scene_file)};
    return at->second;
  }

  const std::function<std::int64_t(const std::string&)>& count_;
  std::map<std::string, Source> sources_;
};

std::string WithThousands(std::int64_t number) {
  std::string digits = std::to_string(number), text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += ',';
    text += digits[i];
  }
  return text;
}

}  // namespace

Forecast ForecastOf(const std::vector<RunSpec>& specs, int cores, const FramesOfRuns& ahead) {
  FrameCounts counts(ahead);
  std::set<std::string> twins, systems;
  std::set<std::uint64_t> seeds;
  std::set<std::string> rendered;
  std::set<std::pair<std::string, std::string>> driven, taught;  // frames, system
  Forecast forecast{.runs = specs.size()};
  std::int64_t shared_pairs = 0, kept_pairs = 0;
  double drive_core_s = 0;
  for (const RunSpec& spec : specs) {
    const std::int64_t frames = counts.Of(spec);
    twins.insert(spec.twin);
    systems.insert(spec.system.name);
    seeds.insert(spec.seed);
    const std::string key = ahead.key(spec);
    const bool steered = ahead.steered(spec.scene_file);
    const auto render_once = [&](const std::string& what) {
      if (!rendered.insert(what).second) return;
      shared_pairs += frames;
      kept_pairs += std::min(ahead.kept(what), frames);
    };
    if (!steered && !counts.AreRecorded(spec)) render_once(key);
    if (IsOnlyItsInputs(spec) && !driven.insert({key, spec.system.name}).second) {
      ++forecast.answered;
      continue;
    }
    std::int64_t shown = frames;
    if (steered) forecast.pairs += frames;
    if (steered && SteeringOf(spec.system.options).taught) {
      const RunSpec led = AsLed(spec);
      const std::string led_key = ahead.key(led) + "-led";
      render_once(led_key);
      if (taught.insert({led_key, ToJson(led.system).dump()}).second) shown += frames;
    }
    forecast.system_frames += shown;
    drive_core_s += static_cast<double>(shown) * FrameCoreS(spec.system);
  }
  forecast.pairs += shared_pairs - kept_pairs;
  forecast.scenes = counts.scenes();
  forecast.twins = twins.size();
  forecast.systems = systems.size();
  forecast.seeds = seeds.size();
  const double render_core_s = static_cast<double>(forecast.pairs) * kPairCoreS;
  forecast.wall_s = (render_core_s + drive_core_s) / std::max(cores, 1);
  forecast.cache_bytes = static_cast<double>(shared_pairs) * kFrameBytes;
  return forecast;
}

ExpectedTimes ExpectTimes(const std::vector<RunSpec>& specs, const std::filesystem::path& out,
                          const FramesOfRuns& ahead) {
  FrameCounts counts(ahead);
  std::map<std::string, std::int64_t> kept;  // by key: a folder is read once for all systems
  const auto kept_of = [&](const std::string& key) {
    const auto [at, is_new] = kept.try_emplace(key);
    if (is_new) at->second = ahead.kept(key);
    return at->second;
  };
  ExpectedTimes times;
  for (const RunSpec& spec : specs) {
    ExpectedTime& time = times[RunId(spec)];
    if (const std::optional<RunRecord> last = ReadRun(spec, out)) {
      time.drive_s = last->wall_s;
      continue;
    }
    const std::int64_t frames = counts.Of(spec);
    time.drive_s = static_cast<double>(frames) * FrameCoreS(spec.system);
    if (counts.AreRecorded(spec)) continue;
    if (ahead.steered(spec.scene_file)) {
      time.drive_s += static_cast<double>(frames) * kPairCoreS;
    } else {
      const std::int64_t missing = std::max(frames - kept_of(ahead.key(spec)), std::int64_t{0});
      time.render_s = static_cast<double>(missing) * kPairCoreS;
    }
  }
  return times;
}

std::string ToText(const Forecast& f) {
  const std::string answered =
      f.answered > 0 ? fmt::format(", {} answered by another of equal inputs", f.answered) : "";
  return fmt::format(
      "{}: {}, {}, {}, {}{}; {} stereo pairs to render, {} frames to drive; about {} with every "
      "core "
      "free, {:.1f} GB of kept frames",
      Counted(f.runs, "run"), Counted(f.scenes, "scene"), Counted(f.twins, "twin"),
      Counted(f.systems, "system"), Counted(f.seeds, "seed"), answered, WithThousands(f.pairs),
      WithThousands(f.system_frames), Duration(f.wall_s), f.cache_bytes * 1e-9);
}

}  // namespace aisle
