#include "harness/record/results.h"

#include "harness/io/input_error.h"
#include "tests/fuzz/fuzz.h"

/// results.json and a baseline, which is the same; what is read reads back as it is written.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace aisle;
  try {
    const Results results = ResultsFromJson(std::string(fuzz::Text(data, size)), "results.json");
    const std::string text = ToJson(results);
    fuzz::Hold(ToJson(ResultsFromJson(text, "results.json")) == text,
               "results read back as written");
    ++fuzz::taken;
  } catch (const InputError&) {
  }
  return 0;
}
