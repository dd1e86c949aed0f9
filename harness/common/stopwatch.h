#pragma once

#include <chrono>

namespace aisle {

/// Wall time since it was made. For reports, and for how long others are waited for; no score and
/// no frame is ever decided by it.
class Stopwatch {
 public:
  double ElapsedMs() const {
    return std::chrono::duration<double, std::milli>(Clock::now() - start_).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace aisle
