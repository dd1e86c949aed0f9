#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <future>
#include <optional>
#include <utility>
#include <vector>

#include "slam/common/stopwatch.h"

namespace aisle::slam {

/// One piece of background work whose result is taken at an appointed frame: never earlier, and if
/// it is late the taker waits. When the work really runs changes nothing but the waiting. Unless
/// the taker asks for it `anytime`: then it comes when it is ready, and nothing repeats.
template <typename Result>
class BackgroundJob {
 public:
  bool pending() const { return future_.valid(); }
  std::int64_t due_frame() const { return due_frame_; }

  /// Starts `work`, in a thread of its own or, if not `threaded`, when the result is taken. Work
  /// that it takes the place of is not awaited here: in its thread it runs on, and is joined when a
  /// result is taken; if not begun yet, it never is.
  void Start(std::int64_t due_frame, bool threaded, std::function<Result()> work) {
    due_frame_ = due_frame;
    if (pending()) abandoned_.push_back(std::move(future_));
    future_ = std::async(threaded ? std::launch::async : std::launch::deferred, std::move(work));
  }

  /// Until the result is ready, if there is work.
  void Wait() const {
    if (pending()) future_.wait();
  }

  /// The result once `frame` has come (`anytime`: once it is ready), else nothing; `wait_ms` grows
  /// by the time spent waiting. What the work threw comes out here. From here on no work reads what
  /// the taker may change.
  std::optional<Result> TakeIfDue(std::int64_t frame, double& wait_ms, bool anytime = false) {
    if (!pending() || !(anytime ? IsReady() : frame >= due_frame_)) return std::nullopt;
    return Timed(wait_ms, [this] {
      abandoned_.clear();  // waits for what still runs
      return future_.get();
    });
  }

 private:
  bool IsReady() const {
    const auto is_ready = [](const std::future<Result>& one) {
      return one.wait_for(std::chrono::seconds(0)) != std::future_status::timeout;
    };
    return is_ready(future_) && std::ranges::all_of(abandoned_, is_ready);
  }

  std::vector<std::future<Result>> abandoned_;  // their ends wait for their threads
  std::future<Result> future_;
  std::int64_t due_frame_ = 0;
};

}  // namespace aisle::slam
