#pragma once

#include <chrono>

namespace aisle::slam {

/// Adds the wall time of its own life to a number of milliseconds. Reported, never decided upon.
class Stopwatch {
 public:
  explicit Stopwatch(double& total_ms) : total_ms_(total_ms) {}
  ~Stopwatch() {
    const std::chrono::duration<double, std::milli> took =
        std::chrono::steady_clock::now() - start_;
    total_ms_ += took.count();
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& total_ms_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// The value of a stage, whose wall time is added to `ms`.
template <typename Stage>
auto Timed(double& ms, const Stage& stage) {
  const Stopwatch time(ms);
  return stage();
}

}  // namespace aisle::slam
