#include "simulator/scene/load.h"
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace aisle::sim;
  try {
    ParseScene(std::string(aisle::fuzz::Text(data, size)), "fuzz.yaml");
    ++aisle::fuzz::taken;
  } catch (const SceneError& error) {
    aisle::fuzz::Hold(!error.messages().empty(), "a scene that is refused has a mistake");
  }
  return 0;
}
