#include "tests/fuzz/models.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  aisle::fuzz::ReadAsModel(data, size, "fuzz.gltf");
  return 0;
}
