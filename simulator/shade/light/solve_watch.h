#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <vector>

#include "simulator/common/light_progress.h"

namespace aisle::sim {

/// Looks after one solution and tells how far it is. Nothing is ever decided by it.
class SolveWatch {
 public:
  /// A phase, and its seconds on one processor as far as they can be foreseen: only their ratios
  /// matter.
  struct Foreseen {
    const char* name;
    double seconds = 0;
  };

  /// `tell` may be empty. Phases in their order.
  SolveWatch(TellLight tell, std::vector<Foreseen> phases);
  SolveWatch(const SolveWatch&) = delete;
  SolveWatch& operator=(const SolveWatch&) = delete;

  /// The next phase, which takes so many steps. Tells so.
  void Begin(std::size_t steps);
  /// So many steps of it are done. Thread-safe; tells some ten times a second.
  void Add(std::size_t steps);
  /// All is done. Tells so.
  void End();

 private:
  using Clock = std::chrono::steady_clock;
  void Tell(double share);

  const TellLight tell_;
  const std::vector<Foreseen> phases_;
  double total_s_ = 0;
  double before_s_ = 0;  ///< foreseen for what is over
  std::size_t phase_ = 0, steps_ = 1;
  bool begun_ = false;
  std::atomic<std::size_t> done_{0};
  std::atomic<Clock::rep> next_told_{0};
  std::mutex mutex_;  ///< guards told_ and the call
  double told_ = 0;
};

}  // namespace aisle::sim
