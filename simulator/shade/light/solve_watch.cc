#include "simulator/shade/light/solve_watch.h"

#include <algorithm>

namespace aisle::sim {
namespace {

constexpr auto kBetweenTells = std::chrono::milliseconds(100);

}  // namespace

SolveWatch::SolveWatch(TellLight tell, std::vector<Foreseen> phases)
    : tell_(std::move(tell)), phases_(std::move(phases)) {
  for (const Foreseen& phase : phases_) total_s_ += phase.seconds;
}

void SolveWatch::Begin(std::size_t steps) {
  if (begun_) before_s_ += phases_[phase_++].seconds;
  begun_ = true;
  steps_ = std::max<std::size_t>(steps, 1);
  done_ = 0;
  next_told_ = 0;
  Add(0);
}

void SolveWatch::Add(std::size_t steps) {
  const std::size_t done = done_.fetch_add(steps) + steps;
  if (!tell_) return;
  const Clock::time_point now = Clock::now();
  if (now.time_since_epoch().count() < next_told_.load(std::memory_order_relaxed)) return;
  next_told_ = (now + kBetweenTells).time_since_epoch().count();
  const double of_phase = std::min(1.0, static_cast<double>(done) / static_cast<double>(steps_));
  Tell(total_s_ > 0 ? (before_s_ + of_phase * phases_[phase_].seconds) / total_s_ : 0);
}

void SolveWatch::Tell(double share) {
  const std::lock_guard lock(mutex_);
  told_ = std::clamp(share, told_, 1.0);
  tell_({phases_[phase_].name, told_});
}

void SolveWatch::End() {
  if (tell_) Tell(1);
}

}  // namespace aisle::sim
