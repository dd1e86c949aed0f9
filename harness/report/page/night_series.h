#pragma once

#include <string>
#include <vector>

#include "harness/record/history.h"

namespace aisle {

/// One night of a suite.
struct Night {
  std::string started, commit;
  std::string folder;      ///< of its report, from the history's folder on; empty: not known
  std::size_t failed = 0;  ///< seeds, of all systems and scenes
  double day = 0;          ///< days since the first night; its number where dates are none
};

/// One score of one cell through all nights.
struct NightSeries {
  std::string scene, twin, system, score;
  int style = 0;                          ///< of StylesOf
  std::vector<const TrendPoint*> points;  ///< one per night; null where it was not driven
};

struct NightBook {
  std::vector<Night> nights;        ///< in the order of time
  std::vector<NightSeries> series;  ///< by scene, twin, system and score
};

/// The pointers lead into `points`, which come in the order of time.
NightBook ReadNights(const std::vector<TrendPoint>& points);

/// Since some night something is other than it was, and has stayed so to the last one.
struct NightChange {
  const NightSeries* series = nullptr;
  std::size_t night = 0;  ///< the first of the new kind
  bool failing = false;   ///< seeds fail since then; else the median moved
  double before = 0, after = 0;
  bool worse = true;
};

/// Every change of the book, what fails first, then by size. Failures are told once for a cell.
std::vector<NightChange> ChangesOf(const NightBook& book);

/// How people read a score that is followed: "ATE", centimetres, …
struct FollowedScore {
  const char* score;
  const char* title;
  const char* unit;
  double factor;  ///< from the score's unit
  bool more_is_better;
};
const FollowedScore& Followed(const std::string& score);

}  // namespace aisle
