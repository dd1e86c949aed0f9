#include "harness/io/input_error.h"
#include "harness/record/drive_json.h"
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace aisle;
  try {
    ToJson(DriveLogFromJson(std::string(reinterpret_cast<const char*>(data), size), "drive.json"));
    ++fuzz::taken;
  } catch (const InputError&) {
  }
  return 0;
}
