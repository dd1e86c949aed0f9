#include "harness/suite/issues.h"

#include "harness/io/input_error.h"

namespace aisle {

void Issues::Add(Place place, const std::string& key, const std::string& what) {
  issues_.push_back({place, fmt::format("{}:{}:{}: {}{}{}", Printable(file_, 4096), place.line,
                                        place.column, key, key.empty() ? "" : ": ", what)});
}

std::string Issues::Text() const {
  std::vector<Issue> sorted = issues_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Issue& a, const Issue& b) {
    return std::pair(a.place.line, a.place.column) < std::pair(b.place.line, b.place.column);
  });
  std::string text;
  for (const Issue& issue : sorted) text += (text.empty() ? "" : "\n") + issue.text;
  return text;
}

}  // namespace aisle
