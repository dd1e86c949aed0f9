#pragma once

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_group.h>

#if defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>
#endif

namespace aisle::slam {

/// Work that is split among threads and awaited. oneTBB orders what was before it, the parts and
/// what comes after by means that ThreadSanitizer does not see in a packaged library; it is told
/// here, so that what is left to report are races of our own. Nothing in other builds.
class ForkAndJoin {
 public:
#if defined(__SANITIZE_THREAD__)
  ForkAndJoin() { __tsan_release(&fork_); }
  ~ForkAndJoin() { Join(); }
  ForkAndJoin(const ForkAndJoin&) = delete;
  ForkAndJoin& operator=(const ForkAndJoin&) = delete;
  void Join() { __tsan_acquire(&join_); }
  /// What this hands over is made after the fork and read before it is acquired: only that is not
  /// looked at. GCC never inlines the work, which is, into what is not.
  template <typename Work>
  auto Part(const Work& work) {
    return [ this, &work ](auto... arguments) __attribute__((no_sanitize_thread)) {
      __tsan_acquire(&fork_);
      work(arguments...);
      __tsan_release(&join_);
    };
  }

 private:
  char fork_ = 0, join_ = 0;  // addresses alone matter
#else
  void Join() {}
  template <typename Work>
  const Work& Part(const Work& work) {
    return work;
  }
#endif
};

/// Calls work(i) for first <= i < last, on the threads of the arena at hand, in any order.
template <typename Index, typename Work>
void ParallelFor(Index first, Index last, const Work& work) {
  ForkAndJoin split;
  tbb::parallel_for(first, last, split.Part(work));
}

/// Calls each, at the same time where threads are free.
template <typename... Works>
void ParallelInvoke(const Works&... works) {
  ForkAndJoin split;
  tbb::parallel_invoke(split.Part(works)...);
}

/// Work that goes on beside the caller's until it is awaited, at the latest when this ends.
class Beside {
 public:
  template <typename Work>
  explicit Beside(const Work& work) {
    group_.run([this, work] { split_.Part(work)(); });
  }
  Beside(const Beside&) = delete;
  Beside& operator=(const Beside&) = delete;
  ~Beside() {
    try {
      group_.wait();
    } catch (...) {  // of work that nobody asked for any more
    }
  }
  /// Throws what the work has thrown.
  void Wait() {
    group_.wait();
    split_.Join();
  }

 private:
  ForkAndJoin split_;
  tbb::task_group group_;
};

}  // namespace aisle::slam
