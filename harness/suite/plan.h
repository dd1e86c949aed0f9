#pragma once

#include <functional>
#include <map>
#include <optional>
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
  std::string started = {};   ///< when its night began, UTC; empty in plans of before
  /// What its folder is to hold: the inputs' hash of each of its own runs (of a part: no others'),
  /// by RunId. Whatever else lies there is an earlier night's. Empty in plans of before.
  std::map<std::string, std::string> inputs = {};
  /// Of what the scenes of the whole night held when it was planned, by their names: a hash of
  /// each. Not of recordings, whose files have other times on every host. Empty in plans of before.
  std::map<std::string, std::string> scenes = {};

  std::string name() const;      ///< of the suites, joined by "+"
  std::string question() const;  ///< of the suites, one after the other; bare scenes ask once
};

std::string ToJson(const PlanFile& plan);
/// Throws InputError when the text is no plan of a known schema.
PlanFile PlanFromJson(const std::string& text, const std::string& file);

/// Whether two folders are planned for one question: all but when they began, which runs they were
/// to make and what the scenes held.
bool SameQuestion(const PlanFile& a, const PlanFile& b);

/// The first scene that held something else when the one was planned than when the other was.
std::optional<std::string> ChangedScene(const PlanFile& a, const PlanFile& b);

/// `plan` as that of a night that goes on in the folder of `before`: it began when that one did,
/// and what that one was to hold is kept. As it is where it begins another night: some run of both
/// has other inputs now, by `inputs_of`, or there is none of both.
PlanFile Resumed(const PlanFile& plan, const PlanFile& before,
                 const std::function<std::string(const RunSpec&)>& inputs_of);

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
