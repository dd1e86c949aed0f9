#include "harness/report/allure.h"

#include <chrono>
#include <nlohmann/json.hpp>

#include "harness/io/file.h"
#include "harness/io/hash.h"
#include "harness/io/input_error.h"
#include "harness/record/group.h"
#include "harness/record/record_json.h"
#include "harness/report/junit.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t kLargestAttachment = std::size_t{16} << 20;

/// Milliseconds since 1970 of "2026-01-31T02:00:00Z"; 0 for another text.
std::int64_t MillisecondsOf(const std::string& iso) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, second = 0;
  if (std::sscanf(iso.c_str(), "%d-%d-%dT%d:%d:%d", &year, &month, &day, &hour, &minute, &second) !=
      6) {
    return 0;
  }
  const std::chrono::sys_days date{std::chrono::year(year) / month / day};
  const std::int64_t days = date.time_since_epoch().count();
  return 1000 * (((days * 24 + hour) * 60 + minute) * 60 + second);
}

/// The same for the same text.
std::string Uuid(const std::string& text) {
  const std::string hex = fmt::format("{:016x}{:016x}", Hash(text, 1), Hash(text, 2));
  return fmt::format("{}-{}-{}-{}-{}", hex.substr(0, 8), hex.substr(8, 4), hex.substr(12, 4),
                     hex.substr(16, 4), hex.substr(20));
}

/// Writes the tests of one night.
class Folder {
 public:
  Folder(const Results& results, fs::path report_dir, fs::path into)
      : results_(results), report_dir_(std::move(report_dir)), into_(std::move(into)) {}

  void Add(const Verdict& verdict) const {
    const std::size_t colon = verdict.name.rfind(": ");
    const std::string name =
        colon == std::string::npos ? verdict.name : verdict.name.substr(colon + 2);
    Json test = Test(verdict.name, name, verdict.scene, verdict.system);
    // A crash is no failed expectation: Allure tells the two apart.
    test["status"] = verdict.passed ? "passed" : name == "completes" ? "broken" : "failed";
    if (!verdict.passed) {
      test["statusDetails"] = {{"message", verdict.why},
                               {"trace", FailureText(verdict, results_, report_dir_)},
                               {"flaky", verdict.flaky}};
      if (const RunRecord* run = WorstRun(RunsOf(verdict, results_))) Attach(*run, &test);
    }
    Write(test);
  }

  void Add(const RunRecord& run) const {
    Json test =
        Test(RunId(run.spec) + ": completes", "completes", run.spec.scene, run.spec.system.name);
    test["status"] = "passed";
    test["stop"] = test["start"].get<std::int64_t>() + std::llround(1000 * run.wall_s);
    Write(test);
  }

  void AddEnvironment() const {
    const Provenance& from = results_.provenance;
    std::string text;
    for (const auto& [name, value] :
         {std::pair("aisle", from.version), std::pair("commit", from.commit),
          std::pair("cpu", from.cpu), std::pair("os", from.os)}) {
      text += fmt::format("{}={}\n", name, Printable(value, 200));
    }
    WriteFileAtomically(into_ / "environment.properties", text);
  }

 private:
  Json Test(const std::string& whole, const std::string& name, const std::string& scene,
            const std::string& system) const {
    const std::string full = results_.suite + "." + whole;
    const std::int64_t start = MillisecondsOf(results_.started);
    Json test = {{"uuid", Uuid(full + results_.started)},
                 {"historyId", Uuid(full)},
                 {"testCaseId", Uuid(full)},
                 {"fullName", full},
                 {"name", whole},
                 {"stage", "finished"},
                 {"start", start},
                 {"stop", start + std::llround(1000 * results_.wall_s)},
                 {"attachments", Json::array()}};
    test["labels"] = Json::array();
    for (const auto& [label, value] :
         {std::pair("framework", std::string("aisle")), std::pair("parentSuite", results_.suite),
          std::pair("suite", scene), std::pair("subSuite", system), std::pair("feature", name),
          std::pair("host", results_.provenance.cpu)}) {
      if (!value.empty()) test["labels"].push_back({{"name", label}, {"value", value}});
    }
    return test;
  }

  /// The log and the worst frame of a run, where they are.
  void Attach(const RunRecord& run, Json* test) const {
    for (const auto& [name, path] : run.artifacts) {
      const bool worst = path.find("worst_error") != std::string::npos;
      if (name != "log" && !worst) continue;
      const std::string source = (*test)["uuid"].get<std::string>() + "-" + SafeName(name) +
                                 (worst ? "-attachment.jpg" : "-attachment.txt");
      try {
        WriteFileAtomically(into_ / source, ReadFile(report_dir_ / path, kLargestAttachment));
      } catch (const InputError&) {
        continue;  // the folder was tidied up: the test stands without
      }
      (*test)["attachments"].push_back({{"name", worst ? "the worst frame" : "log"},
                                        {"source", source},
                                        {"type", worst ? "image/jpeg" : "text/plain"}});
    }
  }

  void Write(const Json& test) const {
    WriteFileAtomically(into_ / (test["uuid"].get<std::string>() + "-result.json"), Dump(test));
  }

  const Results& results_;
  const fs::path report_dir_, into_;
};

/// Takes away what an earlier night left, and nothing else.
void Clear(const fs::path& into) {
  std::error_code error;
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(into, error)) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with("-result.json") || name.find("-attachment.") != std::string::npos) {
      old.push_back(entry.path());
    }
  }
  for (const fs::path& file : old) fs::remove(file, error);
}

}  // namespace

void WriteAllure(const Results& results, const fs::path& report_dir, const fs::path& into) {
  Clear(into);
  const Folder folder(results, report_dir, into);
  for (const Verdict& verdict : results.verdicts) folder.Add(verdict);
  for (const RunRecord& run : results.runs) {
    if (IsComplete(run.status)) folder.Add(run);
  }
  folder.AddEnvironment();
}

}  // namespace aisle
