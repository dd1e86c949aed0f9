#pragma once

#include <string>
#include <vector>

namespace aisle {

/// A place in a file, counted from 1.
struct Place {
  int line = 1, column = 1;
};

/// The mistakes of one file: all of them, not the first alone.
class Issues {
 public:
  explicit Issues(std::string file) : file_(std::move(file)) {}

  /// `key` is the dotted path of what is wrong, empty for the whole.
  void Add(Place place, const std::string& key, const std::string& what);
  bool empty() const { return issues_.empty(); }
  /// "file:line:column: key: what", a line each, in the order of their places.
  std::string Text() const;

 private:
  struct Issue {
    Place place;
    std::string text;
  };
  std::string file_;
  std::vector<Issue> issues_;
};

}  // namespace aisle
