#pragma once

#include <string>

namespace aisle {

/// stdout is a terminal and NO_COLOR is not set.
bool StdoutHasColor();

/// One line of progress that rewrites itself on a terminal and is silent elsewhere.
class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine() { Clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void Show(const std::string& text);
  /// Takes the line away, so that something lasting can be printed.
  void Clear();

 private:
  bool terminal_;
  bool shown_ = false;
};

/// The text, or its end behind "…" where it is longer than `width` characters.
std::string Abridged(const std::string& text, std::size_t width);

}  // namespace aisle
