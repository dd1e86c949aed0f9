#include "harness/bench/search.h"

#include <future>
#include <thread>

#include "harness/bench/dynamic.h"
#include "harness/common/mix.h"
#include "harness/score/front_end.h"

namespace aisle {
namespace {

constexpr int kMostDraws = 1000;  // for one set that keeps the rules

/// Random numbers from their place alone: trial, draw, and how many were drawn before.
class Draws {
 public:
  Draws(std::uint64_t seed, int trial, int draw)
      : key_(Mix(Mix(Mix(seed) ^ static_cast<std::uint64_t>(trial)) +
                 kGolden * static_cast<std::uint64_t>(draw + 1))) {}

  /// Uniform in [0, 1).
  double Uniform() { return static_cast<double>(Mix(key_ + kGolden * ++count_) >> 11) * 0x1p-53; }
  /// Of mean 0 and standard deviation 1, within 3.5: the sum of twelve uniform ones less six.
  double Normal() {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += Uniform();
    return std::clamp(sum, -3.5, 3.5);
  }

 private:
  std::uint64_t key_;
  std::uint64_t count_ = 0;
};

/// The value at a place in [0, 1] of an axis, in few digits: people read it.
std::string ValueAt(const SearchAxis& axis, double place) {
  const double value = axis.even_ratios ? axis.low * std::pow(axis.high / axis.low, place)
                                        : axis.low + (axis.high - axis.low) * place;
  return axis.integer ? fmt::format("{}", std::lround(value)) : fmt::format("{:.3g}", value);
}

double PlaceOf(const SearchAxis& axis, double value) {
  const double place = axis.even_ratios ? std::log(std::max(value, axis.low) / axis.low) /
                                              std::log(axis.high / axis.low)
                                        : (value - axis.low) / (axis.high - axis.low);
  return std::clamp(place, 0.0, 1.0);
}

/// Back into [0, 1] by mirrors at its ends.
double Mirrored(double place) {
  place = std::abs(std::fmod(place, 2.0));
  return place > 1 ? 2 - place : place;
}

OptionSet Anywhere(const std::vector<SearchAxis>& axes, Draws draws) {
  OptionSet set;
  for (const SearchAxis& axis : axes) set[axis.path] = ValueAt(axis, draws.Uniform());
  return set;
}

/// A set near another: some of its options moved. One the other does not name is drawn anew.
OptionSet Near(const OptionSet& parent, const std::vector<SearchAxis>& axes, double reach,
               Draws draws) {
  OptionSet set;
  const auto always = static_cast<std::size_t>(draws.Uniform() * static_cast<double>(axes.size()));
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const SearchAxis& axis = axes[i];
    const double moves = draws.Uniform(), step = draws.Normal(), fresh = draws.Uniform();
    const auto own = parent.find(axis.path);
    if (own == parent.end()) {
      if (i == always || moves < 0.3) set[axis.path] = ValueAt(axis, fresh);
    } else if (i == always || moves < 0.3) {
      const double place = PlaceOf(axis, std::stod(own->second));
      set[axis.path] = ValueAt(axis, Mirrored(place + reach * step));
    } else {
      set[axis.path] = own->second;
    }
  }
  return set;
}

/// The best by score, of equals the earlier.
std::vector<Trial> Best(std::vector<Trial> trials, int count) {
  std::erase_if(trials, [](const Trial& trial) { return trial.given_up; });
  std::stable_sort(trials.begin(), trials.end(),
                   [](const Trial& a, const Trial& b) { return a.score() > b.score(); });
  if (static_cast<int>(trials.size()) > count) trials.resize(static_cast<std::size_t>(count));
  return trials;
}

OptionSet Draw(const SearchOptions& options, const std::vector<Trial>& best, int index, int draw) {
  Draws draws(options.seed, index, draw);
  if (index < options.explore || best.empty()) return Anywhere(options.axes, draws);
  const double pick = draws.Uniform();
  const auto parent = static_cast<std::size_t>(pick * static_cast<double>(best.size()));
  const double done =
      static_cast<double>(index - options.explore) / std::max(1, options.trials - options.explore);
  return Near(best[parent].options, options.axes, 0.25 - 0.17 * done, draws);
}

/// Sums over some of the clips, as many at a time as there are threads: a detector alone leaves
/// most of them idle.
DetectorOutcome Measure(const SystemSpec& system, const std::vector<Clip>& clips, std::size_t from,
                        std::size_t to) {
  std::vector<std::future<DetectorOutcome>> parts(to - from);
  const std::size_t at_once = std::max(1u, std::thread::hardware_concurrency());
  DetectorOutcome sum;
  for (std::size_t i = from, summed = from; summed < to; ++i) {
    if (i < to) {
      parts[i - from] =
          std::async(std::launch::async, [&, i] { return MeasureDetector(clips[i], system); });
    }
    if (i + 1 >= from + at_once || i >= to) sum += parts[summed++ - from].get();
  }
  return sum;
}

/// Whether twice as many as may become parents were better over the first half.
bool HasNoChance(double half_score, const std::vector<Trial>& trials, int parents) {
  return std::count_if(trials.begin(), trials.end(), [&](const Trial& trial) {
           return !trial.given_up && trial.half_score > half_score;
         }) >= 2 * parents;
}

bool Beats(const Trial& a, const Trial& b, double same_ms) {
  const auto recall = [](const Trial& t) {
    return static_cast<double>(t.outcome.large.counted) / std::max(1, t.outcome.large.asked);
  };
  const bool no_worse = recall(a) >= recall(b) &&
                        a.outcome.static_wrong() <= b.outcome.static_wrong() &&
                        a.outcome.mean_ms() <= b.outcome.mean_ms() + same_ms;
  return no_worse && (recall(a) > recall(b) || a.outcome.static_wrong() < b.outcome.static_wrong());
}

}  // namespace

