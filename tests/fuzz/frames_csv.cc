#include "harness/record/frames_csv.h"

#include "harness/io/input_error.h"
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace aisle;
  try {
    const auto rows = FrameRowsFromCsv(std::string(fuzz::Text(data, size)), "frames.csv");
    const std::string text = ToCsv(rows);
    fuzz::Hold(ToCsv(FrameRowsFromCsv(text, "frames.csv")) == text, "rows read back as written");
    ++fuzz::taken;
  } catch (const InputError&) {
  }
  return 0;
}
