#include "slam/common/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

namespace aisle::slam::internal {

void SplitRange(std::ptrdiff_t first, std::ptrdiff_t last, Part part) {
  tbb::parallel_for(tbb::blocked_range(first, last),
                    [part](const tbb::blocked_range<std::ptrdiff_t>& range) {
                      part.call(part.work, range.begin(), range.end());
                    });
}

void DoAll(std::span<const Part> parts) {
  tbb::task_group group;
  for (const Part& part : parts.subspan(1)) group.run([part] { part.call(part.work, 0, 0); });
  group.run_and_wait([part = parts.front()] { part.call(part.work, 0, 0); });
}

struct TaskGroup {
  tbb::task_group tasks;
};

std::unique_ptr<TaskGroup, EndGroup> Start(Part part) {
  std::unique_ptr<TaskGroup, EndGroup> group(new TaskGroup);
  group->tasks.run([part] { part.call(part.work, 0, 0); });
  return group;
}

void Await(TaskGroup& group) { group.tasks.wait(); }

void EndGroup::operator()(TaskGroup* group) const {
  try {
    group->tasks.wait();
  } catch (...) {  // of work that nobody asked for any more
  }
  delete group;
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

}  // namespace aisle::slam::internal
