#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "simulator/scene/scene.h"

namespace aisle::sim {

/// Collects the mistakes in a scene file and those it extends, in the order of their places.
class Issues {
 public:
  explicit Issues(std::string file) : files_{std::move(file)} {}
  explicit Issues(std::vector<std::string> files) : files_(std::move(files)) {}

  /// By the index that a mark has.
  const std::vector<std::string>& files() const { return files_; }
  /// The next one that is extended.
  void AddFile(std::string file) { files_.push_back(std::move(file)); }

  void Add(Mark mark, std::string_view key, std::string_view what);
  bool empty() const { return issues_.empty(); }
  std::vector<std::string> Messages() const;

 private:
  struct Issue {
    Mark mark;
    std::string text;
  };
  std::vector<std::string> files_;
  std::vector<Issue> issues_;
};

/// The known word nearest to a misspelt one, "" if none is near.
std::string NearestWord(std::string_view word, const std::vector<std::string>& known);

}  // namespace aisle::sim
