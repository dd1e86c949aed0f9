#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/bench/dynamic.h"
#include "harness/contract/system_option.h"

namespace aisle {

struct SensitivityOptions {
  BenchSource source;
  SystemSpec system = BuiltIn("robust");
  std::string prefix;  ///< only options whose path begins so
  int warm_up = 20;    ///< frames before a view's first that are shown but not counted
  int jobs = 0;        ///< variants side by side, each on one thread; 0: as many as threads
};

/// By what a rejection of movers is judged here, over all stretches together.
struct RejectionFigures {
  double object_f1 = 0;    ///< harmonic mean of the objects' precision and recall; 0 for none
  double pixel_iou = 0;    ///< of what was rejected and what moves
  double static_loss = 0;  ///< share of the pixels at rest that were rejected
};
RejectionFigures FiguresOf(const DynamicOfView& sum);

/// How far two differ, on one scale: the largest of the changes of F1, of IoU, and of the static
/// loss tenfold, since a tenth of a percent of what stands still is worth a hundredth of the
/// others.
double Distance(const RejectionFigures& a, const RejectionFigures& b);

/// What becomes of the figures when one option has another value.
struct OptionVariant {
  std::string value;
  RejectionFigures figures;
};

struct OptionSensitivity {
  SystemOption option;
  /// Absent where there is no such value: it is no number, is 0, or lies at the end of its range.
  std::optional<OptionVariant> halved, doubled;
  double effect = 0;  ///< the larger distance of the two from the system as it is
};

struct Sensitivity {
  RejectionFigures base;                   ///< of the system as it is
  std::vector<OptionSensitivity> options;  ///< the largest effect first; equal ones as listed
};

/// The value of a number or whole number times `factor` as an option of `like` with the given other
/// options may have it: not beyond its range, and where a rule forbids a whole number (an even
/// side of a window, say) the nearest one that is allowed. Nothing where that leaves the value as
/// it is.
std::optional<std::string> ScaledValue(const SystemOption& option, double factor,
                                       const SystemSpec& system);

/// Halves and doubles every option of the system, one at a time, and drives each variant over the
/// same frames, which are read once. The same result for any number of jobs. Throws InputError:
/// where frames have no truth, and where no option begins with the prefix.
Sensitivity MeasureSensitivity(const std::vector<BenchView>& views,
                               const SensitivityOptions& options,
                               const BenchProgress& progress = {});

/// A table in Markdown: a row an option with what halving and doubling it changes, beneath a row of
/// the system as it is.
std::string ToMarkdown(const Sensitivity& sensitivity);

}  // namespace aisle
