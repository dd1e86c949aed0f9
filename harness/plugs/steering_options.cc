#include "harness/plugs/steering_options.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <sstream>

#include "harness/contract/twin.h"
#include "harness/io/input_error.h"
#include "harness/io/nearest_word.h"

namespace aisle {
namespace {

using Kind = SystemOption::Kind;
constexpr std::string_view kPrefix = "drive.";

std::string Joined(const std::vector<double>& values) {
  return fmt::format("{}", fmt::join(values, ","));
}

std::optional<double> NumberOf(const std::string& text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, value);
  if (read.ec != std::errc() || read.ptr != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// "62,65,120" as numbers; nothing where one is none.
std::optional<std::vector<double>> Times(const std::string& text) {
  std::vector<double> times;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    const std::optional<double> ms = NumberOf(word);
    if (!ms || !(*ms >= 0 && *ms <= kLongestLatency_ms)) return std::nullopt;
    times.push_back(*ms);
  }
  return times;
}

bool TrueWord(const std::string& value, bool* flag) {
  *flag = value == "true";
  return *flag || value == "false";
}

/// The choice of that word; nothing where there is none.
template <class Choice>
std::optional<Choice> ChoiceOf(const std::string& word, const auto& words) {
  const auto at = std::ranges::find(words, word);
  if (at == words.end()) return std::nullopt;
  return static_cast<Choice>(at - words.begin());
}

std::string WordOf(auto choice, const auto& words) {
  return words.at(static_cast<std::size_t>(choice));
}

constexpr const char* kAsTheScene = "scene";

bool SetDriver(const std::string& value, Steering* steering) {
  steering->driver = ChoiceOf<SteeringLaw>(value, kSteeringLawWords);
  return steering->driver || value == kAsTheScene;
}

bool SetQueue(const std::string& value, Steering* steering) {
  const auto rule = ChoiceOf<QueueRule>(value, kQueueRuleWords);
  steering->queue = rule.value_or(steering->queue);
  return rule.has_value();
}

/// Takes one option; false where it cannot have that value.
bool Set(const std::string& path, const std::string& value, Steering* steering) {
  if (path == "drive.latency_ms") {
    const std::optional<double> ms = NumberOf(value);
    if (!ms || !(*ms >= 0 && *ms <= kLongestLatency_ms)) return false;
    steering->latency_ms = *ms;
    return true;
  }
  if (path == "drive.latency_profile_ms") {
    const auto times = Times(value);
    if (times) steering->latency_profile_ms = *times;
    return times.has_value();
  }
  if (path == "drive.scanner") return TrueWord(value, &steering->scanner);
  if (path == "drive.steered_by_truth") return TrueWord(value, &steering->steered_by_truth);
  if (path == "drive.taught") return TrueWord(value, &steering->taught);
  if (path == "drive.queue") return SetQueue(value, steering);
  return SetDriver(value, steering);
}

}  // namespace

bool IsSteeringOption(const std::string& path) { return path.starts_with(kPrefix); }

std::vector<SystemOption> DescribeSteering(const Steering& steering) {
  const auto flag = [](bool value) { return std::string(value ? "true" : "false"); };
  std::vector<std::string> drivers = {kAsTheScene};
  drivers.insert(drivers.end(), kSteeringLawWords.begin(), kSteeringLawWords.end());
  return {{"drive.latency_ms",
           Kind::kNumber,
           fmt::format("{}", steering.latency_ms),
           "ms",
           "Delay from a frame to the system's answer; a frame that waited is that much older.",
           0,
           kLongestLatency_ms,
           {}},
          {"drive.latency_profile_ms",
           Kind::kText,
           Joined(steering.latency_profile_ms),
           "ms",
           "Measured delays instead, separated by commas, one of which is drawn for each frame.",
           0,
           0,
           {}},
          {"drive.queue",
           Kind::kChoice,
           WordOf(steering.queue, kQueueRuleWords),
           "",
           "How frames that arrive while the system works are treated: the newest waits, they are "
           "dropped, or all are taken.",
           0,
           0,
           {kQueueRuleWords.begin(), kQueueRuleWords.end()}},
          {"drive.scanner",
           Kind::kFlag,
           flag(steering.scanner),
           "",
           "A safety scanner stops the vehicle before obstacles.",
           0,
           0,
           {}},
          {"drive.steered_by_truth",
           Kind::kFlag,
           flag(steering.steered_by_truth),
           "",
           "The system is shown the drive but does not steer it.",
           0,
           0,
           {}},
          {"drive.taught",
           Kind::kFlag,
           flag(steering.taught),
           "",
           "The vehicle is led along its path first, without actors, and then drives with the map "
           "of that.",
           0,
           0,
           {}},
          {"drive.driver", Kind::kChoice,
           steering.driver ? WordOf(*steering.driver, kSteeringLawWords) : kAsTheScene, "",
           "Control law that follows the path, or the scene's own.", 0, 0, drivers}};
}

std::string CheckSteeringOption(const std::string& path, const std::string& value) {
  std::vector<std::string> known;
  for (const SystemOption& option : DescribeSteering({})) {
    known.push_back(option.path);
    if (option.path != path) continue;
    Steering steering;
    if (Set(path, value, &steering)) return "";
    const std::string expected =
        option.kind == Kind::kChoice ? fmt::format("one of {}", fmt::join(option.choices, ", "))
        : option.kind == Kind::kFlag ? "true or false"
        : option.kind == Kind::kText
            ? fmt::format("numbers in [0, {:g}] separated by commas, such as 62,65,120",
                          kLongestLatency_ms)
            : fmt::format("a number in [0, {:g}]", kLongestLatency_ms);
    return fmt::format("option '{}' cannot be '{}': expected {}", path, Printable(value), expected);
  }
  return fmt::format("unknown option '{}'{}", Printable(path), DidYouMean(path, known));
}

Steering SteeringOf(const OptionTexts& options) {
  Steering steering;
  for (const auto& [path, value] : options) {
    if (!IsSteeringOption(path)) continue;
    const std::string wrong = CheckSteeringOption(path, value);
    if (!wrong.empty()) throw InputError(wrong);
    Set(path, value, &steering);
  }
  return steering;
}

OptionTexts WithoutSteering(const OptionTexts& options) {
  OptionTexts others = options;
  std::erase_if(others, [](const auto& option) { return IsSteeringOption(option.first); });
  return others;
}

RunSpec AsLed(RunSpec spec) {
  spec.twin = twin::kEmpty;
  spec.system.name.clear();
  spec.system.options = WithoutSteering(spec.system.options);
  return spec;
}

}  // namespace aisle
