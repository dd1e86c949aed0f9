#pragma once

#include <cstddef>
#include <string>

namespace aisle {

// How a run tells who waits for it how far it is: by lines of its own on stdout, "@progress DONE
// TOTAL" and "@stage WHAT". Commands of others may print the former.

/// What was told last.
struct Progress {
  int done = 0, total = 0;  ///< frames; 0 of 0 before the first
  std::string stage;
};

/// Takes a line "@progress DONE TOTAL", kept within 0 and TOTAL whatever it says; false where it is
/// none. Lines of others are taken so.
bool TakeFrameCount(const std::string& line, Progress* progress);

/// Takes either line; false where it is none.
bool TakeProgress(const std::string& line, Progress* progress);

void TellProgress(std::size_t done, std::size_t total);
void TellStage(const std::string& what);

}  // namespace aisle
