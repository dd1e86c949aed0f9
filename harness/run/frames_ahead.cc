#include "harness/run/frames_ahead.h"

#include "harness/common/stopwatch.h"

namespace aisle {

FramesAhead::FramesAhead(const Sequence& sequence, std::vector<FrameRequest> requests,
                         std::size_t ahead)
    : sequence_(sequence),
      requests_(std::move(requests)),
      ahead_(std::max<std::size_t>(ahead, 1)),
      producer_([this] { Produce(); }) {}

FramesAhead::~FramesAhead() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  producer_.join();
}

void FramesAhead::Produce() {
  for (const FrameRequest& request : requests_) {
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return stop_ || ready_.size() < ahead_; });
      if (stop_) return;
    }
    Frame made;
    std::exception_ptr failure;
    try {
      const Stopwatch watch;
      made.frame = sequence_.At(request);
      made.made_ms = watch.ElapsedMs();
    } catch (...) {
      failure = std::current_exception();
    }
    {
      const std::lock_guard lock(mutex_);
      failure_ = failure;
      if (!failure) ready_.push_back(std::move(made));
    }
    changed_.notify_all();
    if (failure) return;
  }
}

FramesAhead::Frame FramesAhead::Next() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !ready_.empty() || failure_; });
  if (ready_.empty()) std::rethrow_exception(failure_);
  Frame next = std::move(ready_.front());
  ready_.pop_front();
  lock.unlock();
  changed_.notify_all();
  return next;
}

}  // namespace aisle
