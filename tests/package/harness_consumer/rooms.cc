// Packs and unpacks as bags do, and makes one of the systems.
#include <cstdio>
#include <string>

#include "harness/bag/compression.h"
#include "harness/plugs/systems.h"

int main() {
  using namespace aisle;
  const std::string text(1000, 'a');
  // "bag!" as the program lz4 writes it: not packed, since it is too short.
  const std::string lz4(
      "\x04\x22\x4d\x18\x64\x40\xa7\x04\0\0\x80"
      "bag!\0\0\0\0\x02\x3c\xf7\x0b",
      23);
  const bool packs = Decompress(CompressZstd(text, 3), "zstd", text.size()) == text &&
                     Decompress(lz4, "lz4", 4) == "bag!";
  const StereoCalibration rig{
      .width = 640, .height = 480, .fx = 400, .fy = 400, .cx = 320, .cy = 240, .baseline_m = 0.1};
  const bool makes = MakeSystem(BuiltIn("robust"), rig, {}) != nullptr;
  std::printf("%s, %s\n", packs ? "packs" : "does not pack", makes ? "makes" : "does not make");
  return packs && makes ? 0 : 1;
}
