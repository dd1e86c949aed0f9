#pragma once

#include <string>

#include "harness/record/results.h"

namespace aisle {

/// A night of two systems, one of which has every mark in its name that a writing has to escape,
/// each with this absolute error.
inline Results Night(const std::string& started, double ate_m,
                     const std::string& scene = "paper/one") {
  Results results;
  results.suite = "nightly";
  results.started = started;
  results.provenance.commit = "abc";
  for (const std::string system : {"orbslam2", "ora|cle_"}) {
    RunRecord run;
    run.spec = {
        .scene = scene, .scene_file = "", .twin = "live", .system = BuiltIn(system), .seed = 1};
    for (const char* name : {"ate_rmse_m", "ate_mean_m", "ate_median_m", "ate_std_m"}) {
      run.scores[name] = {.value = ate_m, .unit = "m", .alignment = "se3", .n = 9, .absent = ""};
    }
    results.runs.push_back(run);
  }
  return results;
}

}  // namespace aisle
