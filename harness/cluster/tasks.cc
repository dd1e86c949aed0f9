#include "harness/cluster/tasks.h"

#include <map>
#include <nlohmann/json.hpp>

#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/io/json_text.h"
#include "harness/record/record.h"
#include "harness/record/record_json.h"
#include "harness/suite/plan.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int kSchema = 1;

fs::path TasksPath(const fs::path& out) { return out / "cluster" / "tasks.json"; }

Json ToJson(const TaskSettings& settings) {
  return {{"threads", settings.threads},
          {"timeout_s", settings.limits.wall_s},
          {"memory_mib", settings.limits.memory_mib},
          {"retry", settings.retry},
          {"frame_cache", settings.frame_cache},
          {"video", settings.video},
          {"debug_dynamic", settings.debug_dynamic},
          {"frames_in_report", settings.frames_in_report},
          {"remember", settings.remember},
          {"allure", settings.allure},
          {"gate", settings.gate},
          {"started", settings.started},
          {"late_s", settings.late_s}};
}

TaskSettings SettingsFromJson(const Json& json) {
  TaskSettings settings;
  json.at("threads").get_to(settings.threads);
  json.at("timeout_s").get_to(settings.limits.wall_s);
  json.at("memory_mib").get_to(settings.limits.memory_mib);
  json.at("retry").get_to(settings.retry);
  json.at("frame_cache").get_to(settings.frame_cache);
  json.at("video").get_to(settings.video);
  json.at("debug_dynamic").get_to(settings.debug_dynamic);
  json.at("frames_in_report").get_to(settings.frames_in_report);
  json.at("remember").get_to(settings.remember);
  json.at("allure").get_to(settings.allure);
  json.at("gate").get_to(settings.gate);
  json.at("started").get_to(settings.started);
  json.at("late_s").get_to(settings.late_s);
  return settings;
}

TaskList FromJson(const Json& json, const std::vector<RunSpec>& specs) {
  if (json.at("schema") != kSchema) {
    throw std::invalid_argument(fmt::format("schema is not {}", kSchema));
  }
  std::map<std::string, const RunSpec*> by_id;
  for (const RunSpec& spec : specs) by_id.emplace(RunId(spec), &spec);
  TaskList list{.settings = SettingsFromJson(json.at("settings")), .tasks = {}};
  for (const Json& entry : json.at("tasks")) {
    Task task{.runs = {}, .cost_s = entry.at("cost_s").get<double>()};
    for (const Json& run : entry.at("runs")) {
      const auto id = run.at("id").get<std::string>();
      const auto at = by_id.find(id);
      if (at == by_id.end()) throw std::invalid_argument("plan.json has no run " + id);
      task.runs.push_back({*at->second, run.at("inputs_hash").get<std::string>()});
    }
    list.tasks.push_back(std::move(task));
  }
  return list;
}

}  // namespace

std::vector<Task> CutIntoTasks(const std::vector<TaskRun>& runs, const TaskCost& cost) {
  std::map<std::tuple<std::string, std::string, std::uint64_t>, std::size_t> index;
  std::vector<Task> tasks;
  for (const TaskRun& run : runs) {
    const auto [at, is_new] =
        index.try_emplace({run.spec.scene, run.spec.twin, run.spec.seed}, tasks.size());
    if (is_new) tasks.emplace_back();
    tasks[at->second].runs.push_back(run);
  }
  for (Task& task : tasks) task.cost_s = cost(task.runs);
  std::stable_sort(tasks.begin(), tasks.end(),
                   [](const Task& a, const Task& b) { return a.cost_s > b.cost_s; });
  return tasks;
}

std::string ToJson(const TaskList& list) {
  Json json = {{"schema", kSchema}, {"settings", ToJson(list.settings)}};
  json["tasks"] = Json::array();
  for (const Task& task : list.tasks) {
    Json runs = Json::array();
    for (const TaskRun& run : task.runs) {
      runs.push_back({{"id", RunId(run.spec)}, {"inputs_hash", run.inputs_hash}});
    }
    json["tasks"].push_back({{"cost_s", task.cost_s}, {"runs", std::move(runs)}});
  }
  return Dump(json);
}

TaskList TasksFromJson(const std::string& text, const std::string& file,
                       const std::vector<RunSpec>& specs) {
  try {
    return FromJson(ParseJson(text), specs);
  } catch (const std::exception& error) {
    throw InputError(file, 0, "not a task list: " + Printable(error.what(), 200));
  }
}

void WriteTasks(const TaskList& list, const fs::path& out) {
  WriteFileAtomically(TasksPath(out), ToJson(list));
}

TaskList ReadTasks(const fs::path& out) {
  const fs::path plan_path = out / "plan.json", tasks_path = TasksPath(out);
  const PlanFile plan = PlanFromJson(ReadFile(plan_path), plan_path.string());
  return TasksFromJson(ReadFile(tasks_path), tasks_path.string(), Plan(plan.suites));
}

bool HasTasks(const fs::path& out) { return fs::exists(TasksPath(out)); }

std::vector<std::size_t> Unfinished(const TaskList& list, const fs::path& out) {
  std::vector<std::size_t> unfinished;
  for (std::size_t i = 0; i < list.tasks.size(); ++i) {
    const std::vector<TaskRun>& runs = list.tasks[i].runs;
    const bool finished = std::all_of(runs.begin(), runs.end(), [&](const TaskRun& run) {
      return ReadFinishedRun(run.spec, run.inputs_hash, list.settings.limits, out).has_value();
    });
    if (!finished) unfinished.push_back(i);
  }
  return unfinished;
}

}  // namespace aisle
