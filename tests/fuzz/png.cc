#include "harness/io/image.h"
#include "harness/io/input_error.h"
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace aisle;
  const std::filesystem::path file = fuzz::AsFile(fuzz::Text(data, size), "image.png");
  for (const auto read : {ReadGreyPng, ReadMaskPng}) {
    try {
      fuzz::Hold(!read(file).empty(), "an image that is read has pixels");
      ++fuzz::taken;
    } catch (const InputError&) {
    }
  }
  return 0;
}
