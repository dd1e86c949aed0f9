#include "simulator/mesh/import.h"
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace aisle;
  sim::ImportOptions small;
  small.max_texture_px = 512;
  small.max_triangles = 100'000;
  try {
    sim::ImportModel(fuzz::AsFile(fuzz::Text(data, size), "fuzz.glb"), small);
  } catch (const sim::ImportError&) {
  }
  return 0;
}
