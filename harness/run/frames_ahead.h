#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "harness/contract/sequence.h"

namespace aisle {

/// Asks a sequence for frames in order, a bounded number ahead of the consumer, in one thread of
/// its own: rendering and SLAM overlap, and no frame depends on how far ahead it was made.
class FramesAhead {
 public:
  struct Frame {
    SequenceFrame frame;
    double made_ms = 0;  ///< wall time spent making it
  };

  /// `sequence` must outlive this. `ahead` >= 1 frames wait in the queue at most.
  FramesAhead(const Sequence& sequence, std::vector<FrameRequest> requests, std::size_t ahead);
  ~FramesAhead();
  FramesAhead(const FramesAhead&) = delete;
  FramesAhead& operator=(const FramesAhead&) = delete;

  /// The next frame in order; waits for it. Rethrows what the sequence threw. Must not be called
  /// more often than there are requests.
  Frame Next();

 private:
  void Produce();

  const Sequence& sequence_;
  const std::vector<FrameRequest> requests_;
  const std::size_t ahead_;
  std::mutex mutex_;  ///< guards the four below
  std::condition_variable changed_;
  std::deque<Frame> ready_;
  std::exception_ptr failure_;
  bool stop_ = false;
  std::thread producer_;
};

}  // namespace aisle
