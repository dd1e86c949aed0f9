#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "harness/bench/detector.h"

namespace aisle {

/// One option of a system and the values to be tried for it.
struct SearchAxis {
  std::string path;
  double low = 0, high = 0;  ///< both are tried
  bool even_ratios = false;  ///< steps of equal ratio, not of equal difference; needs low > 0
  bool integer = false;
};

/// Options of a system by path, as text.
using OptionSet = std::map<std::string, std::string>;

/// One set of options and what it made of the clips.
struct Trial {
  int index = 0;
  OptionSet options;
  DetectorOutcome outcome = {};
  double half_score = 0;  ///< over the first half of the clips
  /// Given up there: a trial that had no chance to be among the best.
  bool given_up = false;

  /// What is sought: the mean of objects' F1 and of pixels' IoU.
  double score() const { return (outcome.object_f1() + outcome.pixel_iou()) / 2; }
};

struct SearchOptions {
  std::vector<SearchAxis> axes;
  int trials = 200;  ///< the first is the system as it is
  int explore = 70;  ///< of them, drawn from the whole space
  std::uint64_t seed = 1;
  int parents = 6;  ///< the best so far, around which the others are drawn
};

/// Whether a set may be tried: rules that tie options together.
using IsAllowed = std::function<bool(const OptionSet& options)>;

/// What is to be tried next: a function of the seed, the number of the trial and the scores before
/// it, and of no clock. Options that differ from the system's own are named alone.
OptionSet NextOptions(const SearchOptions& options, const std::vector<Trial>& before,
                      const IsAllowed& allowed = {});

/// Told of each trial when it is done.
using OnTrial = std::function<void(const Trial& trial)>;

/// Tries sets of options of `system` on the clips: first over the whole space, then around the best
/// by score. Several clips at a time; times are measured so, and steer nothing: the same seed tries
/// the same sets. Throws
/// InputError for options the system does not have.
std::vector<Trial> Search(const SystemSpec& system, const std::vector<Clip>& clips,
                          const SearchOptions& options, const IsAllowed& allowed = {},
                          const OnTrial& done = {});

/// A set of options on stretches it was not chosen on.
struct JudgedSet {
  std::string name;
  OptionSet options;
  std::map<std::string, DetectorOutcome> by_scene = {};  ///< with losses
  DetectorOutcome all = {};
  double time_ratio = 0;  ///< the detector's time over that of its system's tracking without it
};

/// All but the time. `scene_of` names the group of a clip.
JudgedSet Judge(const std::string& name, const SystemSpec& system, const OptionSet& options,
                const std::vector<Clip>& clips,
                const std::function<std::string(const Clip&)>& scene_of);

/// For each set the detector's time over the tracking's, on one stretch: the median of `rounds`, in
/// each of which the system drives without rejection and then every detector sees the same frames.
/// Throws InputError.
std::vector<double> TimeRatios(const SystemSpec& system, const std::vector<OptionSet>& sets,
                               const BenchView& view, const BenchSource& source, int rounds = 3);

/// A system with these options besides its own.
SystemSpec With(const SystemSpec& system, const OptionSet& options);

/// Those of which no other has more recall of large movers without rejecting more of what is at
/// rest and without taking longer; the least static loss first. Times that differ by less than
/// `same_ms` count as the same.
std::vector<Trial> Frontier(const std::vector<Trial>& trials, double same_ms = 2);

}  // namespace aisle
