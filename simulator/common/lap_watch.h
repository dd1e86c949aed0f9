#pragma once

#include <chrono>

namespace aisle::sim {

/// Wall time since it was made or last read. For reports only; nothing is ever decided by it.
class LapWatch {
 public:
  /// Milliseconds.
  double Lap() {
    const Clock::time_point now = Clock::now();
    const double ms = std::chrono::duration<double, std::milli>(now - start_).count();
    start_ = now;
    return ms;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace aisle::sim
