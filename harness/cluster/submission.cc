#include "harness/cluster/submission.h"

#include <nlohmann/json.hpp>

#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/io/json_text.h"
#include "harness/record/record_json.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

template <class Value, class Read>
std::optional<Value> ReadJson(const fs::path& path, Read read) {
  try {
    return read(ParseJson(ReadFile(path)));
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

}  // namespace

void WriteSubmission(const Submission& submission, const fs::path& out) {
  WriteFileAtomically(
      out / "cluster" / "submission.json",
      Dump({{"id", submission.id}, {"arrays", submission.arrays}, {"merge", submission.merge}}));
}

std::optional<Submission> ReadSubmission(const fs::path& out) {
  return ReadJson<Submission>(out / "cluster" / "submission.json", [](const Json& json) {
    return Submission{.id = json.at("id").get<std::string>(),
                      .arrays = json.at("arrays").get<std::vector<std::string>>(),
                      .merge = json.at("merge").get<std::string>()};
  });
}

void WriteVerdict(const ClusterVerdict& verdict, const fs::path& out) {
  WriteFileAtomically(out / "cluster" / "verdict.json",
                      Dump({{"submission", verdict.submission}, {"exit_code", verdict.exit_code}}));
}

std::optional<ClusterVerdict> ReadVerdict(const fs::path& out) {
  return ReadJson<ClusterVerdict>(out / "cluster" / "verdict.json", [](const Json& json) {
    return ClusterVerdict{.submission = json.at("submission").get<std::string>(),
                          .exit_code = json.at("exit_code").get<int>()};
  });
}

void ForgetNight(const fs::path& out) {
  for (const char* file : {"verdict.json", "submission.json", "tasks.json"}) {
    const fs::path path = out / "cluster" / file;
    std::error_code error;
    fs::remove(path, error);
    if (error) throw MachineError(fmt::format("{}: {}", path.string(), error.message()));
  }
}

}  // namespace aisle
