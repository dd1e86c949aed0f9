#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "simulator/scene/scene.h"

namespace aisle::sim {

/// Collects the mistakes in one file, in the order of their places.
class Issues {
 public:
  explicit Issues(std::string file) : file_(std::move(file)) {}

  void Add(Mark mark, std::string_view key, std::string_view what);
  bool empty() const { return issues_.empty(); }
  std::vector<std::string> Messages() const;

 private:
  struct Issue {
    Mark mark;
    std::string text;
  };
  std::string file_;
  std::vector<Issue> issues_;
};

/// The known word nearest to a misspelt one, "" if none is near.
std::string NearestWord(std::string_view word, const std::vector<std::string>& known);

}  // namespace aisle::sim
