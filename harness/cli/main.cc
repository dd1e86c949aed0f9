#include <malloc.h>

#include "harness/cli/command_line.h"

namespace {

/// Images come and go by the megabyte in every frame. Memory that is handed back to the system and
/// mapped anew each time costs a frame milliseconds, more with every thread.
void KeepFreedMemory() {
#ifdef __GLIBC__
  constexpr int kMegabyte = 1 << 20;
  mallopt(M_MMAP_THRESHOLD, 32 * kMegabyte);
  mallopt(M_TRIM_THRESHOLD, 1024 * kMegabyte);
#endif
}

}  // namespace

int main(int argc, char** argv) {
  KeepFreedMemory();
  return aisle::RunCommandLine(argc, argv);
}
