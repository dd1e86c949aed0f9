#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <optional>
#include <utility>

namespace aisle::slam {

/// One piece of background work whose result is taken at an appointed frame: never earlier, and if
/// it is late the taker waits. When the work really runs changes nothing but the waiting.
template <typename Result>
class BackgroundJob {
 public:
  bool pending() const { return future_.valid(); }
  std::int64_t due_frame() const { return due_frame_; }

  /// Starts `work`, in a thread of its own or, if not `threaded`, when the result is taken.
  void Start(std::int64_t due_frame, bool threaded, std::function<Result()> work) {
    due_frame_ = due_frame;
    future_ = std::async(threaded ? std::launch::async : std::launch::deferred, std::move(work));
  }

  /// The result once `frame` has come, else nothing; `wait_ms` grows by the time spent waiting.
  /// What the work threw comes out here.
  std::optional<Result> TakeIfDue(std::int64_t frame, double& wait_ms) {
    if (!pending() || frame < due_frame_) return std::nullopt;
    const auto start = std::chrono::steady_clock::now();
    Result result = future_.get();
    const std::chrono::duration<double, std::milli> waited =
        std::chrono::steady_clock::now() - start;
    wait_ms += waited.count();
    return result;
  }

 private:
  std::future<Result> future_;
  std::int64_t due_frame_ = 0;
};

}  // namespace aisle::slam
