#include "harness/bench/sensitivity.h"

#include <atomic>
#include <cmath>
#include <exception>
#include <mutex>
#include <thread>

#include "harness/bench/shown.h"
#include "harness/io/input_error.h"
#include "harness/plugs/systems.h"
#include "harness/score/mask_scores.h"

namespace aisle {
namespace {

/// The frames of a view, read once for all variants.
struct Stretch {
  BenchView view;
  std::string name;
  StereoCalibration calibration;
  std::vector<SequenceFrame> frames;
  std::size_t warm_up = 0;  ///< the first of these that do not count
};

Stretch ReadStretch(const BenchView& view, const SensitivityOptions& options,
                    const BenchProgress& progress) {
  const auto sequence = OpenSourceFor(options.system, view, options.source);
  Stretch stretch{view, sequence->name(), sequence->calibration(), {}, 0};
  const Excerpt shown(*sequence, std::max(view.from - options.warm_up, 0), view.to);
  for (const FrameRequest& request : shown.Schedule()) {
    if (progress) progress(fmt::format("{}: reading frame {}", view.text, request.id));
    stretch.warm_up += request.id < view.from ? 1 : 0;
    stretch.frames.push_back(shown.At(request));
    const auto& truth = stretch.frames.back().truth;
    if (!truth || truth->dynamic.empty()) {
      throw InputError(Printable(view.text) + ": no truth of what moves; expected a scene");
    }
  }
  RefuseEmptyView(view, stretch.frames.size() - stretch.warm_up);
  return stretch;
}

RejectionFigures Drive(const std::vector<Stretch>& stretches, const SystemSpec& system,
                       const BenchSource& source) {
  DynamicOfView sum;
  for (const Stretch& stretch : stretches) {
    const auto estimator = MakeSystem(system, stretch.calibration, {.threads = 1});
    const MaskMaker masks = MasksFor(system, stretch.view, source);
    DynamicMeter meter(stretch.name, stretch.view.text);
    for (std::size_t i = 0; i < stretch.frames.size(); ++i) {
      const FrameEstimate estimate = Show(stretch.frames[i], masks, estimator.get());
      if (i >= stretch.warm_up) meter.Add(stretch.frames[i], estimate);
    }
    sum += meter.View();
  }
  return FiguresOf(sum);
}

SystemSpec With(SystemSpec system, const std::string& path, const std::string& value) {
  system.options[path] = value;
  return system;
}

bool IsAllowed(const SystemSpec& system, const std::string& path, const std::string& value) {
  return CheckOption(path, value).empty() &&
         CheckOptions(FindSystem(system.like), With(system, path, value).options).empty();
}

/// One drive: the system as it is, or one option of it with another value.
struct Task {
  SystemSpec system;
  RejectionFigures* figures;
};

/// Each task once, in any order, several side by side. The first failure ends all.
void DriveAll(const std::vector<Stretch>& stretches, const std::vector<Task>& tasks,
              const SensitivityOptions& options, const BenchProgress& progress) {
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;  // guards `failure`, and progress
  std::exception_ptr failure;
  const auto work = [&] {
    for (std::size_t i = next++; i < tasks.size(); i = next++) {
      try {
        if (progress) {
          const std::lock_guard lock(mutex);
          progress(fmt::format("drive {} of {}", i + 1, tasks.size()));
        }
        *tasks[i].figures = Drive(stretches, tasks[i].system, options.source);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
        next = tasks.size();
      }
    }
  };
  const int all = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  std::vector<std::jthread> workers;
  for (int k = 1; k < (options.jobs > 0 ? options.jobs : all); ++k) workers.emplace_back(work);
  work();
  workers.clear();  // joined
  if (failure) std::rethrow_exception(failure);
}

/// "0.912", or the change to that.
std::string Cells(const RejectionFigures& now, const RejectionFigures& base) {
  return fmt::format("{:+.3f} / {:+.3f} / {:+.2f} %", now.object_f1 - base.object_f1,
                     now.pixel_iou - base.pixel_iou, 100 * (now.static_loss - base.static_loss));
}

std::string Cells(const std::optional<OptionVariant>& variant, const RejectionFigures& base) {
  if (!variant) return "- | -";
  return fmt::format("{} | {}", variant->value, Cells(variant->figures, base));
}

}  // namespace

RejectionFigures FiguresOf(const DynamicOfView& sum) {
  const double found = 2.0 * sum.masks.objects_found,
               all = found + sum.masks.objects_invented + sum.masks.objects_missed;
  return {.object_f1 = Ratio(found, all).value_or(0),
          .pixel_iou = PixelDetection(sum.masks).iou.value.value_or(0),
          .static_loss = sum.static_wrong()};
}

double Distance(const RejectionFigures& a, const RejectionFigures& b) {
  return std::max({std::abs(a.object_f1 - b.object_f1), std::abs(a.pixel_iou - b.pixel_iou),
                   10 * std::abs(a.static_loss - b.static_loss)});
}

std::optional<std::string> ScaledValue(const SystemOption& option, double factor,
                                       const SystemSpec& system) {
  using Kind = SystemOption::Kind;
  if (option.kind != Kind::kNumber && option.kind != Kind::kInteger) return std::nullopt;
  const double now = std::stod(option.value);
  const double scaled = std::clamp(now * factor, option.low, option.high);
  if (option.kind == Kind::kNumber) {
    const std::string text = fmt::format("{}", scaled);
    if (scaled == now || !IsAllowed(system, option.path, text)) return std::nullopt;
    return text;
  }
  // Whole numbers, from the nearest on outwards, but never back to where it was.
  const auto wanted = static_cast<std::int64_t>(std::round(scaled));
  const auto most = static_cast<std::int64_t>(std::abs(scaled - now));
  for (std::int64_t off = 0; off < std::max<std::int64_t>(most, 1); ++off) {
    for (const std::int64_t value : {wanted + off, wanted - off}) {
      const std::string text = fmt::format("{}", value);
      if (static_cast<double>(value) != now && IsAllowed(system, option.path, text)) return text;
    }
  }
  return std::nullopt;
}

Sensitivity MeasureSensitivity(const std::vector<BenchView>& views,
                               const SensitivityOptions& options, const BenchProgress& progress) {
  Sensitivity result;
  System system = Varied(FindSystem(options.system.like), options.system.options);
  system.options.erase(kOdometryOption);  // it is none of the SLAM's own
  for (SystemOption& option : OptionsOf(system)) {
    if (!option.path.starts_with(options.prefix)) continue;
    result.options.push_back({std::move(option), {}, {}, 0});
  }
  if (result.options.empty()) {
    throw InputError(fmt::format("no option of {} begins with '{}'; `aisle systems {}` lists them",
                                 options.system.like, Printable(options.prefix),
                                 options.system.like));
  }
  std::vector<Task> tasks = {{options.system, &result.base}};
  for (OptionSensitivity& one : result.options) {
    for (const auto& [factor, variant] : {std::pair(0.5, &one.halved), {2.0, &one.doubled}}) {
      const auto value = ScaledValue(one.option, factor, options.system);
      if (!value) continue;
      *variant = {*value, {}};
      tasks.push_back({With(options.system, one.option.path, *value), &(*variant)->figures});
    }
  }
  std::vector<Stretch> stretches;
  for (const BenchView& view : views) stretches.push_back(ReadStretch(view, options, progress));
  DriveAll(stretches, tasks, options, progress);
  for (OptionSensitivity& one : result.options) {
    for (const auto* variant : {&one.halved, &one.doubled}) {
      if (*variant) one.effect = std::max(one.effect, Distance((*variant)->figures, result.base));
    }
  }
  std::ranges::stable_sort(result.options, std::greater(), &OptionSensitivity::effect);
  return result;
}

std::string ToMarkdown(const Sensitivity& sensitivity) {
  const RejectionFigures& base = sensitivity.base;
  std::string table = fmt::format(
      "As it is: objects' F1 {:.3f}, pixels' IoU {:.3f}, static pixels lost {:.2f} %. Each column "
      "of "
      "changes: F1 / IoU / static loss.\n\n"
      "| option | is | halved | changes | doubled | changes | effect |\n"
      "|---|---|---|---|---|---|---|\n",
      base.object_f1, base.pixel_iou, 100 * base.static_loss);
  for (const OptionSensitivity& one : sensitivity.options) {
    table += fmt::format("| `{}` | {} | {} | {} | {:.3f} |\n", one.option.path, one.option.value,
                         Cells(one.halved, base), Cells(one.doubled, base), one.effect);
  }
  return table;
}

}  // namespace aisle
