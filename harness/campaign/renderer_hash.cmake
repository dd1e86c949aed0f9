# cmake -DOUT=renderer_hash.cc -DLIST=FILE -P renderer_hash.cmake
# Writes RendererHash() of the object files and libraries that LIST names, one a line.
file(STRINGS ${LIST} files)
set(hashes "")
foreach(file ${files})
  file(SHA256 ${file} hash)
  string(APPEND hashes ${hash})
endforeach()
string(SHA256 hash "${hashes}")
string(SUBSTRING ${hash} 0 16 hash)
file(CONFIGURE OUTPUT ${OUT} @ONLY CONTENT [[
#include "harness/campaign/renderer_hash.h"

namespace aisle {

std::uint64_t RendererHash() { return 0x@hash@U; }

}  // namespace aisle
]])
