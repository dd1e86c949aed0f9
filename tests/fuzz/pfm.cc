#include "harness/io/image.h"
#include "harness/io/input_error.h"
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace aisle;
  try {
    const cv::Mat3f image = ReadLinearImage(fuzz::AsFile(fuzz::Text(data, size), "image.pfm"));
    fuzz::Hold(!image.empty(), "an image that is read has pixels");
    ++fuzz::taken;
  } catch (const InputError&) {
  }
  return 0;
}
