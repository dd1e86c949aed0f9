#include "simulator/mesh/collada_check.h"
#include "simulator/mesh/import.h"
#include "simulator/mesh/obj_check.h"
#include "tests/fuzz/fuzz.h"

/// Our own checks of OBJ and COLLADA, which a file passes before a parser of others sees it. (That
/// parser is Debian's, without instrumentation, and behind the door: simulator/mesh/door.)
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace aisle;
  const std::string_view text = fuzz::Text(data, size);
  for (const auto check : {sim::CheckObj, sim::CheckCollada}) {
    try {
      check(text);
      ++fuzz::taken;
    } catch (const sim::ImportError&) {
    }
  }
  return 0;
}
