#include "harness/bag/bag.h"
#include "harness/io/input_error.h"
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace aisle;
  const std::filesystem::path file = fuzz::AsFile(fuzz::Text(data, size), "bag.mcap");
  try {
    const std::unique_ptr<Bag> bag = OpenBag(file);
    for (const BagEntry& entry : bag->entries()) {
      fuzz::Hold(entry.channel < bag->channels().size(), "a message has a channel");
      fuzz::Hold(bag->Read(entry).size() == entry.size, "a message has the length that was said");
    }
    ++fuzz::taken;
  } catch (const InputError&) {
  }
  return 0;
}
