#pragma once

#include <string>
#include <vector>

#include "harness/suite/suite.h"

namespace aisle {

/// What a report folder is meant to hold. plan.json is written before the first run, so that a
/// folder explains itself: `merge` and `rerun` read it and need no suite file.
struct PlanFile {
  std::vector<Suite> suites;  ///< one report answers them all
  std::string command;        ///< the command line that made it
  std::string suite_file;     ///< the first of the files it names; empty in plans of before
  bool gate = false;          ///< it is held against baseline.json beside it, once it is whole
  bool trial = false;         ///< other systems, options or seeds than the suite's: no night of it

  std::string name() const;      ///< of the suites, joined by "+"
  std::string question() const;  ///< of the suites, one after the other; bare scenes ask once
};

std::string ToJson(const PlanFile& plan);
/// Throws InputError when the text is no plan of a known schema.
PlanFile PlanFromJson(const std::string& text, const std::string& file);

/// One of `count` parts of a plan. Parts are disjoint and together the whole.
struct Shard {
  std::size_t index = 1;  ///< from 1
  std::size_t count = 1;
};

/// "2/3"; throws InputError naming the rule for anything else.
Shard ShardFromText(const std::string& text);

/// The runs of one part. Runs that share their frames stay together: no frame is rendered twice.
std::vector<RunSpec> TakeShard(const std::vector<RunSpec>& specs, const Shard& shard);

}  // namespace aisle
