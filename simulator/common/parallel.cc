#include "simulator/common/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace aisle::sim::internal {

void SplitRange(std::ptrdiff_t first, std::ptrdiff_t last, Part part) {
  tbb::parallel_for(tbb::blocked_range(first, last),
                    [part](const tbb::blocked_range<std::ptrdiff_t>& range) {
                      part.call(part.work, range.begin(), range.end());
                    });
}

void DoIsolated(Part part) {
  tbb::this_task_arena::isolate([part] { part.call(part.work, 0, 0); });
}

struct Threads {
  tbb::task_arena arena;
};

std::unique_ptr<Threads, EndThreads> MakeThreads(int count) {
  return std::unique_ptr<Threads, EndThreads>(
      new Threads{tbb::task_arena(count > 0 ? count : tbb::task_arena::automatic)});
}

void EndThreads::operator()(Threads* threads) const { delete threads; }

void DoOn(Threads& threads, Part part) {
  threads.arena.execute([part] { part.call(part.work, 0, 0); });
}

}  // namespace aisle::sim::internal