OptionSet NextOptions(const SearchOptions& options, const std::vector<Trial>& before,
                      const IsAllowed& allowed) {
  const int index = static_cast<int>(before.size());
  if (index == 0) return {};
  const std::vector<Trial> best = Best(before, options.parents);
  OptionSet set;
  for (int draw = 0; draw < kMostDraws; ++draw) {
    set = Draw(options, best, index, draw);
    if (!allowed || allowed(set)) break;
  }
  return set;
}

std::vector<Trial> Search(const SystemSpec& system, const std::vector<Clip>& clips,
                          const SearchOptions& options, const IsAllowed& allowed,
                          const OnTrial& done) {
  const std::size_t half = (clips.size() + 1) / 2;
  std::vector<Trial> trials;
  while (static_cast<int>(trials.size()) < options.trials) {
    Trial trial{.index = static_cast<int>(trials.size()),
                .options = NextOptions(options, trials, allowed)};
    const SystemSpec spec = With(system, trial.options);
    trial.outcome = Measure(spec, clips, 0, half);
    trial.half_score = trial.score();
    trial.given_up = HasNoChance(trial.half_score, trials, options.parents);
    if (!trial.given_up) trial.outcome += Measure(spec, clips, half, clips.size());
    trials.push_back(std::move(trial));
    if (done) done(trials.back());
  }
  return trials;
}

SystemSpec With(const SystemSpec& system, const OptionSet& options) {
  SystemSpec spec = system;
  for (const auto& [path, value] : options) spec.options[path] = value;
  return spec;
}

JudgedSet Judge(const std::string& name, const SystemSpec& system, const OptionSet& options,
                const std::vector<Clip>& clips,
                const std::function<std::string(const Clip&)>& scene_of) {
  JudgedSet judged{.name = name, .options = options};
  const SystemSpec spec = With(system, options);
  for (const Clip& clip : clips) {
    judged.by_scene[scene_of(clip)] += MeasureDetector(clip, spec, true);
  }
  for (const auto& [scene, outcome] : judged.by_scene) judged.all += outcome;
  return judged;
}

std::vector<double> TimeRatios(const SystemSpec& system, const std::vector<OptionSet>& sets,
                               const BenchView& view, const BenchSource& source, int rounds) {
  const Clip clip = LoadClip(view, source);
  const SystemSpec tracker = With(system, {{"dynamic.method", "none"}});
  DynamicBenchOptions drive;
  drive.source = source;
  drive.system = tracker;
  std::vector<std::vector<double>> ratios(sets.size());
  for (int round = 0; round < rounds; ++round) {
    const DynamicOfView driven = MeasureDynamic(view, drive);
    const auto front_end = FrontEndOf(driven.mean_ms());
    const double tracking_ms = front_end ? front_end->tracking : 0;
    for (std::size_t i = 0; i < sets.size(); ++i) {
      const double ms = MeasureDetector(clip, With(system, sets[i])).mean_ms();
      ratios[i].push_back(ms / std::max(tracking_ms, 1e-3));
    }
  }
  std::vector<double> medians;
  for (std::vector<double>& of_set : ratios) {
    std::sort(of_set.begin(), of_set.end());
    medians.push_back(of_set[of_set.size() / 2]);
  }
  return medians;
}

std::vector<Trial> Frontier(const std::vector<Trial>& trials, double same_ms) {
  std::vector<Trial> frontier;
  for (const Trial& trial : trials) {
    const bool beaten =
        trial.given_up || std::any_of(trials.begin(), trials.end(), [&](const Trial& other) {
          return !other.given_up && Beats(other, trial, same_ms);
        });
    if (!beaten) frontier.push_back(trial);
  }
  std::stable_sort(frontier.begin(), frontier.end(), [](const Trial& a, const Trial& b) {
    return a.outcome.static_wrong() < b.outcome.static_wrong();
  });
  return frontier;
}

}  // namespace aisle
