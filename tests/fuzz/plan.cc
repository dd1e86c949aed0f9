#include "harness/suite/plan.h"

#include "harness/io/input_error.h"
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace aisle;
  try {
    const PlanFile plan = PlanFromJson(std::string(fuzz::Text(data, size)), "plan.json");
    const std::string text = ToJson(plan);
    fuzz::Hold(ToJson(PlanFromJson(text, "plan.json")) == text, "a plan reads back as written");
    ++fuzz::taken;
  } catch (const InputError&) {
  }
  return 0;
}
