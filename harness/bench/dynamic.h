#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "harness/bench/source.h"
#include "harness/contract/estimate.h"
#include "harness/contract/system_spec.h"
#include "harness/score/continuity.h"

namespace aisle {

struct DynamicBenchOptions {
  BenchSource source;
  SystemSpec system = BuiltIn("robust");
  int warm_up = 20;           ///< frames before the view's first that are shown but not counted
  std::filesystem::path out;  ///< folder for pictures; empty: none
  int every = 10;             ///< a picture every so many frames
  bool draw_stages = false;   ///< every stage of these frames too
};

/// What a system rejected on one stretch, or on several, beside what moved.
struct DynamicOfView {
  std::string name;   ///< of the scene or recording
  std::string view;   ///< as it was asked for; of several, the first
  int stretches = 0;  ///< how many are summed here
  int frames = 0;
  bool has_truth = false;
  MaskFacts masks;                         ///< summed
  SpellsByKind spells;                     ///< of movers, over time
  double pixels = 0, rejected = 0;         ///< of all frames
  std::map<std::string, double> stage_ms;  ///< sums

  DynamicOfView& operator+=(const DynamicOfView& more);

  std::map<std::string, double> mean_ms() const;
  double rejected_share() const;  ///< of all pixels
  double static_wrong() const;    ///< share of the pixels at rest that were rejected
};

/// Adds up, frame by frame, what a system rejected beside what moves.
class DynamicMeter {
 public:
  /// `name` of the scene or recording; `view`: as it was asked for.
  DynamicMeter(std::string name, std::string view) {
    view_.name = std::move(name);
    view_.view = std::move(view);
    view_.stretches = 1;
  }
  void Add(const SequenceFrame& shown, const FrameEstimate& estimate);
  /// Of all frames so far.
  DynamicOfView View() const;

 private:
  DynamicOfView view_;
  std::vector<FrameFacts> facts_;
};

/// Throws InputError.
DynamicOfView MeasureDynamic(const BenchView& view, const DynamicBenchOptions& options,
                             const BenchProgress& progress = {});

}  // namespace aisle
