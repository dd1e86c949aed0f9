#include "harness/suite/suite.h"
#include "harness/io/input_error.h"
#include "harness/suite/plan.h"
#include "tests/fuzz/fuzz.h"

/// A suite file; a good one is written into a plan and read from it again.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace aisle;
  static const Vocabulary vocabulary = [] {
    Vocabulary known;
    known.systems = {"orbslam2", "plain", "semantic", "paper", "robust", "oracle"};
    known.twins = {"live", "empty", "frozen"};
    const auto nothing = [](const auto&...) { return std::string(); };
    known.check_score = nothing;
    known.is_share = [](const std::string&) { return true; };
    known.check_option = nothing;
    known.check_options = nothing;
    return known;
  }();
  try {
    const std::string file = fuzz::AsFile(fuzz::Text(data, size), "fuzz.yaml").string();
    if (!IsSuiteFile(file)) return 0;
    const PlanFile plan{{LoadSuite(file, vocabulary)}, "fuzz", file};
    const std::string text = ToJson(plan);
    fuzz::Hold(ToJson(PlanFromJson(text, "plan.json")) == text, "a plan reads back as written");
    ++fuzz::taken;
  } catch (const InputError&) {
  }
  return 0;
}
