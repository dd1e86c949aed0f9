// One program on two makes of processor: this machine's, and one that qemu emulates, whose
// reciprocals are exact where those of real ones are approximate.
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "harness/campaign/process.h"
#include "harness/io/file.h"
#include "tests/system/program.h"

namespace aisle {
namespace {

constexpr const char* kEmulator = "/usr/bin/qemu-x86_64";

nlohmann::json StagesOf(std::vector<std::string> program, const std::string& file) {
  for (const char* argument : {"doctor", "--bits", "--pictures", "--json"}) {
    program.emplace_back(argument);
  }
  program.push_back(file);
  Process process(program, {.wall_s = 600});
  while (!process.Poll()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  const nlohmann::json makes = nlohmann::json::parse(ReadFile(file)).at("makes");
  EXPECT_EQ(makes.size(), 1u);
  return makes.front().at("stages");
}

class MakeOfProcessor : public ProgramTest {};

TEST_F(MakeOfProcessor, PicturesAndAllThatLeadsToThemAreTheSameBits) {
  if (::access(kEmulator, X_OK) != 0) {
    GTEST_SKIP() << kEmulator << " is absent: apt-get install qemu-user";
  }
  const nlohmann::json native = StagesOf({AISLE_PROGRAM}, Out("native.json"));
  const nlohmann::json emulated =
      StagesOf({kEmulator, "-cpu", "max", AISLE_PROGRAM}, Out("emulated.json"));
  EXPECT_EQ(native.size(), 5u);
  EXPECT_EQ(native, emulated);
}

}  // namespace
}  // namespace aisle
