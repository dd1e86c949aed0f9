#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "harness/common/text_layout.h"

namespace aisle {

/// stdout is a terminal and NO_COLOR is not set.
bool StdoutHasColor();

/// Colours as above. Columns as COLUMNS says or else the terminal; none where stdout is no
/// terminal.
TextLook LookOfStdout();

/// One line of progress that rewrites itself on a terminal. Elsewhere, as in a log, it is said as a
/// line of its own once a minute.
class ProgressLine {
 public:
  using Clock = std::chrono::steady_clock;
  ProgressLine();
  ~ProgressLine() { Clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void Show(const std::string& text, Clock::time_point now = Clock::now());
  /// Takes the line away, so that something lasting can be printed.
  void Clear();

 private:
  bool terminal_;
  bool shown_ = false;
  std::optional<Clock::time_point> said_;  ///< in a log; at first, when it began
};

/// The text, or its end behind "…" where it is longer than `width` characters.
std::string Abridged(const std::string& text, std::size_t width);

}  // namespace aisle
