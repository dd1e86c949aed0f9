#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>

#if defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>
#endif

namespace aisle::slam {

/// Work on the threads of oneTBB, which only parallel.cc knows. It orders what was before the work,
/// its parts and what comes after by means that ThreadSanitizer does not see; so parallel.cc is
/// built without it, and it is told here, where work is lent to other threads and taken back. What
/// it then reports are races of our own.
namespace internal {

inline void Release([[maybe_unused]] const char& sign) {
#if defined(__SANITIZE_THREAD__)
  __tsan_release(const_cast<char*>(&sign));
#endif
}
inline void Acquire([[maybe_unused]] const char& sign) {
#if defined(__SANITIZE_THREAD__)
  __tsan_acquire(const_cast<char*>(&sign));
#endif
}

/// Lent work without its type: call(work, first, last) does the part [first, last) of it.
struct Part {
  const void* work;
  void (*call)(const void* work, std::ptrdiff_t first, std::ptrdiff_t last);
};

/// Lends `work`, callable as work(first, last) or work(), to other threads; it must have finished
/// before this is destroyed.
template <typename Work>
class Lent {
 public:
  explicit Lent(const Work& work) : work_(work) { Release(begun_); }
  Lent(const Lent&) = delete;
  Lent& operator=(const Lent&) = delete;
  ~Lent() { TakeBack(); }
  void TakeBack() const { Acquire(done_); }
  Part part() const { return {this, &Call}; }

 private:
  struct Doing {
    explicit Doing(const Lent& lent) : done(lent.done_) { Acquire(lent.begun_); }
    ~Doing() { Release(done); }
    const char& done;
  };

  static void Call(const void* lent, [[maybe_unused]] std::ptrdiff_t first,
                   [[maybe_unused]] std::ptrdiff_t last) {
    const auto& self = *static_cast<const Lent*>(lent);
    const Doing doing(self);
    if constexpr (std::is_invocable_v<const Work&>) {
      self.work_();
    } else {
      self.work_(first, last);
    }
  }

  const Work& work_;
  char begun_ = 0, done_ = 0;  // addresses alone matter
};

void SplitRange(std::ptrdiff_t first, std::ptrdiff_t last, Part part);
void DoAll(std::span<const Part> parts);

struct TaskGroup;
struct EndGroup {
  void operator()(TaskGroup* group) const;  ///< awaits it; what it has thrown is dropped
};
std::unique_ptr<TaskGroup, EndGroup> Start(Part part);
void Await(TaskGroup& group);

struct Threads;
struct EndThreads {
  void operator()(Threads* threads) const;
};
std::unique_ptr<Threads, EndThreads> MakeThreads(int count);
void DoOn(Threads& threads, Part part);

}  // namespace internal

/// Calls work(i) for first <= i < last, on the threads of the arena at hand, in any order.
template <typename Index, typename Work>
void ParallelFor(Index first, Index last, const Work& work) {
  const auto part = [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    for (std::ptrdiff_t i = begin; i < end; ++i) work(static_cast<Index>(i));
  };
  const internal::Lent lent(part);
  internal::SplitRange(static_cast<std::ptrdiff_t>(first), static_cast<std::ptrdiff_t>(last),
                       lent.part());
}

/// Calls each, at the same time where threads are free.
template <typename... Works>
void ParallelInvoke(const Works&... works) {
  [](const internal::Lent<Works>&... lent) {
    internal::DoAll(std::array{lent.part()...});
  }(internal::Lent<Works>(works)...);
}

/// Work that goes on beside the caller's until it is awaited, at the latest when this ends.
class Beside {
 public:
  explicit Beside(std::function<void()> work)
      : work_(std::move(work)), lent_(work_), group_(internal::Start(lent_.part())) {}
  /// Throws what the work has thrown.
  void Wait() {
    internal::Await(*group_);
    lent_.TakeBack();
  }

 private:
  const std::function<void()> work_;
  const internal::Lent<std::function<void()>> lent_;
  const std::unique_ptr<internal::TaskGroup, internal::EndGroup> group_;
};

/// Threads of its own for what is executed in it.
class Arena {
 public:
  /// 0 or fewer: as many threads as there are processors.
  explicit Arena(int threads) : threads_(internal::MakeThreads(threads)) {}

  /// work(), on the caller's thread or, where others have taken all places, on one of them.
  template <typename Work>
  auto Execute(const Work& work) const {
    using Value = std::invoke_result_t<const Work&>;
    if constexpr (std::is_void_v<Value>) {
      const internal::Lent lent(work);
      internal::DoOn(*threads_, lent.part());
    } else {
      std::optional<Value> value;
      Execute([&] { value.emplace(work()); });
      return *std::move(value);
    }
  }

 private:
  std::unique_ptr<internal::Threads, internal::EndThreads> threads_;
};

}  // namespace aisle::slam
