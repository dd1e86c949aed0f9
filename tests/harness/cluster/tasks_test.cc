#include "harness/cluster/tasks.h"

#include <gtest/gtest.h>

#include <set>

#include "harness/io/input_error.h"
#include "harness/record/record.h"

namespace aisle {
namespace {

RunSpec Spec(const std::string& scene, const std::string& twin, const std::string& system,
             std::uint64_t seed, int repeat = 1) {
  return {
      .scene = scene,
      .scene_file = "scenes/" + scene + ".yaml",
      .twin = twin,
      .system = {.name = system, .like = system, .options = {}, .mask_errors = {}, .external = {}},
      .seed = seed,
      .repeat = repeat};
}

std::vector<TaskRun> Runs() {
  std::vector<TaskRun> runs;
  for (const char* scene : {"short", "long"}) {
    for (const char* twin : {"live", "empty"}) {
      for (const std::uint64_t seed : {1, 2, 3}) {
        for (const char* system : {"plain", "paper"}) {
          runs.push_back({Spec(scene, twin, system, seed), fmt::format("hash{}", runs.size())});
        }
        runs.push_back({Spec(scene, twin, "paper", seed, 2), fmt::format("hash{}", runs.size())});
      }
    }
  }
  return runs;
}

double ByScene(const std::vector<TaskRun>& runs) {
  return runs.front().spec.scene == "long" ? 100 : 1;
}

TEST(TasksTest, EachHoldsTheRunsThatShareTheirFramesAndNoOther) {
  const std::vector<TaskRun> runs = Runs();
  const std::vector<Task> tasks = CutIntoTasks(runs, ByScene);
  EXPECT_EQ(tasks.size(), 12);
  std::set<std::string> seen;
  for (const Task& task : tasks) {
    EXPECT_EQ(task.runs.size(), 3);
    for (const TaskRun& run : task.runs) {
      EXPECT_EQ(run.spec.scene, task.runs.front().spec.scene);
      EXPECT_EQ(run.spec.twin, task.runs.front().spec.twin);
      EXPECT_EQ(run.spec.seed, task.runs.front().spec.seed);
      EXPECT_TRUE(seen.insert(RunId(run.spec)).second);
    }
  }
  EXPECT_EQ(seen.size(), runs.size());
}

TEST(TasksTest, TheLongestComesFirst) {
  const std::vector<Task> tasks = CutIntoTasks(Runs(), ByScene);
  for (std::size_t i = 1; i < tasks.size(); ++i) {
    EXPECT_GE(tasks[i - 1].cost_s, tasks[i].cost_s);
  }
  EXPECT_EQ(tasks.front().runs.front().spec.scene, "long");
  EXPECT_EQ(tasks.front().runs.front().spec.seed, 1);  // equals in the plan's order
}

TEST(TasksTest, AListComesBackAsItWasWritten) {
  TaskList list{.settings = {.threads = 5,
                             .limits = {.wall_s = 7.5, .memory_mib = 100},
                             .retry = false,
                             .frames_in_report = "none",
                             .allure = "a \"b\"",
                             .gate = true,
                             .started = "2026-01-31T02:00:00Z"},
                .tasks = CutIntoTasks(Runs(), ByScene)};
  std::vector<RunSpec> specs;
  for (const TaskRun& run : Runs()) specs.push_back(run.spec);
  const TaskList back = TasksFromJson(ToJson(list), "tasks.json", specs);
  EXPECT_EQ(ToJson(back), ToJson(list));
  ASSERT_EQ(back.tasks.size(), list.tasks.size());
  EXPECT_EQ(back.tasks[3].runs[1].spec, list.tasks[3].runs[1].spec);
  specs.pop_back();  // another plan
  EXPECT_THROW(TasksFromJson(ToJson(list), "tasks.json", specs), InputError);
}

TEST(TasksTest, WhatIsNoListIsSaidSo) {
  for (const char* bad : {"", "{}", "[]", "{\"schema\": 99}", "{\"schema\": 1, \"tasks\": 3}"}) {
    EXPECT_THROW(TasksFromJson(bad, "tasks.json", {}), InputError) << bad;
  }
}

TEST(TasksTest, NestingBeyondAnyListIsNamedWithTheFile) {
  try {
    TasksFromJson(std::string(100, '[') + std::string(100, ']'), "tasks.json", {});
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "tasks.json: not a task list: nested deeper than 64 levels");
  }
}

}  // namespace
}  // namespace aisle
